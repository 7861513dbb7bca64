// SPDX-License-Identifier: BSD-3-Clause
#include "bus/log.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bus/samples.h"
#include "core/random.h"

namespace comptonaut {
namespace {

struct Event {
  Utime utime;
  std::string channel;
  Bytes bytes;
  bool operator==(const Event&) const = default;
};

class Log : public testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("log_test_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".lcm");
  void SetUp() override { std::filesystem::remove(file_); }
  void TearDown() override { std::filesystem::remove(file_); }

  [[nodiscard]] std::vector<Event> read() const {
    std::vector<Event> events;
    read_log(file_, [&](const LogEvent& e) {
      events.push_back({e.logged_utime, e.channel, Bytes(e.bytes.begin(), e.bytes.end())});
    });
    return events;
  }
  [[nodiscard]] std::vector<Event> write_some() const {
    const std::vector<Event> events = {{5, "MAV1_PLAN", encode(sample<Plan>())}, {7, "EMPTY", {}}, {9, "X", {1, 2, 3}}};
    LogWriter log(file_);
    for (const Event& e : events) EXPECT_TRUE(log.append({e.utime, e.channel, e.bytes}));
    return events;
  }
  [[nodiscard]] std::string error() const {
    try {
      (void)read();
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(Log, ReadsWhatWasWritten) {
  const auto events = write_some();
  EXPECT_EQ(read(), events);
}

TEST_F(Log, AppendsToWhatIsThere) {
  auto events = write_some();
  const auto more = write_some();
  events.insert(events.end(), more.begin(), more.end());
  EXPECT_EQ(read(), events);
}

TEST_F(Log, LeavesOutALastEventThatIsCutShort) {
  const auto events = write_some();
  const auto whole = std::filesystem::file_size(file_);
  for (std::uintmax_t less = 1; less < 28 + 1 + 3; ++less) {
    std::filesystem::resize_file(file_, whole - less);
    EXPECT_EQ(read(), std::vector<Event>(events.begin(), events.end() - 1)) << less << " bytes less";
  }
}

TEST_F(Log, NamesTheFileThatIsNoLog) {
  EXPECT_NE(error().find(file_.string() + ": cannot open"), std::string::npos) << error();
  std::ofstream(file_) << "";
  EXPECT_NE(error().find(file_.string() + ": holds no event"), std::string::npos) << error();
  std::ofstream(file_) << "this is not a recording but a text of some length";
  EXPECT_NE(error().find(file_.string() + ": byte 0: not an event"), std::string::npos) << error();
  EXPECT_THROW(LogWriter("/proc/nowhere/log.lcm"), std::runtime_error);
}

TEST_F(Log, SurvivesRandomDamage) {
  (void)write_some();
  std::ifstream in(file_, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  Random random(42);
  for (int round = 0; round < 2'000; ++round) {
    std::string damaged = whole;
    for (int i = 0; i < 4; ++i) {
      damaged[static_cast<std::size_t>(random.uniform() * static_cast<double>(damaged.size()))] =
          static_cast<char>(random());
    }
    std::ofstream(file_, std::ios::binary) << damaged;
    try {
      (void)read();
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace comptonaut
