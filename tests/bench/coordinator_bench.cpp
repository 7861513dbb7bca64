// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>

#include "nodes/coordinator_fixture.h"

namespace comptonaut {
namespace {

/// Three MAVs that fly their plans exactly at 8 m/s over the published field, and see cones of five sources: what a
/// coordinator costs in 300 s of mission, messages apart.
class Team {
 public:
  explicit Team(const CoordinatorConfig& config) : coordinator_(make_coordinator(config)), table_(toy_table()) {
    for (int mav = 0; mav < 3; ++mav) p_WD_.emplace_back(2.0 + 4.0 * mav, 2.0, 2.0);
    for (int i = 0; i < 5; ++i) sources_W_.emplace_back(random_.uniform(3, 47), random_.uniform(3, 47), 0.0);
    plans_.resize(3);
  }

  void fly_a_second() {
    for (int i = 0; i < 20; ++i, ++number_) {
      for (std::size_t mav = 0; mav < 3; ++mav) {
        move(p_WD_[mav], plans_[mav]);
        coordinator_.on_measurements(batch(mav));
      }
    }
    while (const auto tick = coordinator_.tick_if_complete()) {
      for (const Plan& plan : tick->plans) plans_[static_cast<std::size_t>(plan.mav) - 1] = plan.waypoints;
    }
  }

  [[nodiscard]] std::int64_t cones() const { return counter(coordinator_, "cones"); }

 private:
  static void move(Eigen::Vector3d& p_W, std::vector<Waypoint>& plan) {
    double left_m = 0.4;
    while (!plan.empty() && left_m > 0.0) {
      const Eigen::Vector3d way_W = plan.front().p_W - p_W;
      const double go_m = std::min(left_m, way_W.norm());
      if (go_m > 0.0) p_W += way_W.normalized() * go_m;
      left_m -= go_m;
      if (go_m == way_W.norm()) plan.erase(plan.begin());
    }
  }

  MeasurementBatch batch(std::size_t mav) {
    MeasurementBatch batch{.key = {.mission = 5, .sender = static_cast<std::int32_t>(mav) + 1, .number = number_}};
    batch.utime = kMissionStart + number_ * kBatch_us;
    batch.live_us = 50'000;
    batch.p_WD = p_WD_[mav];
    batch.channels = {{.nuclide = "Cs-137"}};
    for (const Eigen::Vector3d& source_W : sources_W_) {
      const Eigen::Vector3d way_W = source_W - batch.p_WD;
      const double expected = 0.05 * 2e9 * table_.pair(way_W) / way_W.squaredNorm();
      for (auto n = random_.poisson(expected); n > 0 && batch.cones.size() < kMaxConesPerBatch; --n) {
        batch.cones.push_back(noiseless_cone(batch.p_WD, source_W, random_));
      }
    }
    return batch;
  }

  Coordinator coordinator_;
  ResponseTable table_;
  Random random_{71};
  std::vector<Eigen::Vector3d> p_WD_, sources_W_;
  std::vector<std::vector<Waypoint>> plans_;
  std::int64_t number_ = 0;
};

void mission_of_300_s(benchmark::State& state, const std::string& strategy) {
  CoordinatorConfig config{.mission = 5, .estimator = "mlem"};
  config.search.strategy = strategy;
  for (auto _ : state) {
    Team team(config);
    for (int t = 0; t < 300; ++t) team.fly_a_second();
    state.counters["cones"] = static_cast<double>(team.cones());
  }
}
BENCHMARK_CAPTURE(mission_of_300_s, werner2024, "werner2024")->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK_CAPTURE(mission_of_300_s, zigzag, "zigzag")->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
