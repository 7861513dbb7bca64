// SPDX-License-Identifier: BSD-3-Clause
#include "team/multicast_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr int kReceiveBuffer_bytes = 1 << 20;
constexpr std::size_t kLongest_bytes = 2048;  // more than any message of the team takes

in_addr ipv4(const std::string& text) {
  in_addr address{};
  if (text.empty()) {
    address.s_addr = htonl(INADDR_ANY);
  } else {
    inet_pton(AF_INET, text.c_str(), &address);
  }
  return address;
}

sockaddr_in endpoint(const MulticastAddress& address) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(address.port));
  to.sin_addr = ipv4(address.group);
  return to;
}

template <class Value>
bool set(int fd, int level, int option, const Value& value) {
  return setsockopt(fd, level, option, &value, sizeof value) == 0;
}

/// Bound to the group, not to every address: what is sent to this host alone does not arrive.
bool configure(int fd, const MulticastAddress& address) {
  const sockaddr_in group = endpoint(address);
  const ip_mreq membership{.imr_multiaddr = group.sin_addr, .imr_interface = ipv4(address.interface)};
  set(fd, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer_bytes);  // as much as the kernel grants
  return set(fd, SOL_SOCKET, SO_REUSEADDR, 1) && set(fd, SOL_SOCKET, SO_REUSEPORT, 1) &&
         bind(fd, reinterpret_cast<const sockaddr*>(&group), sizeof group) == 0 &&
         set(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership) &&
         set(fd, IPPROTO_IP, IP_MULTICAST_IF, membership.imr_interface) &&
         set(fd, IPPROTO_IP, IP_MULTICAST_TTL, static_cast<unsigned char>(address.ttl)) &&
         set(fd, IPPROTO_IP, IP_MULTICAST_LOOP, static_cast<unsigned char>(1));
}

}  // namespace

MulticastSocket::MulticastSocket(const MulticastAddress& address)
    : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)), address_(address) {
  if (fd_ >= 0 && configure(fd_, address)) return;
  const std::string reason = std::strerror(errno);
  if (fd_ >= 0) close(fd_);
  throw std::runtime_error("cannot join the team bus " + address.group + ":" + std::to_string(address.port) + ": " +
                           reason);
}

MulticastSocket::~MulticastSocket() { close(fd_); }

bool MulticastSocket::send(std::span<const std::uint8_t> datagram) {
  const sockaddr_in to = endpoint(address_);
  const ssize_t sent =
      sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  return sent == static_cast<ssize_t>(datagram.size());
}

std::optional<std::vector<std::uint8_t>> MulticastSocket::receive() {
  std::vector<std::uint8_t> datagram(kLongest_bytes);
  const ssize_t size = recv(fd_, datagram.data(), datagram.size(), 0);
  if (size < 0) return {};
  datagram.resize(static_cast<std::size_t>(size));
  return datagram;
}

}  // namespace comptonaut
