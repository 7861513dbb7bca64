// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bus/codec.h"
#include "nodes/mav_channel.h"  // whoever uses a bus names channels
#include "nodes/status.h"

namespace comptonaut {

/// One LCM bus. The only code that talks to liblcm. Single-threaded: every handler runs inside handle().
class Bus {
 public:
  using RawHandler = std::function<void(const std::string& channel, std::span<const std::uint8_t> bytes)>;

  /// Throws std::runtime_error that names the URL where it cannot be opened.
  explicit Bus(const std::string& lcm_url);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  void publish_raw(const std::string& channel, std::span<const std::uint8_t> bytes);
  template <class T>
  void publish(const std::string& channel, const T& message) {
    publish_raw(channel, encode(message));
  }

  /// `channel_regex` as LCM takes it (anchored at both ends). An exception out of a handler is counted, not passed on.
  void subscribe_raw(const std::string& channel_regex, RawHandler handler);
  /// Messages that do not decode are counted ("<channel>_refused") and left out.
  template <class T>
  void subscribe(const std::string& channel_regex,
                 std::function<void(const std::string& channel, const T& message)> handler) {
    subscribe_raw(channel_regex, [this, handler](const std::string& channel, std::span<const std::uint8_t> bytes) {
      if (const auto message = decode<T>(bytes)) {
        handler(channel, *message);
      } else {
        count_refused(channel);
      }
    });
  }

  /// To poll for readability.
  [[nodiscard]] int fd() const;
  /// Handles one message, waiting for it at most timeout_ms. False: none came.
  bool handle(int timeout_ms = 0);

  /// Messages received and refused, handler failures.
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  void count_refused(const std::string& channel);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace comptonaut
