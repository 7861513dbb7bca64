// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

bool same(const Coordinator::Tick& a, const Coordinator::Tick& b) {
  const auto same_plan = [](const Plan& p, const Plan& q) {
    return p.mav == q.mav && p.number == q.number && p.status == q.status && p.basis == q.basis &&
           p.waypoints == q.waypoints && p.utime == q.utime;
  };
  const auto same_source = [](const SourceEstimate& p, const SourceEstimate& q) {
    return p.p_W == q.p_W && p.activity_Bq == q.activity_Bq;
  };
  const auto same_tile = [](const MapTile& p, const MapTile& q) { return p.cells == q.cells && p.utime == q.utime; };
  return a.state.utime == b.state.utime && a.state.basis == b.state.basis &&
         a.state.lambda_hash == b.state.lambda_hash && a.state.terrain_hash == b.state.terrain_hash &&
         a.state.cones == b.state.cones && a.state.viewpoints == b.state.viewpoints &&
         a.sources.coverage == b.sources.coverage &&
         std::ranges::equal(a.sources.sources, b.sources.sources, same_source) &&
         std::equal(a.plans.begin(), a.plans.end(), b.plans.begin(), b.plans.end(), same_plan) &&
         std::equal(a.map.begin(), a.map.end(), b.map.begin(), b.map.end(), same_tile);
}

/// A leader that hears batches late, twice, in disorder, some never, and loses patience at times.
std::vector<Coordinator::Tick> lead(const std::vector<MeasurementBatch>& sent, std::uint64_t seed,
                                    const CoordinatorConfig& config = small_config()) {
  Random random(seed);
  Coordinator leader = make_coordinator(config);
  std::vector<Coordinator::Tick> ticks;
  std::vector<std::pair<double, MeasurementBatch>> delayed;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    if (random.uniform() < 0.02) continue;  // lost on its way to the leader
    const double delay_s = random.uniform() < 0.05 ? random.uniform(0, 2.0) : random.uniform(0, 0.2);
    delayed.emplace_back(static_cast<double>(i) / 60 + delay_s, sent[i]);
    if (random.uniform() < 0.05) delayed.push_back(delayed.back());
  }
  std::stable_sort(delayed.begin(), delayed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [arrival_s, batch] : delayed) {
    leader.on_measurements(batch);
    while (auto tick = leader.tick_if_complete()) ticks.push_back(std::move(*tick));
    if (random.uniform() > 0.02) continue;
    if (auto tick = leader.tick_anyway()) ticks.push_back(std::move(*tick));
  }
  EXPECT_GT(counter(leader, "batches_given_up"), 0);
  EXPECT_GT(counter(leader, "batches_folded_late"), 0);
  return ticks;
}

/// Hands `sent` to a follower in an order of its own and has it follow.
void expect_followed(const std::vector<Coordinator::Tick>& ticks, std::vector<MeasurementBatch> sent,
                     std::uint64_t seed, const CoordinatorConfig& config = small_config()) {
  Random random(seed);
  for (std::size_t i = sent.size() - 1; i > 0; --i) std::swap(sent[i], sent[random() % (i + 1)]);
  Coordinator follower = make_coordinator(config);
  std::size_t arrived = 0;
  for (const Coordinator::Tick& announced : ticks) {
    auto followed = follower.follow(announced.state.utime, announced.state.basis);
    while (!followed && arrived < sent.size()) {  // the announcement is faster than the batches
      follower.on_measurements(sent[arrived++]);
      followed = follower.follow(announced.state.utime, announced.state.basis);
    }
    ASSERT_TRUE(followed) << "seed " << seed << " tick " << announced.state.utime;
    ASSERT_TRUE(same(*followed, announced)) << "seed " << seed << " tick " << announced.state.utime;
  }
}

TEST(CoordinatorFollow, HoldsTheLeadersStateBitForBitWhateverTheOrderOfArrival) {
  const auto mission = some_mission(25);
  const auto ticks = lead(mission, 61);
  ASSERT_GT(ticks.size(), 15u);
  for (const std::uint64_t seed : {62u, 63u}) expect_followed(ticks, mission, seed);
}

