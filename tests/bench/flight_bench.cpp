// SPDX-License-Identifier: BSD-3-Clause
// What a replan costs on one core: 20 MAVs, 500 places to visit, a map of a million voxels.
#include <benchmark/benchmark.h>

#include "flight/team_flight.h"
#include "search/courses.h"
#include "search/share_by_time.h"
#include "world/voxels.h"

namespace comptonaut {
namespace {

/// 200 x 200 x 25 m in voxels of 1 m, with houses.
World houses() {
  Voxels voxels{.voxel_m = 1.0};
  for (int x = 0; x < 200; ++x) {
    for (int y = 0; y < 200; ++y) {
      const bool house = x % 25 < 8 && y % 20 < 7;
      const int height = house ? 4 + (x / 25 + y / 20) % 8 : 1;
      for (int z = 0; z < 25; ++z) voxels.known[{x, y, z}] = z < height ? Occupancy::kOccupied : Occupancy::kFree;
    }
  }
  const auto file = std::filesystem::temp_directory_path() / "comptonaut-flight-bench.bt";
  octree_of(voxels).writeBinary(file.string());
  World world = World::load(file);
  std::filesystem::remove(file);
  return world;
}

void replan(benchmark::State& state) {
  static const World world = houses();
  SearchConfig config;
  config.route.fence = {.border = polygon_of({1, 199, 1, 199}), .floor_m = 1.0, .ceiling_m = 24.0};
  config.route.expanded_max = 50000;  // as in config/coordinator.yaml
  Random random(1);
  std::vector<Searcher> mavs;
  std::vector<Eigen::Vector3d> starts_W, places_W;
  const auto free_place = [&] {
    for (;;) {
      const double x = random.uniform(3, 197), y = random.uniform(3, 197);
      const Eigen::Vector3d p_W(x, y, *world.ground_height_m(x, y) + 2.0);
      const Leg here{p_W, p_W};
      const auto hit = [&](const Box& box) { return sweep_meets(config.route.envelope, here, box); };
      if (!world.any_closed(bounds(config.route.envelope, here), hit)) return p_W;
    }
  };
  for (int mav = 1; mav <= 20; ++mav) {
    starts_W.emplace_back(10.0 + 5.0 * mav, 18.0, 3.0);
    mavs.push_back({.mav = mav, .p_W = starts_W.back(), .track_W = {starts_W.back()}});
  }
  for (int i = 0; i < 500; ++i) places_W.push_back(free_place());
  const Cells cells = world.surface_cells({0, 200, 0, 200}, 5.0);
  const std::vector<double> zeros(cells.size(), 0.0);
  const SearchState search{.cells = cells, .world = world, .lambda_Bq = zeros, .sensitivity_s = zeros, .mavs = mavs};
  const MotionLimits limits;
  double share_s = 0.0, course_s = 0.0, way_m = 0.0;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    Targets targets;
    const auto shares = share_by_time(starts_W, places_W, limits);
    for (std::size_t m = 0; m < mavs.size(); ++m) {
      for (const std::size_t p : shares[m]) targets[mavs[m].mav].push_back(places_W[p]);
    }
    const auto shared = std::chrono::steady_clock::now();
    const std::vector<Course> courses = make_courses(search, config, targets);
    const auto routed = std::chrono::steady_clock::now();
    std::vector<Flyer> flyers;
    for (std::size_t m = 0; m < mavs.size(); ++m) {
      flyers.push_back({.mav = mavs[m].mav, .now = {.p_W = mavs[m].p_W}, .course_W = courses[m].points_W});
      Eigen::Vector3d from_W = mavs[m].p_W;
      for (const Eigen::Vector3d& to_W : courses[m].points_W) way_m += (std::exchange(from_W, to_W) - to_W).norm();
    }
    TeamFlight team({.limits = limits});
    benchmark::DoNotOptimize(team.plan(world, config.route, flyers, kSecond_us));
    share_s += std::chrono::duration<double>(shared - begin).count();
    course_s += std::chrono::duration<double>(routed - shared).count();
  }
  const auto n = static_cast<double>(state.iterations());
  state.counters["share_ms"] = 1e3 * share_s / n;
  state.counters["courses_ms"] = 1e3 * course_s / n;
  state.counters["courses_m"] = way_m / n;
}
BENCHMARK(replan)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
