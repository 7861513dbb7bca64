// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "radiation/cone_row.h"
#include "radiation/joint_estimator.h"
#include "radiation/joint_map.h"
#include "radiation/joint_world.h"
#include "radiation/mlem.h"
#include "radiation/sensitivity.h"
#include "radiation/sensitivity_error.h"

namespace comptonaut {
namespace {

/// The published field: 10^4 cells.
const Cells& field() {
  static const Cells cells = flat_cells({0, 50, 0, 50}, 0.5);
  return cells;
}

void flat_response(const float*, const float*, const float*, float* value, std::size_t n) {
  std::fill_n(value, n, 3e-8F);
}

Cone some_cone(Random& random) {
  const Eigen::Vector3d p_WS(random.uniform(0, 50), random.uniform(0, 50), 2.0);
  const Eigen::Vector3d u_W = (Eigen::Vector3d(random.uniform(0, 50), random.uniform(0, 50), 0) - p_WS).normalized();
  const Eigen::Vector3d axis_W = random.unit_vector();
  return {.p_WS = p_WS, .axis_W = axis_W, .cos_beta = axis_W.dot(u_W)};
}

SystemRows some_rows(std::size_t n) {
  const CellBlocks cells(field());
  Random random(1);
  SparseRow row;
  SystemRows rows(cells.size);
  while (rows.size() < n) {
    fill_cone_row(cells, flat_response, {}, some_cone(random), Eigen::Quaterniond::Identity(), row);
    rows.add(row);
  }
  return rows;
}

double stored_share(const SystemRows& rows) {
  std::size_t values = 0;
  for (const SystemRows::Tile& tile : rows.tiles()) {
    for (const PackedRows& panel : tile) values += panel.values.size();
  }
  return static_cast<double>(values) / static_cast<double>(rows.size() * rows.cells());
}

void sensitivity_of_a_viewpoint(benchmark::State& state) {
  const CellCentres cells(field());
  std::vector<double> s(padded(cells.size), 0.0);
  const Viewpoint viewpoint{.p_WD = {20, 30, 2}, .live_s = 0.05};
  for (auto _ : state) add_sensitivity(cells, flat_response, 0.0093, viewpoint, s);
}
BENCHMARK(sensitivity_of_a_viewpoint)->Unit(benchmark::kMicrosecond);

void row_of_a_cone(benchmark::State& state) {
  const CellBlocks cells(field());
  Random random(1);
  SparseRow row;
  SystemRows rows(cells.size);
  for (auto _ : state) {
    fill_cone_row(cells, flat_response, {}, some_cone(random), Eigen::Quaterniond::Identity(), row);
    rows.add(row);
  }
}
BENCHMARK(row_of_a_cone)->Unit(benchmark::kMicrosecond)->Iterations(1000);

/// 10^4 cells, so many rows, 10 iterations.
void mlem_update(benchmark::State& state) {
  const SystemRows rows = some_rows(static_cast<std::size_t>(state.range(0)));
  const std::vector<double> s(padded(rows.cells()), 1e-7);
  for (auto _ : state) benchmark::DoNotOptimize(mlem(rows, s, 10));
  state.counters["stored"] = stored_share(rows);
}
BENCHMARK(mlem_update)->Unit(benchmark::kMillisecond)->Arg(100)->Arg(1000)->Arg(2500)->Arg(10000);

/// Cold: the rows of so many cones and 10 iterations. sigma 5 degrees, everything above 10^-3 of each row's maximum.
void mlem_cold(benchmark::State& state) {
  const CellBlocks cells(field());
  const MlemConfig config{.cone_sigma_rad = 5.0 * std::numbers::pi / 180.0, .row_cut = 1e-3};
  const std::vector<double> s(padded(cells.size), 1e-7);
  Random random(1);
  std::vector<Cone> cones;
  while (std::ssize(cones) < state.range(0)) cones.push_back(some_cone(random));
  for (auto _ : state) {
    SparseRow row;
    SystemRows rows(cells.size);
    for (const Cone& cone : cones) {
      fill_cone_row(cells, flat_response, config, cone, Eigen::Quaterniond::Identity(), row);
      rows.add(row, config.row_cut);
    }
    benchmark::DoNotOptimize(mlem(rows, s, 10));
    state.counters["stored"] = stored_share(rows);
  }
}
BENCHMARK(mlem_cold)->Unit(benchmark::kMillisecond)->Arg(1000)->Arg(10000);

/// What three drones measure of five sources on 50 x 50 m while they fly a square of `edge_m`, 2 m high. A viewpoint
/// without a pair may get one from nowhere, so that there are at least as many pairs as viewpoints.
std::vector<MeasurementBatch> some_mission(const JointPhysics& physics, double edge_m, std::size_t viewpoints,
                                           bool more_pairs = true) {
  Random random(7);
  ToyField toy;
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d p_W(random.uniform(2, 48), random.uniform(2, 48), 0);
    toy.sources.push_back({.p_W = p_W, .activity_Bq = 2e9});
  }
  const double lane_m = 0.08 * edge_m;
  std::vector<MeasurementBatch> batches;
  for (std::size_t v = 0; v < viewpoints; ++v) {
    const double along_m = 0.4 * static_cast<double>(v), lane = std::floor(along_m / edge_m);
    const Eigen::Vector3d p_WD(along_m - lane * edge_m, std::fmod(0.7 + lane_m * lane, edge_m), 2.0);
    batches.push_back(toy.measure(physics, 1 + static_cast<int>(3 * v / viewpoints), p_WD, random));
    std::vector<Cone>& cones = batches.back().cones;
    while (more_pairs && cones.size() < 2) {
      cones.push_back(
          {.p_WS = p_WD, .axis_W = random.unit_vector(), .cos_beta = random.uniform(-0.5, 0.9), .weight = 0.5});
    }
  }
  return batches;
}

/// A map warm on all but the last 100 pairs takes them and the viewpoints between: extend and update, to a gain below
/// 10^-3 in the last step or 200 steps.
void joint_map_in_flight(benchmark::State& state) {
  const JointPhysics physics = toy_physics();
  const JointConfig joint;
  JointData data;
  const JointProblem problem{.config = joint, .physics = physics, .data = data};
  const std::vector<MeasurementBatch> batches = some_mission(physics, 50.0, 10000);
  std::size_t next = 0;
  const auto measure = [&](std::size_t pairs) {
    for (; next < batches.size() && data.pairs.size() < pairs; ++next) add(data, batches[next], "Cs-137");
  };
  measure(9900);
  JointModel model;
  model.drones.resize(data.senders.size());
  JointMap warm({}, field());
  warm.extend(physics, data);
  for (int i = 0; i < 5; ++i) (void)warm.update(problem, model, {});
  measure(10000);
  model.drones.resize(data.senders.size());
  Convergence reached;
  for (auto _ : state) {
    state.PauseTiming();
    JointMap map = warm;
    state.ResumeTiming();
    map.extend(physics, data);
    reached = map.update(problem, model, {});
  }
  state.counters["steps"] = reached.steps;
  state.counters["gain"] = reached.gain;
}
BENCHMARK(joint_map_in_flight)->Unit(benchmark::kMillisecond);

/// The whole update of the joint estimator, with sources and their intervals, of three drones that see five sources, at
/// 200 s and the ten seconds after, each with its new batches.
void joint_update_at_200_s(benchmark::State& state) {
  constexpr std::size_t kPerSecond = 60;
  const JointPhysics physics = toy_physics();
  const std::vector<MeasurementBatch> batches = some_mission(physics, 50.0, 211 * kPerSecond, false);
  const Cells cells = flat_cells({0.0, 50.0, 0.0, 50.0}, 0.5);
  JointEstimator estimator({}, cells, "Cs-137", toy_table(), toy_cones());
  std::size_t next = 0, pairs = 0;
  const auto add_a_second = [&] {
    for (std::size_t i = 0; i < kPerSecond; ++i, ++next) {
      estimator.add(batches[next]);
      pairs += batches[next].cones.size() / 2;
    }
  };
  while (next < 200 * kPerSecond) {
    add_a_second();
    estimator.update();
  }
  for (auto _ : state) {
    add_a_second();
    estimator.update();
  }
  state.counters["pairs"] = static_cast<double>(pairs);
  state.counters["sources"] = static_cast<double>(estimator.sources().size());
}
BENCHMARK(joint_update_at_200_s)->Unit(benchmark::kMillisecond)->Iterations(10);

/// Taking in one viewpoint, and one step of the map, with 10^4 viewpoints over a square of so many cells along an edge.
void joint_map_of_cells(benchmark::State& state) {
  const double edge_m = 0.5 * static_cast<double>(state.range(0));
  JointPhysics physics = toy_physics();
  physics.response = SmoothResponse(ResponseTable::load(COMPTONAUT_SOURCE_DIR "/config/response/cs-137.csv"));
  const JointConfig joint;
  const Cells cells = flat_cells({0, edge_m, 0, edge_m}, 0.5);
  JointData data;
  for (const MeasurementBatch& batch : some_mission(physics, edge_m, static_cast<std::size_t>(state.range(1)))) {
    add(data, batch, "Cs-137");
  }
  JointModel model;
  model.drones.resize(data.senders.size());
  JointMapConfig config;
  config.steps_max = 1;
  JointMap map(config, cells);
  const auto start = std::chrono::steady_clock::now();
  map.extend(physics, data);
  const double extend_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const JointProblem problem{.config = joint, .physics = physics, .data = data};
  for (auto _ : state) (void)map.update(problem, model, {});
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
  state.counters["pairs"] = static_cast<double>(data.pairs.size());
  const SensitivityError error = sensitivity_error(map, cells, physics, data, model);
  state.counters["s_off_rms"] = error.rms;
  state.counters["s_off_worst"] = error.worst;
  state.counters["nodes"] = static_cast<double>(map.rows().tree().nodes().size());
  state.counters["extend_us_per_row"] =
      1e6 * extend_s / static_cast<double>(data.viewpoints.size() + data.pairs.size());
}
BENCHMARK(joint_map_of_cells)
    ->Unit(benchmark::kMillisecond)
    ->ArgNames({"edge", "viewpoints"})
    ->Args({100, 300})
    ->Args({100, 1000})
    ->Args({100, 3000})
    ->Args({100, 10000})
    ->Args({200, 10000})
    ->Args({400, 10000})
    ->Args({800, 10000})
    ->Args({1600, 10000})
    ->Args({2000, 10000});

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
