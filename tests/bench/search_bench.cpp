// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "search/information.h"
#include "search/search_fixture.h"

namespace comptonaut {
namespace {

/// One replan of the search for information, flights included, on a square field of so many metres with so many MAVs
/// and five known sources; a field of 50 m and 3 MAVs is werner2024-sim.
void information(benchmark::State& bench) {
  const auto edge_m = static_cast<double>(bench.range(0));
  Field field({0, edge_m, 0, edge_m}, 0.5);
  for (int mav = 1; mav <= bench.range(1); ++mav) field.add_mav(mav, 4.0 * mav, 1.0);
  std::vector<SourceEstimate> sources;
  for (int k = 0; k < 5; ++k) {
    sources.push_back({.nuclide = "Cs-137",
                       .p_W = {0.1 * edge_m * (2 * k + 1), 0.15 * edge_m * (k + 1), 0.0},
                       .activity_Bq = 2e9,
                       .position_sigma_m = {0.5, 0.5, 0.0}});
  }
  Information search({.strategy = "information"});
  for (auto _ : bench) {
    SearchState state = field.state();
    state.sources = sources;
    const auto courses = search.plan(state);
    bench.PauseTiming();
    field.fly(courses, 6.0, false);
    bench.ResumeTiming();
  }
}
BENCHMARK(information)->Args({50, 3})->Args({100, 3})->Args({200, 6})->Unit(benchmark::kMillisecond)->Iterations(30);

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
