// SPDX-License-Identifier: BSD-3-Clause
// The simulated detector in front of the real detector-reader.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "nodes/detector_reader.h"
#include "response/response_table.h"
#include "sim/sim_detector.h"
#include "test_camera.h"

namespace comptonaut {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kHeight_m = 2.0;

const SimCamera& camera() {
  static const SimCamera shared = test_camera();
  return shared;
}

struct Counted {
  std::int64_t singles = 0, pairs = 0, photons = 0;
  double live_s = 0.0;
  std::map<std::string, std::int64_t> counters;
};

/// What the reader makes of a camera that hovers 2 m above (0, 0).
Counted read(const Scenario& scenario, const std::vector<Emitter>& emitters, double duration_s) {
  SimDetector detector(camera(), scenario, emitters, 1, 1);
  DetectorReaderConfig config;
  config.rules.channels = {camera().channel};
  DetectorReader reader(config, Calibration::uniform(), {.mission = 1, .sender = 1});
  Counted counted;
  const auto take = [&](const std::vector<EventBatch>& batches) {
    for (const EventBatch& batch : batches) {
      counted.singles += batch.channels.at(0).singles;
      counted.pairs += batch.channels.at(0).pairs;
      counted.live_s += seconds(batch.live_us);
    }
  };
  const Eigen::Isometry3d X_WB(Eigen::Translation3d(0, 0, kHeight_m + 0.05));
  take(reader.on_bytes(detector.start(1'700'000'000 * kSecond_us)));
  for (int i = 0; i * kStep_s < duration_s; ++i) take(reader.on_bytes(detector.step(X_WB, i * kStep_s, kStep_s)));
  take(reader.on_end());
  counted.photons = detector.photons();
  for (const Counter& counter : reader.counters()) counted.counters[counter.name] = counter.value;
  return counted;
}

Scenario quiet() {
  Scenario scenario = idealised({});
  scenario.background_singles_per_s = 0.0;
  return scenario;
}

TEST(SimulatedDetector, GivesTheEventsThatTheResponseTablePredicts) {
  const auto table = ResponseTable::load(std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "config/response/cs-137.csv");
  constexpr double kActivity_Bq = 2e9, kDuration_s = 20.0;
  for (const Eigen::Vector3d& p_W : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 2, 0), Eigen::Vector3d(-1, 4, 0)}) {
    const Scenario scenario = quiet();
    const Counted counted =
        read(scenario, {{.p_W = p_W, .photons_per_s = kActivity_Bq * camera().channel.branching}}, kDuration_s);
    const Eigen::Vector3d d_W = p_W - Eigen::Vector3d(0, 0, kHeight_m);
    const Eigen::Vector3d u_D = camera().X_BD.linear().transpose() * d_W.normalized();
    const double decays_at_1m = kActivity_Bq * kDuration_s * std::exp(-0.0093 * d_W.norm()) / d_W.squaredNorm();
    const double singles = table.single(u_D) * decays_at_1m, pairs = table.pair(u_D) * decays_at_1m;
    // The table is the value of the nearest direction: some percent away from this one.
    EXPECT_NEAR(counted.singles, singles, 0.04 * singles + 4.0 * std::sqrt(singles)) << p_W.transpose();
    EXPECT_NEAR(counted.pairs, pairs, 0.10 * pairs + 4.0 * std::sqrt(pairs)) << p_W.transpose();
    EXPECT_NEAR(counted.live_s, kDuration_s, 2e-4 * kDuration_s) << "less what piles up at some 1000 photons a second";
  }
}

TEST(SimulatedDetector, BackgroundAndScatterAreSinglesAtTheirRates) {
  Scenario scenario = quiet();
  scenario.background_singles_per_s = 300.0;
  const Counted background = read(scenario, {}, 20.0);
  EXPECT_NEAR(background.singles, 6000, 0.05 * 6000);
  EXPECT_LT(background.pairs, 20);

  scenario = quiet();
  const std::vector<Emitter> source = {{.p_W = {0, 0, 0}, .photons_per_s = 2e9}};
  const Counted bare = read(scenario, source, 10.0);
  scenario.mismatch.scatter_share = 0.5;
  const Counted scattered = read(scenario, source, 10.0);
  EXPECT_EQ(scattered.photons, bare.photons);
  const double added = 0.5 * bare.photons;
  EXPECT_NEAR(scattered.singles - bare.singles, added, 0.03 * added + 4.0 * std::sqrt(added));
  EXPECT_NEAR(scattered.pairs, bare.pairs, 3.0 * std::sqrt(bare.pairs));
}

class Trapped : public testing::Test {
 protected:
  Counted read_with(const Traps& traps) {
    Scenario scenario = quiet();
    scenario.background_singles_per_s = 4000.0;  // so that a fault takes an event past its neighbours
    scenario.traps = traps;
    return read(scenario, {}, 5.0);
  }
  const Counted clean = read_with({});
};

TEST_F(Trapped, ZeroToTIsCountedByTheReader) {
  const Counted counted = read_with({.tot_zero_share = 0.05});
  EXPECT_NEAR(static_cast<double>(counted.counters.at("rows_zero_tot")) / clean.counters.at("hits"), 0.05, 0.01);
}

TEST_F(Trapped, LostDataAreDeadTime) {
  const Counted counted = read_with({.lost_data_per_s = 5.0, .lost_data_s = 0.003});
  const auto gaps = static_cast<double>(counted.counters.at("lost_data_gaps"));
  EXPECT_NEAR(gaps, 25, 20);
  EXPECT_NEAR(clean.live_s - counted.live_s, gaps * 0.003, 1e-3);
}

TEST_F(Trapped, EpochFaultsAreRepaired) {
  const Counted counted = read_with({.epoch_fault_share = 0.02});
  const double hits = clean.counters.at("hits");
  EXPECT_NEAR(counted.counters.at("hits_repaired") / hits, 0.02, 0.01);
  EXPECT_NEAR(counted.singles, clean.singles, 0.01 * clean.singles);
}

TEST_F(Trapped, BrokenRowsAreCountedAndLeftOut) {
  const Counted counted = read_with({.broken_rows_per_s = 50.0});
  EXPECT_EQ(counted.singles, clean.singles);
  EXPECT_GT(counted.counters.at("rows_pixel_range"), 50);
}

TEST_F(Trapped, HotPixelsAddRowsButHardlySingles) {
  const Counted counted = read_with({.hot_pixels = 2, .hot_pixel_hits_per_s = 200.0});
  EXPECT_NEAR(counted.counters.at("hits") - clean.counters.at("hits"), 2000, 200);
  EXPECT_NEAR(counted.singles, clean.singles, 0.01 * clean.singles);
}

}  // namespace
}  // namespace comptonaut
