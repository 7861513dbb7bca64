// SPDX-License-Identifier: BSD-3-Clause
// Pixel hits of every format to events, hits per second on one core.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/random.h"
#include "detector/events.h"
#include "detector/hit_stream.h"
#include "detector/hot_pixels.h"
#include "detector/make_hits.h"

namespace comptonaut {
namespace {

/// Deposits of one to four pixels at this rate of hits.
std::vector<Hit> synthetic_hits(int deposits, double hits_per_s) {
  Random random(1);
  std::vector<Hit> hits;
  double t_ticks = 1000.0;
  for (int i = 0; i < deposits; ++i) {
    t_ticks += random.exponential() * 2.5 / hits_per_s * 40e6;
    const int x = static_cast<int>(random.uniform(0.0, 255.0)), y = static_cast<int>(random.uniform(0.0, 255.0));
    const int size = 1 + static_cast<int>(random.uniform(0.0, 4.0));
    for (int k = 0; k < size; ++k) {
      hits.push_back({.t = 16 * (static_cast<ChipTime>(t_ticks) + k % 2) - static_cast<ChipTime>(random() % 16),
                      .pixel = pixel_at(x + k % 2, y + k / 2),
                      .tot = static_cast<std::uint16_t>(20.0 + random.uniform(0.0, 300.0))});
    }
  }
  return hits;
}

constexpr int kDeposits = 400'000;

std::string americium_text() {
  std::ifstream in(std::filesystem::path(COMPTONAUT_SHARED_DATA) / "tpx3/241Am_gamma_60sec.t3pa", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The rows of a .t3pa text as .t3p.
std::string binary_of(const std::string& text) {
  std::vector<Hit> hits;
  T3paParser parser;
  for (const StreamItem& item : parser.parse(text)) {
    if (item.kind == StreamItem::Kind::kHit) hits.push_back(item.hit());
  }
  return t3p_data(hits);
}

void run(benchmark::State& state, const std::string& data, HitFormat format, bool find_events) {
  if (data.empty()) return state.SkipWithError("no recordings at COMPTONAUT_SHARED_DATA");
  std::int64_t hits = 0, events = 0;
  EventFinder finder(EventRules{}, Calibration::uniform());
  for (auto _ : state) {
    HitStream stream({}, finder.quiet(), true, format);
    HotPixels hot_pixels{HotPixelConfig{}};
    const auto drain = [&] {
      while (const auto part = stream.next()) {
        if (find_events) events += std::ssize(finder.find(hot_pixels.split(part->hits, part->until).kept));
      }
    };
    stream.feed(data);
    drain();
    stream.end();
    drain();
    hits += stream.counts().hits;
  }
  benchmark::DoNotOptimize(events);
  state.counters["hits/s"] = benchmark::Counter(static_cast<double>(hits), benchmark::Counter::kIsRate);
}

void text_to_hits(benchmark::State& state) {
  run(state, t3pa_text(synthetic_hits(kDeposits, 2.35e6)), HitFormat::kT3pa, false);
}
void binary_to_hits(benchmark::State& state) {
  run(state, t3p_data(synthetic_hits(kDeposits, 2.35e6)), HitFormat::kT3p, false);
}
void text_to_events(benchmark::State& state) {
  run(state, t3pa_text(synthetic_hits(kDeposits, static_cast<double>(state.range(0)))), HitFormat::kT3pa, true);
}
void binary_to_events(benchmark::State& state) {
  run(state, t3p_data(synthetic_hits(kDeposits, static_cast<double>(state.range(0)))), HitFormat::kT3p, true);
}
void clusters_to_events(benchmark::State& state) {
  run(state, clog_text(synthetic_hits(kDeposits / 10, static_cast<double>(state.range(0)))), HitFormat::kClog, true);
}
void americium_text_to_events(benchmark::State& state) { run(state, americium_text(), HitFormat::kT3pa, true); }
void americium_binary_to_events(benchmark::State& state) {
  run(state, binary_of(americium_text()), HitFormat::kT3p, true);
}

/// Both readings of pairs of 662 keV whose photons scattered once (0) or which are by chance (1).
void pair_readings(benchmark::State& state) {
  constexpr double kLine_keV = 661.657;
  const PairReader reader(kLine_keV);
  const SensorConfig sensor;
  Random random(1);
  std::int64_t pairs = 0;
  for (auto _ : state) {
    const double electron_keV = random.uniform(20.0, 477.0);
    const double photon_keV = (state.range(0) == 1 ? random.uniform(0.8, 1.2) : 1.0) * kLine_keV - electron_keV;
    const ClusterEnergy first{electron_keV, energy_sigma_keV(sensor, electron_keV)};
    const ClusterEnergy second{photon_keV, energy_sigma_keV(sensor, photon_keV)};
    benchmark::DoNotOptimize(reader.read(first, second, 1.5e-3));
    benchmark::DoNotOptimize(reader.read(second, first, 1.5e-3));
    ++pairs;
  }
  state.counters["pairs/s"] = benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsRate);
}

BENCHMARK(pair_readings)->Arg(0)->Arg(1);
BENCHMARK(text_to_hits)->Unit(benchmark::kMillisecond);
BENCHMARK(binary_to_hits)->Unit(benchmark::kMillisecond);
BENCHMARK(text_to_events)->Arg(10'000)->Arg(100'000)->Arg(2'350'000)->Unit(benchmark::kMillisecond);
BENCHMARK(binary_to_events)->Arg(10'000)->Arg(100'000)->Arg(2'350'000)->Unit(benchmark::kMillisecond);
BENCHMARK(clusters_to_events)->Arg(2'350'000)->Unit(benchmark::kMillisecond);
BENCHMARK(americium_text_to_events)->Unit(benchmark::kMillisecond);
BENCHMARK(americium_binary_to_events)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
