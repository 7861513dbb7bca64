// SPDX-License-Identifier: BSD-3-Clause
// The real mapper in a process of its own, on a bus of its own.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "bus/bus.h"
#include "bus/log.h"
#include "bus/samples.h"
#include "bus/test_bus.h"
#include "system/child.h"

namespace comptonaut {
namespace {

const std::string kMapper = COMPTONAUT_BINARY_DIR "/bin/comptonaut-mapper";
const std::string kConfig = COMPTONAUT_SOURCE_DIR "/config/mapper.yaml";
constexpr int kBatches = 200;

EventBatch events(int number) {
  EventBatch batch = sample<EventBatch>();
  batch.key = {.mission = 1, .sender = 2, .boot_epoch = 5, .number = number};
  batch.utime = kSampleUtime + number * kBatch_us;
  return batch;
}

/// A mapper with its journal, and a bus that hears what it says.
class MapperDaemon : public testing::Test {
 protected:
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("mapper_" + std::to_string(getpid()));
  std::filesystem::path journal_ = folder_ / "journal.lcm";
  std::string url_ = loopback_url();
  Bus bus_{url_};
  std::vector<Bytes> heard_;
  bool alive_ = false;
  std::vector<Counter> counters_;

  void SetUp() override {
    bus_.subscribe_raw("MAV2_MEASUREMENTS", [this](const auto&, std::span<const std::uint8_t> bytes) {
      heard_.emplace_back(bytes.begin(), bytes.end());
    });
    bus_.subscribe<DaemonStatus>("MAV2_STATUS", [this](const auto&, const DaemonStatus& status) {
      alive_ = true;
      counters_ = status.counters;
    });
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::vector<std::string> command() const {
    return {kMapper,        "--config", kConfig,     "--mav",          "2", "--lcm-url", url_,
            "--time-scale", "20",       "--journal", journal_.string()};
  }
  [[nodiscard]] bool wait_until(const std::function<bool()>& done) {
    return until(done, [this] { bus_.handle(20); });
  }
  void send_all() {
    for (int i = 0; i < kBatches; ++i) {
      bus_.publish("MAV2_POSE", StampedPose{.utime = events(i).utime});
      bus_.publish("MAV2_EVENTS", events(i));
    }
    bus_.publish("MAV2_POSE", StampedPose{.utime = events(kBatches).utime});
  }
  [[nodiscard]] std::vector<Bytes> journal() const {
    std::vector<Bytes> batches;
    read_log(journal_, [&](const LogEvent& event) {
      EXPECT_EQ(event.channel, "MAV2_MEASUREMENTS");
      batches.emplace_back(event.bytes.begin(), event.bytes.end());
    });
    return batches;
  }
};

TEST_F(MapperDaemon, LosesNothingAtSigterm) {
  Child mapper(command());
  ASSERT_TRUE(wait_until([this] { return alive_; }));
  send_all();
  mapper.signal(SIGTERM);  // with most of it still on its way
  EXPECT_EQ(mapper.wait(), 0);
  ASSERT_TRUE(wait_until([this] { return heard_.size() >= kBatches; })) << heard_.size() << " of " << kBatches;
  EXPECT_EQ(journal(), heard_);
  std::int64_t number = 0;
  for (const Bytes& bytes : heard_) {
    const auto batch = decode<MeasurementBatch>(bytes);
    ASSERT_TRUE(batch);
    EXPECT_EQ(batch->key.number, number);
    EXPECT_EQ(batch->live_us, 49'123) << "batch " << number;
    ++number;
  }
}

TEST_F(MapperDaemon, HasOnDiskWhatItSentBeforeItWasKilled) {
  Child mapper(command());
  ASSERT_TRUE(wait_until([this] { return alive_; }));
  send_all();
  ASSERT_TRUE(wait_until([this] { return heard_.size() >= kBatches; }));
  mapper.signal(SIGKILL);
  EXPECT_EQ(mapper.wait(), 128 + SIGKILL);
  EXPECT_EQ(journal(), heard_);
}

TEST_F(MapperDaemon, CountsMessagesThatCannotBeAndGoesOn) {
  Child mapper(command());
  ASSERT_TRUE(wait_until([this] { return alive_; }));
  EventBatch spoiled = events(0);
  spoiled.live_us = -1;
  bus_.publish("MAV2_EVENTS", spoiled);
  bus_.publish("MAV2_POSE", sample<Plan>());
  send_all();
  EXPECT_TRUE(wait_until([this] { return heard_.size() >= kBatches; }));
  const auto counted = [this](const Counter& counter) {
    return std::find(counters_.begin(), counters_.end(), counter) != counters_.end();
  };
  EXPECT_TRUE(wait_until([&] { return counted({"MAV2_EVENTS_refused", 1}) && counted({"MAV2_POSE_refused", 1}); }));
}

TEST_F(MapperDaemon, SaysInOneLineWhatItMisses) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{kMapper, "--config", "/nowhere.yaml", "--mav", "2"},
        std::vector<std::string>{kMapper, "--config", kConfig, "--lcm-url", url_},
        std::vector<std::string>{kMapper, "--config", kConfig, "--mav", "2", "--lcm-url", url_, "--journal",
                                 "/proc/no/j"}}) {
    testing::internal::CaptureStderr();
    const int exit_code = Child(words).wait();
    const std::string error = testing::internal::GetCapturedStderr();
    EXPECT_EQ(exit_code, 1) << error;
    EXPECT_TRUE(error.starts_with("<3>comptonaut-mapper: ")) << error;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  }
}

}  // namespace
}  // namespace comptonaut
