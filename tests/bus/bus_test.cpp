// SPDX-License-Identifier: BSD-3-Clause
#include "bus/bus.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "bus/samples.h"
#include "bus/test_bus.h"

namespace comptonaut {
namespace {

std::int64_t counter(const Bus& bus, const std::string& name) {
  for (const Counter& c : bus.counters()) {
    if (c.name == name) return c.value;
  }
  return -1;
}

template <class T>
class BusExchange : public testing::Test {};
using MessageTypes =
    testing::Types<EventBatch, MeasurementBatch, RangePoints, TerrainTile, StampedPose, PoseQuality, VehicleState, Plan,
                   SourceReport, MapTile, ClearanceTile, PatchReport, CoordinatorState, DaemonStatus, Truth>;
TYPED_TEST_SUITE(BusExchange, MessageTypes);

TYPED_TEST(BusExchange, CarriesEveryTypeOverMulticast) {
  const std::string url = loopback_url();
  Bus sender(url), receiver(url);
  Bytes received;
  std::string received_on;
  receiver.subscribe<TypeParam>("MAV[0-9]+_.*", [&](const std::string& channel, const TypeParam& message) {
    received_on = channel;
    received = encode(message);
  });
  sender.publish("MAV12_THING", sample<TypeParam>());
  EXPECT_TRUE(until([&] { return !received.empty(); }, [&] { receiver.handle(100); }));
  EXPECT_EQ(received, encode(sample<TypeParam>()));
  EXPECT_EQ(received_on, "MAV12_THING");
}

TEST(Bus, KeepsTwoBusesOfDifferentPortsApart) {
  Bus one(loopback_url()), other(loopback_url());
  int heard_by_one = 0, heard_by_other = 0;
  one.subscribe_raw(".*", [&](const auto&, auto) { ++heard_by_one; });
  other.subscribe_raw(".*", [&](const auto&, auto) { ++heard_by_other; });
  one.publish("X", sample<Plan>());
  EXPECT_TRUE(until([&] { return heard_by_one == 1; }, [&] { one.handle(100); }));
  EXPECT_FALSE(other.handle(100));
  EXPECT_EQ(heard_by_other, 0);
}

TEST(Bus, CountsAndLeavesOutWhatDoesNotDecode) {
  Bus bus(loopback_url());
  int plans = 0;
  bus.subscribe<Plan>("MAV1_PLAN", [&](const auto&, const Plan&) { ++plans; });
  bus.publish("MAV1_PLAN", sample<StampedPose>());
  bus.publish_raw("MAV1_PLAN", {});
  bus.publish("MAV1_PLAN", sample<Plan>());
  EXPECT_TRUE(until([&] { return plans == 1; }, [&] { bus.handle(100); }));
  EXPECT_EQ(counter(bus, "MAV1_PLAN_refused"), 2);
  EXPECT_EQ(counter(bus, "bus_received"), 3);
}

TEST(Bus, SurvivesAHandlerThatThrows) {
  Bus bus(loopback_url());
  int handled = 0;
  bus.subscribe_raw("X", [&](const auto&, auto) {
    if (++handled == 1) throw std::runtime_error("planted by the test");
  });
  bus.publish("X", sample<Plan>());
  bus.publish("X", sample<Plan>());
  EXPECT_TRUE(until([&] { return handled == 2; }, [&] { bus.handle(100); }));
  EXPECT_EQ(counter(bus, "bus_handler_failures"), 1);
}

// LCM's default queue of 30 would drop most of these in silence.
TEST(Bus, KeepsTenThousandMessagesForASlowReader) {
  constexpr int kMessages = 10'000;
  const std::string url = loopback_url();
  Bus sender(url), receiver(url);
  std::vector<std::int64_t> numbers;
  receiver.subscribe<EventBatch>("E",
                                 [&](const auto&, const EventBatch& batch) { numbers.push_back(batch.key.number); });
  auto batch = sample<EventBatch>();
  for (int i = 0; i < kMessages; ++i) {
    batch.key.number = i;
    sender.publish("E", batch);
    if (i % 50 == 0) usleep(1000);  // the socket's buffer is not the matter here
  }
  EXPECT_TRUE(until([&] { return numbers.size() == kMessages; }, [&] { receiver.handle(100); }));
  for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], static_cast<std::int64_t>(i));
}

TEST(Bus, NamesAUrlThatItCannotOpenInOneLine) {
  for (const std::string url : {"", "nonsense://here", "udpm://", "udpm://10.1.2.3:7667", "udpm://239.255.76.67",
                                "udpm://239.255.76.67:99999"}) {
    testing::internal::CaptureStderr();
    try {
      Bus bus(url);
      ADD_FAILURE() << "opened '" << url << "'";
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find("'" + url + "'"), std::string::npos) << e.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << url;  // liblcm has nothing to add
  }
}

}  // namespace
}  // namespace comptonaut