/// MAV 2's clock jumps 300 s ahead, MAV 3's mapper starts again every 2 s, each time with an earlier clock for its
/// epoch, and the whole team pauses for 700 s.
std::vector<MeasurementBatch> mission_of_wrong_clocks_and_restarts(int duration_s) {
  auto mission = some_mission(duration_s);
  for (MeasurementBatch& batch : mission) {
    const std::int64_t number = batch.key.number;
    if (batch.key.sender == 2 && number >= 100) batch.utime += 300 * kSecond_us;
    if (batch.key.sender == 3) batch.key.boot_epoch -= number / 40;
    if (batch.key.sender == 3) batch.key.number %= 40;
    if (number >= 10 * duration_s) batch.utime += 700 * kSecond_us;
  }
  return mission;
}

TEST(CoordinatorFollow, MakesTheSamePlansInTheSearchForInformation) {
  CoordinatorConfig config = small_config();
  config.search.strategy = "information";
  const auto mission = some_mission(25);
  const auto ticks = lead(mission, 66, config);
  ASSERT_GT(ticks.size(), 15u);
  EXPECT_TRUE(std::ranges::any_of(ticks, [](const auto& tick) { return !tick.plans[0].waypoints.empty(); }));
  expect_followed(ticks, mission, 67, config);
}

TEST(CoordinatorFollow, FindsTheSameSourcesWithTheJointEstimator) {
  CoordinatorConfig config = small_config();
  config.estimator = "joint";
  config.joint.use_singles = false;  // of which that mission has none
  const auto mission = some_mission(15);
  const auto ticks = lead(mission, 68, config);
  ASSERT_GT(ticks.size(), 8u);
  EXPECT_EQ(ticks.back().sources.sources.size(), 1u);
  expect_followed(ticks, mission, 69, config);
}

TEST(CoordinatorFollow, HoldsTheLeadersStateThroughWrongClocksRestartsAndPauses) {
  const auto mission = mission_of_wrong_clocks_and_restarts(30);
  const auto ticks = lead(mission, 64);
  ASSERT_GT(ticks.size(), 25u);
  EXPECT_LT(ticks.size(), 40u) << "none for the pause";
  std::size_t epochs = 0;
  for (const auto& tick : ticks) epochs = std::max(epochs, tick.state.basis.size());
  EXPECT_LE(epochs, 6u) << "15 starts of MAV 3";
  for (const std::uint64_t seed : {65u, 66u}) expect_followed(ticks, mission, seed);
}

TEST(CoordinatorFollow, TakesNoTickThatIsNotLaterOrNotAWholeSecond) {
  Coordinator coordinator = make_coordinator(small_config());
  for (const MeasurementBatch& batch : some_mission(3)) coordinator.on_measurements(batch);
  const auto tick = coordinator.tick_if_complete();
  ASSERT_TRUE(tick);
  EXPECT_FALSE(coordinator.follow(tick->state.utime, tick->state.basis));
  EXPECT_FALSE(coordinator.follow(tick->state.utime + 1, tick->state.basis));
  EXPECT_EQ(counter(coordinator, "bases_refused"), 2);
  EXPECT_TRUE(coordinator.follow(tick->state.utime + kSecond_us, tick->state.basis)) << "nothing new is allowed";
}

TEST(CoordinatorFollow, AFollowerCanTakeTheLead) {
  const auto mission = some_mission(8);
  Coordinator leader = make_coordinator(small_config()), standby = make_coordinator(small_config());
  std::size_t i = 0;
  for (; i < mission.size() / 2; ++i) {
    leader.on_measurements(mission[i]);
    standby.on_measurements(mission[i]);
    while (const auto tick = leader.tick_if_complete()) {
      ASSERT_TRUE(standby.follow(tick->state.utime, tick->state.basis));
    }
  }
  int led = 0;
  for (; i < mission.size(); ++i) {
    leader.on_measurements(mission[i]);
    standby.on_measurements(mission[i]);
    while (const auto by_leader = leader.tick_if_complete()) {
      const auto by_standby = standby.tick_if_complete();
      ASSERT_TRUE(by_standby);
      EXPECT_TRUE(same(*by_leader, *by_standby));
      ++led;
    }
  }
  EXPECT_EQ(led, 4);
}

}  // namespace
}  // namespace comptonaut
