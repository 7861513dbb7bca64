// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "radiation/cone_row.h"
#include "radiation/mlem.h"
#include "radiation/sensitivity.h"

namespace comptonaut {
namespace {

/// The published field: 10^4 cells.
const Cells& field() {
  static const Cells cells = flat_cells({0, 50, 0, 50}, 0.5);
  return cells;
}

void flat_response(const double*, const double*, const double*, double* value, std::size_t n) {
  std::fill_n(value, n, 3e-8);
}

Cone some_cone(Random& random) {
  const Eigen::Vector3d p_WS(random.uniform(0, 50), random.uniform(0, 50), 2.0);
  const Eigen::Vector3d u_W = (Eigen::Vector3d(random.uniform(0, 50), random.uniform(0, 50), 0) - p_WS).normalized();
  const Eigen::Vector3d axis_W = random.unit_vector();
  return {.p_WS = p_WS, .axis_W = axis_W, .cos_beta = axis_W.dot(u_W)};
}

SystemRows some_rows(std::size_t n) {
  const CellCentres cells(field());
  Random random(1);
  std::vector<float> row(padded(cells.size));
  SystemRows rows(cells.size);
  while (rows.rows().size() < n) {
    fill_cone_row(cells, flat_response, {}, some_cone(random), Eigen::Quaterniond::Identity(), row);
    rows.add(row);
  }
  return rows;
}

double stored_share(const SystemRows& rows) {
  std::size_t values = 0;
  for (const auto& row : rows.rows()) values += 4 * row.words.size();
  return static_cast<double>(values) / static_cast<double>(rows.rows().size() * rows.cells());
}

void sensitivity_of_a_viewpoint(benchmark::State& state) {
  const CellCentres cells(field());
  std::vector<double> s(padded(cells.size), 0.0);
  const Viewpoint viewpoint{.p_WD = {20, 30, 2}, .live_s = 0.05};
  for (auto _ : state) add_sensitivity(cells, flat_response, 0.0093, viewpoint, s);
}
BENCHMARK(sensitivity_of_a_viewpoint)->Unit(benchmark::kMicrosecond);

void row_of_a_cone(benchmark::State& state) {
  const CellCentres cells(field());
  Random random(1);
  std::vector<float> row(padded(cells.size));
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

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
