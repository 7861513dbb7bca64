// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>

namespace comptonaut {

/// Whether nobody uses a port, for UDP or for TCP.
inline bool is_free_port(int port) {
  for (const int type : {SOCK_DGRAM, SOCK_STREAM}) {
    const int fd = socket(AF_INET, type, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    const bool bound = bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    close(fd);
    if (!bound) return false;
  }
  return true;
}

/// The first of `count` ports in a row that nobody uses, below those that the system hands out (from 32,768 on), so
/// that no socket which asks for any port gets one of them meanwhile. Another process looks elsewhere first.
inline int free_ports(int count) {
  const int places = (32'768 - 10'000) / count;
  for (int i = 0; i < places; ++i) {
    const int first = 10'000 + (getpid() + i) % places * count;
    int free = 0;
    while (free < count && is_free_port(first + free)) ++free;
    if (free == count) return first;
  }
  return 0;
}

/// A UDP port that nobody uses at the moment.
inline int free_udp_port() {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool bound = bind(fd, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(fd);
  return bound ? ntohs(address.sin_port) : 0;
}

/// A multicast group of this host alone, on a port of the test's own.
inline std::string loopback_url() { return "udpm://239.255.76.67:" + std::to_string(free_udp_port()) + "?ttl=0"; }

/// Calls `step` until `done`, for at most so long. Whether it was done.
inline bool until(const std::function<bool()>& done, const std::function<void()>& step,
                  std::chrono::seconds at_most = std::chrono::seconds(20)) {
  const auto deadline = std::chrono::steady_clock::now() + at_most;
  while (!done()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    step();
  }
  return true;
}

}  // namespace comptonaut
