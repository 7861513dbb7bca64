// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "report/mission_recorder.h"
#include "report/synthetic_mission.h"

namespace comptonaut {
namespace {

constexpr Utime kStart = kSyntheticStart;

MeasurementBatch batch(int mav, std::int64_t number, int singles = 1) {
  MeasurementBatch b{.key = {.mission = 1, .sender = mav, .boot_epoch = 7, .number = number},
                     .utime = kStart + number * kBatch_us,
                     .live_us = 40'000,
                     .others = 2};
  b.channels = {{.nuclide = "Cs-137", .singles = singles, .pairs = 3}, {.nuclide = "Co-60", .singles = 10, .pairs = 0}};
  return b;
}

StampedPose pose_at(double t_s, double x_m, double y_m) {
  StampedPose pose{.utime = kStart + static_cast<Utime>(t_s * 1e6)};
  pose.p_WB = {x_m, y_m, 2.0};
  return pose;
}

MapTile tile(Utime utime, std::vector<MapCell> cells) {
  return {.mission = 1,
          .utime = utime,
          .nuclide = "Cs-137",
          .cell_m = 0.5,
          .tile = 0,
          .tiles = 1,
          .cells = std::move(cells)};
}

TEST(MissionRecorder, SumsOfSecondsAreTheTotalOfAllBatches) {
  const auto sent = synthetic_mission({.seed = 3, .duration_s = 7, .edge_m = 20});
  const MissionRecord record = record_of(sent);
  ASSERT_EQ(record.drones.size(), 3u);
  for (const auto& [mav, drone] : record.drones) {
    EventSums expected;
    for (const Sent& one : sent) {
      const auto* b = std::get_if<MeasurementBatch>(&one.message);
      if (b == nullptr || b->key.sender != mav) continue;
      expected.live_us += b->live_us;
      expected.singles += b->channels[0].singles;
    }
    std::int64_t live_us = 0, singles = 0;
    for (const auto& [utime, sums] : drone.seconds) {
      EXPECT_EQ(utime % kSecond_us, 0) << "mav " << mav;
      live_us += sums.live_us;
      singles += sums.singles;
    }
    EXPECT_EQ(live_us, expected.live_us) << "mav " << mav;
    EXPECT_EQ(singles, expected.singles) << "mav " << mav;
    EXPECT_EQ(drone.total.singles, singles) << "mav " << mav;
    EXPECT_EQ(drone.seconds.size(), 7u) << "mav " << mav;
    EXPECT_EQ(drone.batches_missing, 0) << "mav " << mav;
  }
}

TEST(MissionRecorder, CountsEachBatchOnceAndNamesTheMissing) {
  MissionRecorder recorder;
  for (const std::int64_t number : {5, 6, 9, 6, 5, 11}) recorder.on_measurements(batch(2, number));
  const MissionRecord record = std::move(recorder).finish();
  const DroneRecord& drone = record.drones.at(2);
  EXPECT_EQ(drone.batches, 4);
  EXPECT_EQ(drone.batches_repeated, 2);
  EXPECT_EQ(drone.batches_missing, 3);
  EXPECT_EQ(drone.total.singles, 4 * 11);
  EXPECT_EQ(drone.total.pairs, 4 * 3);
  EXPECT_EQ(drone.total.others, 4 * 2);
}

TEST(MissionRecorder, ANewBootEpochIsNoGap) {
  MissionRecorder recorder;
  recorder.on_measurements(batch(1, 1000));
  MeasurementBatch after = batch(1, 0);
  after.key.boot_epoch = 8;
  recorder.on_measurements(after);
  EXPECT_EQ(std::move(recorder).finish().drones.at(1).batches_missing, 0);
}

TEST(MissionRecorder, AHoveringDroneFliesNoDistance) {
  MissionRecorder recorder;
  Random random(4);
  for (int i = 0; i < 1000; ++i) recorder.on_pose(1, pose_at(0.02 * i, 0.02 * random.normal(), 0.02 * random.normal()));
  for (int i = 0; i < 100; ++i) recorder.on_pose(1, pose_at(20 + 0.1 * i, 0.3 * i, 0.4 * i));
  EXPECT_NEAR(std::move(recorder).finish().drones.at(1).distance_m, 0.5 * 99, 0.6);
}

TEST(MissionRecorder, WithoutPosesTheBatchesTellTheTrack) {
  MissionRecorder recorder;
  for (int i = 0; i < 40; ++i) {
    MeasurementBatch b = batch(1, i);
    b.p_WD = {1.0 * i, 0, 2};
    recorder.on_measurements(b);
  }
  const MissionRecord record = std::move(recorder).finish();
  EXPECT_EQ(record.drones.at(1).track.size(), 40u);
  EXPECT_NEAR(record.drones.at(1).distance_m, 39.0, 1e-9);
}

TEST(MissionRecorder, TheNearestDroneIsTheSameSeenFromBoth) {
  MissionRecorder recorder;
  for (int i = 0; i <= 100; ++i) {
    recorder.on_pose(1, pose_at(0.1 * i, 0.1 * i, 0));
    recorder.on_pose(2, pose_at(0.1 * i, 10 - 0.1 * i, 3));
    recorder.on_pose(3, pose_at(0.1 * i, 100, 100));
  }
  const MissionRecord record = std::move(recorder).finish();
  const NearestDrone one = record.drones.at(1).nearest, two = record.drones.at(2).nearest;
  EXPECT_NEAR(one.distance_m, 3.0, 0.01);
  EXPECT_EQ(one.distance_m, two.distance_m);
  EXPECT_EQ(one.mav, 2);
  EXPECT_EQ(two.mav, 1);
  EXPECT_NEAR(record.t_s(one.utime), 5.0, 0.11);
}

TEST(MissionRecorder, PosesOfDifferentMomentsAreNotCompared) {
  MissionRecorder recorder;
  recorder.on_pose(1, pose_at(0, 0, 0));
  recorder.on_pose(2, pose_at(3, 0, 0));
  EXPECT_TRUE(std::isinf(std::move(recorder).finish().drones.at(1).nearest.distance_m));
}

TEST(MissionRecorder, KeepsAPlanOnlyWhereItIsNotTheRestOfTheOneBefore) {
  MissionRecorder recorder;
  const auto plan = [](int t_s, const std::vector<double>& xs) {
    Plan p{.utime = kStart + t_s * kSecond_us, .mav = 1};
    for (const double x : xs) p.waypoints.push_back({.p_W = {x, 0, 2}});
    return p;
  };
  recorder.on_plan(1, plan(0, {1, 2, 3}));
  recorder.on_plan(1, plan(1, {1, 2, 3}));
  recorder.on_plan(1, plan(2, {2, 3}));
  recorder.on_plan(1, plan(3, {2, 4}));
  recorder.on_plan(1, plan(4, {}));
  const MissionRecord record = std::move(recorder).finish();
  ASSERT_EQ(record.drones.at(1).plans.size(), 3u);
  EXPECT_EQ(record.drones.at(1).plans[1].utime, kStart + 3 * kSecond_us);
  EXPECT_TRUE(record.drones.at(1).plans[2].waypoints.empty()) << "hold";
}

TEST(MissionRecorder, PoseErrorIsTheDistanceFromTheTruth) {
  MissionRecorder recorder;
  for (int i = 0; i < 20; ++i) {
    recorder.on_pose(1, pose_at(i, 1, 1));
    Truth truth{.utime = kStart + i * kSecond_us, .start_utime = kStart};
    truth.mavs = {{.mav = 1, .p_WB = {1.3, 1.4, 2.0}}};
    recorder.on_truth(truth);
  }
  const MissionRecord record = std::move(recorder).finish();
  EXPECT_EQ(record.messages, 40) << "one that tells two times counts once";
  const PoseRecord& pose = record.drones.at(1).pose;
  EXPECT_EQ(pose.errors, 20);
  EXPECT_NEAR(std::sqrt(pose.error_sum_m2 / 20), 0.5, 1e-9);
}

TEST(MissionRecorder, LeavesOutWhatIsDatedFarFromTheRest) {
  MissionRecorder recorder;
  recorder.on_measurements(batch(1, 0));
  for (const Utime utime : {Utime{0}, std::numeric_limits<Utime>::min(), std::numeric_limits<Utime>::max()}) {
    MeasurementBatch wrong = batch(1, 50);
    wrong.utime = utime;
    recorder.on_measurements(wrong);
  }
  recorder.on_truth({.utime = kStart, .start_utime = 0});
  const MissionRecord record = std::move(recorder).finish();
  EXPECT_EQ(record.drones.at(1).batches, 1);
  EXPECT_EQ(record.out_of_time, 4);
  EXPECT_EQ(record.messages, 1);
  EXPECT_FALSE(record.truth);
  EXPECT_LT(record.duration_s(), 1.0);
}

TEST(MissionRecorder, MergesTheCountersThatADaemonSendsInParts) {
  MissionRecorder recorder;
  DaemonStatus status{.sender = 0, .daemon = "coordinator", .version = "1", .state = "running", .counters = {{"a", 1}}};
  recorder.on_status(0, status);
  status.counters = {{"b", 2}};
  recorder.on_status(0, status);
  status.counters = {{"a", 3}};
  recorder.on_status(0, status);
  const MissionRecord record = std::move(recorder).finish();
  EXPECT_EQ(record.daemons.at("ground coordinator").counters,
            (std::map<std::string, std::int64_t>{{"a", 3}, {"b", 2}}));
}

TEST(MissionRecorder, AMapIsPutTogetherOfTilesInAnyOrderAndSize) {
  const MissionRecord whole = record_of(synthetic_mission({.seed = 5, .duration_s = 2, .edge_m = 20}));
  std::vector<Sent> shuffled = synthetic_mission({.seed = 5, .duration_s = 2, .edge_m = 20});
  std::stable_sort(shuffled.begin(), shuffled.end(), [](const Sent& a, const Sent& b) {
    const auto* one = std::get_if<MapTile>(&a.message);
    const auto* two = std::get_if<MapTile>(&b.message);
    return one != nullptr && two != nullptr && one->utime == two->utime && one->tile > two->tile;
  });
  const MissionRecord record = record_of(shuffled);
  EXPECT_EQ(record.map.grid, (MapGrid{0.5, 0, 0, 40, 40}));
  EXPECT_EQ(record.map.frames.size(), 3u);
  EXPECT_EQ(record.map.lambda_Bq, whole.map.lambda_Bq);
  EXPECT_EQ(record.map.frames[1].lambda_level, whole.map.frames[1].lambda_level);
}

TEST(MissionRecorder, WhatNoTileOfATickTellsStaysAsItWas) {
  MissionRecorder recorder;
  recorder.on_map(tile(kStart, {{{3, 4, -1}, 1e6, 0.5}, {{4, 4, -1}, 1e5, 0.5}}));
  recorder.on_map(tile(kStart + kSecond_us, {{{4, 4, -1}, 7.0, 0.7}}));
  recorder.on_map(tile(kStart, {{{4, 4, -1}, 1e9, 9.0}}));
  const MissionRecord record = std::move(recorder).finish();
  EXPECT_EQ(record.map.lambda_Bq, (std::vector<float>{1e6f, 7.0f}));
  EXPECT_EQ(record.map.late_tiles, 1);
  ASSERT_EQ(record.map.frames.size(), 2u);
  EXPECT_EQ(record.map.frames[0].lambda_level[1], lambda_level(1e5));
}

TEST(MissionRecorder, TheShareThatIsSearchedIsTheCoverageThatIsReported) {
  MissionRecorder recorder;
  recorder.on_sources({.utime = kStart, .coverage = 0.5});
  std::vector<MapCell> cells;
  for (int x = 0; x < 10; ++x) cells.push_back({{x, 0, -1}, 1e6, 0.1 * ((7 * x) % 10)});
  recorder.on_map(tile(kStart, cells));
  const MissionRecord record = std::move(recorder).finish();
  for (int x = 0; x < 10; ++x) EXPECT_EQ(record.map.frames[0].searched[x], (7 * x) % 10 >= 5) << "cell " << x;
}

TEST(MissionRecorder, KeepsOneMapPerNuclideAsIfEachWereAlone) {
  MissionRecorder both, alone, other_alone;
  for (int t = 0; t < 3; ++t) {
    const Utime utime = kStart + t * kSecond_us;
    MapTile other = tile(utime, {{{0, 0, 0}, 1e5 + t, 2}, {{1, 0, 0}, 30.0 + t, 1}});
    other.nuclide = "Co-60-1332";
    const MapTile first = tile(utime, {{{0, 0, 0}, 1e6 + t, 1}, {{1, 0, 0}, 7.0 + t, 3}});
    both.on_map(first), both.on_map(other);
    alone.on_map(first), other_alone.on_map(other);
  }
  const MissionRecord record = std::move(both).finish();
  const MapRecord first = std::move(alone).finish().map, other = std::move(other_alone).finish().map;
  ASSERT_EQ(record.more_maps.size(), 1u);
  EXPECT_EQ(record.more_maps[0].nuclide, "Co-60-1332");
  for (const auto& [kept, whole] : {std::pair(&record.map, &first), std::pair(&record.more_maps[0], &other)}) {
    EXPECT_EQ(kept->lambda_Bq, whole->lambda_Bq) << whole->nuclide;
    EXPECT_EQ(kept->frames.size(), 3u) << whole->nuclide;
    EXPECT_EQ(kept->cells_left_out, 0) << whole->nuclide;
  }
}

TEST(MissionRecorder, AMapAcrossTheWorldIsRefusedNotAllocated) {
  MissionRecorder recorder;
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  recorder.on_map(tile(kStart, {{{0, 0, 0}, 1, 1}, {{kFar, kFar, 0}, 1, 1}, {{-kFar, 3, 0}, 1, 1}, {{1, 1, 0}, 1, 1}}));
  const MissionRecord record = std::move(recorder).finish();
  EXPECT_EQ(record.map.grid.size(), 4u);
  EXPECT_EQ(record.map.cells_left_out, 2);
}

TEST(LambdaLevel, RisesWithLambdaTwentyADecade) {
  EXPECT_EQ(lambda_level(0.0), 0);
  EXPECT_EQ(lambda_level(std::nan("")), 0);
  EXPECT_EQ(lambda_level(1e9) - lambda_level(1e8), kLevelsPerDecade);
  EXPECT_EQ(lambda_level(1e300), 254);
}

}  // namespace
}  // namespace comptonaut
