// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comptonaut {

/// Where a team talks: "udpm://239.255.77.1:7700?ttl=1&interface=192.168.4.2".
struct MulticastAddress {
  std::string group;      ///< IPv4, 224.0.0.0 to 239.255.255.255
  int port = 0;           ///< 1..65535
  int ttl = 0;            ///< 0: this host alone
  std::string interface;  ///< IPv4 address of the network device; empty: the one of the default route

  bool operator==(const MulticastAddress&) const = default;
};

/// Throws std::invalid_argument that names the URL and what is wrong with it.
[[nodiscard]] MulticastAddress parse_multicast_url(const std::string& url);

/// One UDP socket in one multicast group; it hears itself, too.
class MulticastSocket {
 public:
  /// Throws std::runtime_error that names the address where it cannot be opened.
  explicit MulticastSocket(const MulticastAddress& address);
  ~MulticastSocket();
  MulticastSocket(const MulticastSocket&) = delete;
  MulticastSocket& operator=(const MulticastSocket&) = delete;

  /// To poll for readability.
  [[nodiscard]] int fd() const { return fd_; }
  /// False where the network did not take it.
  [[nodiscard]] bool send(std::span<const std::uint8_t> datagram);
  /// nullopt where nothing waits. A datagram longer than 2,048 bytes is cut.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> receive();

 private:
  int fd_;
  MulticastAddress address_;
};

}  // namespace comptonaut
