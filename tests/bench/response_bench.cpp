// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <limits>

#include "response/cone_density.h"
#include "response/make_response.h"

namespace comptonaut {
namespace {

constexpr double kLine_keV = 661.657;
constexpr double kFar_m = std::numeric_limits<double>::infinity();

const Transport& transport() {
  static const Transport instance({}, load_cdte());
  return instance;
}

Eigen::Vector3d from(std::int64_t theta_deg) { return direction_D(0.3, static_cast<double>(theta_deg) * 0.0174532925); }

void BM_Transport(benchmark::State& state) {
  Random random(1);
  const Eigen::Vector3d u_D = from(state.range(0));
  for (auto _ : state) {
    const Photon photon = sample_entry(transport().block(), u_D, kFar_m, kLine_keV, random);
    benchmark::DoNotOptimize(transport().follow(photon, random));
  }
}
BENCHMARK(BM_Transport)->Arg(0)->Arg(90);

void BM_DigitizePhotonThatInteracted(benchmark::State& state) {
  Random random(1);
  std::vector<PhotonHistory> histories;
  while (histories.size() < 1000) {
    const Photon photon = sample_entry(transport().block(), from(0), kFar_m, kLine_keV, random);
    PhotonHistory history = transport().follow(photon, random);
    if (!history.deposits.empty()) histories.push_back(std::move(history));
  }
  Digitizer digitizer({}, {}, Calibration::uniform());
  std::vector<Hit> hits;
  std::size_t i = 0;
  for (auto _ : state) {
    hits.clear();
    digitizer.digitize(histories[i++ % histories.size()].deposits, 0.0, random, hits);
    benchmark::DoNotOptimize(hits.data());
  }
}
BENCHMARK(BM_DigitizePhotonThatInteracted);

/// All of a response table's work per photon that reaches the block, by direction and line.
void BM_PhotonToEvents(benchmark::State& state) {
  constexpr std::int64_t kPhotons = 1000;
  const auto line_keV = static_cast<double>(state.range(1));
  const ResponseConfig config{.rules = {.channels = {{.line_keV = line_keV, .pairs = line_keV > 100.0}}}};
  PhotonSimulator simulator(config, transport());
  Random random(1);
  for (auto _ : state) benchmark::DoNotOptimize(simulator.simulate(from(state.range(0)), kPhotons, random));
  state.SetItemsProcessed(state.iterations() * kPhotons);
}
BENCHMARK(BM_PhotonToEvents)->ArgNames({"theta_deg", "line_keV"})->ArgsProduct({{0, 45, 90}, {60, 311, 662, 1173}});

void BM_ConeDensity(benchmark::State& state) {
  const auto density = ConeDensity::load(COMPTONAUT_SOURCE_DIR "/config/response/cs-137-cones.csv");
  const ConeProfile profile = density.profile(0.3, Readings::kBoth);
  double cos_alpha = -1.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(profile.per_sr(cos_alpha));
    cos_alpha = cos_alpha > 0.99 ? -1.0 : cos_alpha + 0.001;
  }
}
BENCHMARK(BM_ConeDensity);

void BM_ResponseTableLookup(benchmark::State& state) {
  const auto table = make_response({.photons = 100}, load_cdte()).table;
  Random random(1);
  std::vector<Eigen::Vector3d> directions_D(4096);
  for (Eigen::Vector3d& u_D : directions_D) u_D = random.unit_vector();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(table.single(directions_D[i++ % directions_D.size()]));
}
BENCHMARK(BM_ResponseTableLookup);

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
