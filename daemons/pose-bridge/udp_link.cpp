// SPDX-License-Identifier: BSD-3-Clause
#include "udp_link.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr std::size_t kDatagramMax = 65536;

sockaddr_in parse(const std::string& endpoint) {
  const auto wrong = [&] {
    return std::runtime_error(fmt::format("--autopilot '{}': must be udp:PORT or udp:ADDRESS:PORT", endpoint));
  };
  if (!endpoint.starts_with("udp:")) throw wrong();
  const std::string rest = endpoint.substr(4);
  const std::size_t colon = rest.rfind(':');
  const std::string address = colon == std::string::npos ? "127.0.0.1" : rest.substr(0, colon);
  const std::string port = colon == std::string::npos ? rest : rest.substr(colon + 1);
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  sockaddr_in result{};
  result.sin_family = AF_INET;
  if (error != std::errc{} || end != port.data() + port.size() || number == 0) throw wrong();
  if (inet_pton(AF_INET, address.c_str(), &result.sin_addr) != 1) throw wrong();
  result.sin_port = htons(number);
  return result;
}

}  // namespace

UdpLink::UdpLink(const std::string& endpoint) {
  const sockaddr_in address = parse(endpoint);
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const std::string reason = std::strerror(errno);
    if (fd_ >= 0) close(fd_);
    throw std::runtime_error(fmt::format("--autopilot '{}': cannot listen: {}", endpoint, reason));
  }
}

UdpLink::~UdpLink() { close(fd_); }

bool UdpLink::receive(std::vector<std::uint8_t>& datagram) {
  datagram.resize(kDatagramMax);
  sockaddr_in from{};
  socklen_t from_size = sizeof(from);
  const ssize_t size =
      recvfrom(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
  if (size < 0) return false;
  datagram.resize(static_cast<std::size_t>(size));
  peer_ = from;
  return true;
}

void UdpLink::send(std::span<const std::uint8_t> datagram) {
  if (peer_.sin_port == 0) return;
  // A lost setpoint is replaced by the next one, so nothing is done about a failure.
  (void)!sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&peer_), sizeof(peer_));
}

}  // namespace comptonaut
