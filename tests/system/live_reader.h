// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "bus/bus.h"
#include "bus/test_bus.h"
#include "detector/make_hits.h"
#include "scratch.h"
#include "system/child.h"

namespace comptonaut {

inline Utime now_utime() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// A single of 300 keV, t_us after chip time 0.
inline std::string live_row(std::int64_t index, Utime t_us) {
  return t3pa_row(index, make_hit_anywhere(index, 300.0, 1e3 * static_cast<double>(t_us)));
}

/// The real detector-reader of MAV 1 on a bus of the test's own, and what comes from it.
class LiveReader {
 public:
  explicit LiveReader(const std::string& input, const std::string& config = kShippedConfig)
      : input_(input), config_(config), bus_(url_) {
    bus_.subscribe<EventBatch>("MAV1_EVENTS", [this](const auto&, const EventBatch& batch) {
      batches.push_back(batch);
      arrivals.push_back(now_utime());
    });
    bus_.subscribe<DaemonStatus>("MAV1_STATUS", [this](const auto&, const DaemonStatus& status) {
      if (!status.state.empty()) state = status.state;
      for (const Counter& counter : status.counters) counters[counter.name] = counter.value;
    });
    start();
  }

  void start() {
    child_ = std::make_unique<Child>(
        std::vector<std::string>{std::string(COMPTONAUT_BINARY_DIR) + "/bin/comptonaut-detector-reader", "--config",
                                 config_, "--mav", "1", "--lcm-url", url_, "--input", input_});
  }
  Child& child() { return *child_; }

  /// Takes what comes until `done`, for twenty seconds at most.
  bool wait(const std::function<bool()>& done) {
    return until(done, [&] { bus_.handle(1); });
  }
  /// What a reader that has ended has still sent.
  void take_all() {
    while (bus_.handle(100)) {
    }
  }
  [[nodiscard]] std::int64_t singles() const {
    std::int64_t sum = 0;
    for (const EventBatch& batch : batches) sum += batch.channels[0].singles;
    return sum;
  }
  [[nodiscard]] std::int64_t live_us() const {
    std::int64_t sum = 0;
    for (const EventBatch& batch : batches) sum += batch.live_us;
    return sum;
  }

  static inline const std::string kShippedConfig = COMPTONAUT_SOURCE_DIR "/config/detector-reader.yaml";
  std::vector<EventBatch> batches;
  std::vector<Utime> arrivals;  ///< of the batches
  std::string state;
  std::map<std::string, std::int64_t> counters;

 private:
  const std::string url_ = loopback_url();
  std::string input_, config_;
  Bus bus_;
  std::unique_ptr<Child> child_;
};

/// A client that tries until somebody listens.
class Client {
 public:
  explicit Client(int port) {
    const bool connected =
        until([&] { return connect_to(port); }, [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); });
    EXPECT_TRUE(connected);
  }
  ~Client() { close(fd_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(const std::string& text) const {
    EXPECT_EQ(::send(fd_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }

 private:
  bool connect_to(int port) {
    if (fd_ >= 0) close(fd_);
    fd_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  int fd_ = -1;
};

}  // namespace comptonaut
