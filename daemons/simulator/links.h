// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace comptonaut {

/// Client of a TCP server on this machine that may start late, end, start again, or stop reading: it waits for nothing.
class TcpLink {
 public:
  explicit TcpLink(int port) : port_(port) {}
  ~TcpLink();
  TcpLink(TcpLink&& other) noexcept;
  TcpLink& operator=(TcpLink&&) = delete;

  /// Tries to connect where it is not; true where that succeeded now.
  bool connect();
  [[nodiscard]] bool connected() const { return fd_ >= 0; }
  /// Hands the text to the system, what that does not take yet with the next flush(). False, and no longer connected,
  /// where the server has gone.
  bool send(const std::string& text);
  void flush();
  /// Whether the system has taken everything; also where the server has gone.
  [[nodiscard]] bool idle() const { return waiting_.empty(); }

 private:
  void disconnect();

  int port_;
  int fd_ = -1;
  std::string waiting_;
};

/// UDP socket that talks to one port of this machine.
class UdpLink {
 public:
  /// Throws std::system_error.
  explicit UdpLink(int port);
  ~UdpLink();
  UdpLink(UdpLink&& other) noexcept;
  UdpLink& operator=(UdpLink&&) = delete;

  [[nodiscard]] int fd() const { return fd_; }
  /// A datagram that nobody takes is lost, as on a wire.
  void send(std::span<const std::uint8_t> bytes);
  /// What has arrived, without waiting.
  [[nodiscard]] std::vector<std::vector<std::uint8_t>> receive();

 private:
  int fd_;
};

}  // namespace comptonaut
