// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "bus/bus.h"
#include "bus/daemon.h"

namespace comptonaut {

/// Sends many messages a few at a time. LCM tools like lcm-logger queue 30 messages and drop the rest in silence, so a
/// map of a hundred tiles must not come at once. Wakes up only while something waits.
class PacedPublisher {
 public:
  /// Both must outlive this.
  PacedPublisher(EventLoop& loop, Bus& bus);
  /// Sends what still waits.
  ~PacedPublisher();
  PacedPublisher(const PacedPublisher&) = delete;
  PacedPublisher& operator=(const PacedPublisher&) = delete;

  template <class T>
  void publish(const std::string& channel, const T& message) {
    push(channel, encode(message));
  }

 private:
  void push(const std::string& channel, Bytes bytes);
  void send_some(std::size_t at_most);

  EventLoop& loop_;
  Bus& bus_;
  int timer_;
  std::deque<std::pair<std::string, Bytes>> waiting_;
};

}  // namespace comptonaut
