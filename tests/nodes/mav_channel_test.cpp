// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mav_channel.h"

#include <gtest/gtest.h>

#include <map>

namespace comptonaut {
namespace {

TEST(MavChannel, IsReadAsItIsWritten) {
  EXPECT_EQ(mav_channel(3, "EVENTS"), "MAV3_EVENTS");
  const std::map<std::string, int> numbers = {
      {"MAV3_EVENTS", 3}, {"MAV250_PLAN", 250}, {"MAV0_STATUS", 0}, {"COORDINATOR", -1}, {"MAV_EVENTS", -1},
      {"MAV3", -1},       {"MAV-3_PLAN", -1},   {"xMAV3_PLAN", -1}, {"MAV251_PLAN", -1}, {"MAV99999999999_PLAN", -1}};
  for (const auto& [channel, mav] : numbers) EXPECT_EQ(mav_of_channel(channel), mav) << channel;
}

}  // namespace
}  // namespace comptonaut
