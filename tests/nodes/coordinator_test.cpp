// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/coordinator.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/hash.h"
#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

TEST(Coordinator, TicksAtWholeSecondsOnceEveryMavReachesThem) {
  Coordinator coordinator = make_coordinator(small_config());
  std::vector<Utime> ticks;
  for (const MeasurementBatch& batch : some_mission(4)) {
    coordinator.on_measurements(batch);
    while (const auto tick = coordinator.tick_if_complete()) {
      ticks.push_back(tick->state.utime);
      EXPECT_EQ(batch.end_utime(), tick->state.utime) << "as soon as the last batch is there";
      EXPECT_EQ(batch.key.sender, 3);
    }
  }
  EXPECT_EQ(ticks, (std::vector<Utime>{kMissionStart + kSecond_us, kMissionStart + 2 * kSecond_us,
                                       kMissionStart + 3 * kSecond_us, kMissionStart + 4 * kSecond_us}));
}

TEST(Coordinator, SaysWhatItFoundWhereToFlyAndOfWhichInputs) {
  Coordinator coordinator = make_coordinator(small_config());
  std::optional<Coordinator::Tick> last;
  std::int64_t cones = 0;
  for (const MeasurementBatch& batch : some_mission(10)) {
    coordinator.on_measurements(batch);
    cones += std::ssize(batch.cones);
    while (auto tick = coordinator.tick_if_complete()) last = std::move(tick);
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->state.basis, (Basis{{1, 100, 199, {}}, {2, 100, 199, {}}, {3, 100, 199, {}}}));
  EXPECT_EQ(last->state.cones, cones);
  EXPECT_EQ(last->state.viewpoints, 600);
  EXPECT_EQ(last->state.lambda_hash, fnv1a(coordinator.lambda_Bq()));
  ASSERT_EQ(last->plans.size(), 3u);
  for (const Plan& plan : last->plans) {
    EXPECT_EQ(plan.basis, last->state.basis);
    EXPECT_EQ(plan.mission, 5);
    EXPECT_LE(plan.waypoints.size(), 16u);
    for (const Waypoint& waypoint : plan.waypoints) EXPECT_EQ(waypoint.speed_max_m_s, 8.0);
  }
  ASSERT_FALSE(last->sources.sources.empty());
  EXPECT_LT((last->sources.sources.front().p_W - Eigen::Vector3d(6.25, 13.25, 0)).norm(), 1.0);
  EXPECT_EQ(last->sources.estimator, "mlem");
  EXPECT_GT(last->sources.coverage, 0.5);
  EXPECT_EQ(last->map.size(), 1600u / kMaxCellsPerTile + 1);
}

TEST(Coordinator, ReportsPointSourcesWithIntervalsOfTheEstimatorJoint) {
  CoordinatorConfig config = small_config();
  config.estimator = "joint";
  const Cells cells = flat_cells(config.area, config.cell_m);
  EXPECT_THROW(Coordinator(config, cells, toy_table(), World::flat()), std::invalid_argument) << "without cones";
  Coordinator coordinator = make_coordinator(config);
  std::optional<Coordinator::Tick> last;
  Random random(8);
  for (MeasurementBatch& batch : some_mission(10)) {
    const Eigen::Vector3d to_source_W = Eigen::Vector3d(6.25, 13.25, 0) - batch.p_WD;
    batch.channels[0].singles = static_cast<int>(random.poisson(0.15 + 100.0 / to_source_W.squaredNorm()));
    coordinator.on_measurements(batch);
    while (auto tick = coordinator.tick_if_complete()) last = std::move(tick);
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->sources.estimator, "joint");
  ASSERT_EQ(last->sources.sources.size(), 1U);
  const SourceEstimate& source = last->sources.sources.front();
  EXPECT_LT((source.p_W - Eigen::Vector3d(6.25, 13.25, 0)).norm(), 0.5);
  EXPECT_GT(source.position_sigma_m.x(), 0.0);
  EXPECT_LT(source.activity_sigma_Bq, 0.2 * source.activity_Bq);
  EXPECT_GT(source.significance, 18.0);
  EXPECT_GE(last->sources.certificate, 0.0);
}

TEST(Coordinator, RefusesAndCountsWhatItShouldNotFold) {
  Coordinator coordinator = make_coordinator(small_config());
  const auto mission = some_mission(2);
  for (const MeasurementBatch& batch : mission) coordinator.on_measurements(batch);
  while (coordinator.tick_if_complete()) {
  }
  const auto before = std::vector<double>(coordinator.lambda_Bq().begin(), coordinator.lambda_Bq().end());
  const auto refused = [&](auto change, const std::string& name) {
    MeasurementBatch batch = mission.back();
    batch.key.number = 40;
    change(batch);
    coordinator.on_measurements(batch);
    EXPECT_EQ(counter(coordinator, name), 1) << name;
  };
  refused([](auto& b) { b.key.mission = 6; }, "batches_refused_mission");
  refused([](auto& b) { b.key.sender = 9; }, "batches_refused_sender");
  refused([](auto& b) { b.p_WD.x() = 1e5; }, "batches_refused_content");
  refused([](auto& b) { b.key.number = 39; }, "batches_duplicate");
  EXPECT_EQ(counter(coordinator, "batches_waiting"), 0);
  EXPECT_EQ(counter(coordinator, "batches_folded"), 120);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), coordinator.lambda_Bq().begin()));
}

