// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace comptonaut {

/// A UDP socket that waits for the autopilot and answers to where its last datagram came from.
class UdpLink {
 public:
  /// `endpoint`: udp:PORT (on 127.0.0.1) or udp:ADDRESS:PORT to listen on (IPv4).
  /// Throws std::runtime_error that names the endpoint where it makes no sense or cannot be bound.
  explicit UdpLink(const std::string& endpoint);
  ~UdpLink();
  UdpLink(const UdpLink&) = delete;
  UdpLink& operator=(const UdpLink&) = delete;

  [[nodiscard]] int fd() const { return fd_; }
  /// The next datagram that has arrived; false: there is none.
  bool receive(std::vector<std::uint8_t>& datagram);
  /// Goes nowhere before the first datagram has come.
  void send(std::span<const std::uint8_t> datagram);

 private:
  int fd_ = -1;
  sockaddr_in peer_{};
};

}  // namespace comptonaut
