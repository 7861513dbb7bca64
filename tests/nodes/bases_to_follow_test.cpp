// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/bases_to_follow.h"

#include <gtest/gtest.h>

#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

// Ticks are announced out of order and twice, and before their batches have come.
TEST(BasesToFollow, FollowsEachTickOnceInItsTurn) {
  const auto mission = some_mission(6);
  Coordinator leader = make_coordinator(small_config()), follower = make_coordinator(small_config());
  std::vector<CoordinatorState> announced;
  for (const MeasurementBatch& batch : mission) {
    leader.on_measurements(batch);
    while (const auto tick = leader.tick_if_complete()) announced.push_back(tick->state);
  }
  ASSERT_GE(announced.size(), 4u);

  BasesToFollow bases;
  for (std::size_t i = announced.size(); i-- > 0;) bases.on_state(announced[i]);
  EXPECT_FALSE(bases.next(follower)) << "no batch has come";
  std::vector<std::uint64_t> hashes;
  for (const MeasurementBatch& batch : mission) {
    follower.on_measurements(batch);
    bases.on_state(announced.front());
    while (const auto tick = bases.next(follower)) hashes.push_back(tick->state.lambda_hash);
  }
  ASSERT_EQ(hashes.size(), announced.size());
  for (std::size_t i = 0; i < hashes.size(); ++i) EXPECT_EQ(hashes[i], announced[i].lambda_hash) << "tick " << i;
  EXPECT_EQ(bases.counters().at(0), (Counter{"ticks_followed", static_cast<std::int64_t>(announced.size())}));
  EXPECT_EQ(bases.counters().at(1), (Counter{"ticks_different", 0}));
  EXPECT_EQ(bases.counters().at(2), (Counter{"ticks_waiting", 0}));
}

TEST(BasesToFollow, CountsTicksWhoseMapIsNotTheAnnouncedOne) {
  Coordinator leader = make_coordinator(small_config()), follower = make_coordinator(small_config());
  BasesToFollow bases;
  for (const MeasurementBatch& batch : some_mission(3)) {
    leader.on_measurements(batch);
    follower.on_measurements(batch);
    while (auto tick = leader.tick_if_complete()) {
      tick->state.lambda_hash += tick->state.utime == kMissionStart + 2 * kSecond_us ? 1 : 0;
      bases.on_state(tick->state);
    }
  }
  while (bases.next(follower)) {
  }
  EXPECT_EQ(bases.counters().at(0), (Counter{"ticks_followed", 3}));
  EXPECT_EQ(bases.counters().at(1), (Counter{"ticks_different", 1}));
}

TEST(BasesToFollow, RemembersAnHourOfTicksAndCountsTheRest) {
  BasesToFollow bases;
  for (int i = 0; i < 3'610; ++i) bases.on_state({.utime = i * kSecond_us});
  EXPECT_EQ(bases.counters().at(2), (Counter{"ticks_waiting", 3'600}));
  EXPECT_EQ(bases.counters().at(3), (Counter{"ticks_forgotten", 10}));
}

}  // namespace
}  // namespace comptonaut