TEST(Coordinator, GoesOnWithoutAMavWhenPatienceHasRunOut) {
  Coordinator coordinator = make_coordinator(small_config());
  EXPECT_FALSE(coordinator.tick_anyway()) << "nothing is there";
  int complete = 0, anyway = 0;
  for (const MeasurementBatch& batch : some_mission(10)) {
    if (batch.key.sender == 2 && batch.key.number >= 30) continue;  // it falls silent at 1.5 s
    coordinator.on_measurements(batch);
    if (batch.key.sender != 3 || batch.key.number % 20 != 19) continue;
    if (coordinator.tick_if_complete()) {
      ++complete;
      continue;
    }
    const auto tick = coordinator.tick_anyway();
    ASSERT_TRUE(tick);
    EXPECT_EQ(tick->state.basis[1].number, 29);
    EXPECT_EQ(tick->plans.size(), 3u) << "it is still told where to go";
    EXPECT_FALSE(coordinator.tick_anyway()) << "there are no later data";
    ++anyway;
  }
  EXPECT_EQ(complete, 1 + 6) << "nobody waits for it after gap_give_up_s";
  EXPECT_EQ(anyway, 3);
}

TEST(Coordinator, AnEarlyBirdWaitsForTheTeamButNotWithoutEnd) {
  Coordinator coordinator = make_coordinator(small_config());
  auto mission = some_mission(5);
  std::erase_if(mission, [](const MeasurementBatch& b) { return b.key.sender == 3; });
  for (const MeasurementBatch& batch : mission) coordinator.on_measurements(batch);
  EXPECT_FALSE(coordinator.tick_if_complete());
  const auto tick = coordinator.tick_anyway();
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->plans.size(), 2u);
}

/// Hands a mission over in its order of arrival and lets the coordinator tick when it can.
std::vector<Coordinator::Tick> run(Coordinator& coordinator, const std::vector<MeasurementBatch>& arrivals) {
  std::vector<Coordinator::Tick> ticks;
  for (const MeasurementBatch& batch : arrivals) {
    coordinator.on_measurements(batch);
    while (auto tick = coordinator.tick_if_complete()) ticks.push_back(std::move(*tick));
  }
  return ticks;
}

std::vector<Utime> seconds_of(const std::vector<Coordinator::Tick>& ticks) {
  std::vector<Utime> seconds;
  for (const auto& tick : ticks) seconds.push_back((tick.state.utime - kMissionStart) / kSecond_us);
  return seconds;
}

TEST(Coordinator, GoesOnAfterAPauseOfTheWholeTeam) {
  for (const Utime pause_s : {20, 660, 40'000}) {
    auto mission = some_mission(6);
    for (MeasurementBatch& batch : mission) batch.utime += batch.key.number < 60 ? 0 : pause_s * kSecond_us;
    Coordinator coordinator = make_coordinator(small_config());
    const auto ticks = run(coordinator, mission);
    EXPECT_EQ(seconds_of(ticks), (std::vector<Utime>{1, 2, 3, pause_s + 4, pause_s + 5, pause_s + 6})) << pause_s;
    EXPECT_EQ(counter(coordinator, "batches_folded"), 360) << pause_s;
    EXPECT_EQ(counter(coordinator, "mav1_strange_times"), 0) << pause_s;
  }
}

// Batches of one whose clock is wrong from the start, or from 5 s on, while the others go on as they did.
TEST(Coordinator, OneWrongClockOfThreeCostsNothing) {
  const auto right = some_mission(12);
  Coordinator undisturbed = make_coordinator(small_config());
  const auto expected = run(undisturbed, right);
  ASSERT_EQ(expected.size(), 12u);
  for (const Utime off_s : {-86'400, -300, 300, 86'400}) {
    for (const int from_number : {0, 100}) {
      auto mission = right;
      for (MeasurementBatch& batch : mission) {
        if (batch.key.sender == 2 && batch.key.number >= from_number) batch.utime += off_s * kSecond_us;
      }
      Coordinator coordinator = make_coordinator(small_config());
      const auto ticks = run(coordinator, mission);
      const std::string name = fmt::format("off {} s from number {}", off_s, from_number);
      ASSERT_EQ(seconds_of(ticks), seconds_of(expected)) << name;
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        // One that is far behind counts as lost for long: without plans it returns on its own.
        EXPECT_GE(ticks[i].plans.size(), off_s < 0 ? 2u : 3u) << name;
        EXPECT_TRUE(off_s < 0 || ticks[i].state.basis == expected[i].state.basis) << name << ", tick " << i;
      }
      EXPECT_EQ(counter(coordinator, "batches_folded"), 720) << name;
      EXPECT_GE(counter(coordinator, "mav2_strange_times"), 239 - from_number) << name;
      EXPECT_EQ(counter(coordinator, "mav1_strange_times"), 0) << name;
      EXPECT_NEAR(static_cast<double>(counter(coordinator, "mav2_ahead_ms")), 1e3 * static_cast<double>(off_s), 51.0);
    }
  }
}

