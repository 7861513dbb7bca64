// SPDX-License-Identifier: BSD-3-Clause
#include "links.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace comptonaut {
namespace {

constexpr std::size_t kDatagramMax = 2048;

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

bool connect_to(int fd, int port) {
  const sockaddr_in address = loopback(port);
  return ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

}  // namespace

TcpLink::TcpLink(TcpLink&& other) noexcept
    : port_(other.port_), fd_(std::exchange(other.fd_, -1)), waiting_(std::move(other.waiting_)) {}

TcpLink::~TcpLink() { disconnect(); }

void TcpLink::disconnect() {
  if (fd_ >= 0) close(fd_);
  fd_ = -1;
  waiting_.clear();
}

bool TcpLink::connect() {
  if (connected()) return false;
  fd_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd_ >= 0 && !connect_to(fd_, port_)) disconnect();
  return connected();
}

bool TcpLink::send(const std::string& text) {
  if (!connected()) return false;
  waiting_ += text;
  flush();
  return connected();
}

void TcpLink::flush() {
  std::size_t sent = 0;
  while (sent < waiting_.size()) {
    const ssize_t n = ::send(fd_, waiting_.data() + sent, waiting_.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) sent += static_cast<std::size_t>(n);
    if (n < 0 && errno == EAGAIN) break;
    if (n < 0 && errno != EINTR) return disconnect();
  }
  waiting_.erase(0, sent);
}

UdpLink::UdpLink(int port) : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "UDP socket");
  if (!connect_to(fd_, port))
    throw std::system_error(errno, std::generic_category(), "UDP port " + std::to_string(port));
}

UdpLink::UdpLink(UdpLink&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

UdpLink::~UdpLink() {
  if (fd_ >= 0) close(fd_);
}

void UdpLink::send(std::span<const std::uint8_t> bytes) { (void)::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }

std::vector<std::vector<std::uint8_t>> UdpLink::receive() {
  std::vector<std::vector<std::uint8_t>> datagrams;
  std::array<std::uint8_t, kDatagramMax> buffer;
  for (;;) {
    const ssize_t n = recv(fd_, buffer.data(), buffer.size(), 0);
    if (n < 0 && errno == ECONNREFUSED) continue;  // an earlier datagram found nobody
    if (n < 0) return datagrams;
    datagrams.emplace_back(buffer.begin(), buffer.begin() + n);
  }
}

}  // namespace comptonaut