TEST(Coordinator, OfTwoClocksTheEarlierOneCounts) {
  CoordinatorConfig config = small_config();
  config.mavs = {1, 2};
  auto mission = some_mission(6);
  std::erase_if(mission, [](const MeasurementBatch& batch) { return batch.key.sender == 3; });
  for (MeasurementBatch& batch : mission) batch.utime += batch.key.sender == 2 ? 300 * kSecond_us : 0;
  Coordinator coordinator = make_coordinator(config);
  const auto ticks = run(coordinator, mission);
  EXPECT_EQ(seconds_of(ticks).front(), 1);
  EXPECT_EQ(counter(coordinator, "mav2_strange_times"), counter(coordinator, "batches_folded") / 2);
  EXPECT_GE(ticks.size(), 5u);
}

TEST(Coordinator, AloneItFollowsItsOnlyClockWhereverItJumps) {
  CoordinatorConfig config = small_config();
  config.mavs = {1};
  auto mission = some_mission(60);
  std::erase_if(mission, [](const MeasurementBatch& batch) { return batch.key.sender != 1; });
  for (MeasurementBatch& batch : mission) {
    if (batch.key.number >= 400) batch.utime += 300 * kSecond_us;
    if (batch.key.number >= 800) batch.utime -= 3'600 * kSecond_us;
  }
  Coordinator coordinator = make_coordinator(config);
  const auto ticks = run(coordinator, mission);
  EXPECT_GE(ticks.size(), 59u) << "ticks do not go back, but on at the pace of the data";
  EXPECT_GE(counter(coordinator, "batches_folded"), 1'199);
}

// Else a MAV would be planned for from where it was until its clock has caught up.
TEST(Coordinator, KnowsWhereAMavIsAlsoAfterItsClockWasSetBack) {
  const auto plans_with = [](Utime set_back_s) {
    auto mission = some_mission(6);
    for (MeasurementBatch& batch : mission) {
      if (batch.key.sender != 2 || batch.key.number < 60) continue;
      batch.utime -= set_back_s * kSecond_us;
      batch.p_WD = {1.0, 19.0, 2.0};
    }
    Coordinator coordinator = make_coordinator(small_config());
    return run(coordinator, mission).back().plans;
  };
  const auto right = plans_with(0), set_back = plans_with(300);
  ASSERT_EQ(set_back.size(), 3u);
  ASSERT_FALSE(right[1].waypoints.empty()) << right[1].status;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(set_back[i].waypoints, right[i].waypoints) << "MAV " << i + 1;
  }
}

TEST(Coordinator, WithoutAStrategyThereAreNoPlansButAllElse) {
  CoordinatorConfig config = small_config();
  config.search.strategy = "none";
  Coordinator coordinator = make_coordinator(config);
  for (const MeasurementBatch& batch : some_mission(1)) coordinator.on_measurements(batch);
  const auto tick = coordinator.tick_if_complete();
  ASSERT_TRUE(tick);
  EXPECT_TRUE(tick->plans.empty());
  EXPECT_FALSE(tick->map.empty());
}

TEST(Coordinator, PublishesTheMapAtItsPeriod) {
  CoordinatorConfig config = small_config();
  config.map_period_s = 3.0;
  Coordinator coordinator = make_coordinator(config);
  std::vector<bool> maps;
  for (const MeasurementBatch& batch : some_mission(7)) {
    coordinator.on_measurements(batch);
    while (const auto tick = coordinator.tick_if_complete()) maps.push_back(!tick->map.empty());
  }
  EXPECT_EQ(maps, (std::vector<bool>{true, false, false, true, false, false, true}));
}

TEST(Coordinator, RefusesToBeMadeOfNothing) {
  CoordinatorConfig config = small_config();
  config.mavs.clear();
  EXPECT_THROW(make_coordinator(config), std::invalid_argument);
  config = small_config();
  config.estimator = "guess";
  EXPECT_THROW(make_coordinator(config), std::invalid_argument);
  EXPECT_THROW(Coordinator(small_config(), Cells(0.5, {}), toy_table(), World::flat()), std::invalid_argument);
}

TEST(Coordinator, RefusesTheResponseTableOfAnotherNuclide) {
  const CoordinatorConfig config = small_config();
  const auto make = [&](const std::string& nuclide) {
    const ResponseTable table(toy_table().entries(), {{"nuclide", nuclide}});
    Coordinator(config, flat_cells(config.area, config.cell_m), table, World::flat());
  };
  EXPECT_NO_THROW(make("Cs-137"));
  EXPECT_THROW(make("Co-60"), std::invalid_argument);
}

}  // namespace
}  // namespace comptonaut
