// SPDX-License-Identifier: BSD-3-Clause
// Text of pixel hits to events, hits per second on one core.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/random.h"
#include "detector/events.h"
#include "detector/hit_stream.h"

namespace comptonaut {
namespace {

/// Clusters of one to four pixels at this rate of hits, as .t3pa text.
std::string synthetic_text(int clusters, double hits_per_s) {
  Random random(1);
  std::string text = "Index\tMatrix Index\tToA\tToT\tFToA\tOverflow\n";
  double t_ticks = 1000.0;
  int index = 0;
  for (int i = 0; i < clusters; ++i) {
    t_ticks += random.exponential() * 2.5 / hits_per_s * 40e6;
    const int x = static_cast<int>(random.uniform(0.0, 255.0)), y = static_cast<int>(random.uniform(0.0, 255.0));
    const int size = 1 + static_cast<int>(random.uniform(0.0, 4.0));
    for (int k = 0; k < size; ++k) {
      text += std::to_string(index++) + "\t" + std::to_string(256 * (y + k / 2) + x + k % 2) + "\t" +
              std::to_string(static_cast<std::int64_t>(t_ticks) + k % 2) + "\t" +
              std::to_string(20 + static_cast<int>(random.uniform(0.0, 300.0))) + "\t" + std::to_string(random() % 16) +
              "\t0\n";
    }
  }
  return text;
}

void run(benchmark::State& state, const std::string& text, bool find_events) {
  std::int64_t hits = 0, events = 0;
  EventFinder finder(EventRules{}, Calibration::uniform());
  for (auto _ : state) {
    HitStream stream({}, finder.quiet(), true);
    const auto drain = [&] {
      while (const auto part = stream.next()) {
        if (find_events) events += std::ssize(finder.find(part->hits));
      }
    };
    stream.feed(text);
    drain();
    stream.end();
    drain();
    hits += stream.counts().hits;
  }
  benchmark::DoNotOptimize(events);
  state.counters["hits/s"] = benchmark::Counter(static_cast<double>(hits), benchmark::Counter::kIsRate);
}

void text_to_hits(benchmark::State& state) { run(state, synthetic_text(400'000, 2.35e6), false); }
void text_to_events(benchmark::State& state) {
  run(state, synthetic_text(400'000, static_cast<double>(state.range(0))), true);
}
void americium_to_events(benchmark::State& state) {
  std::ifstream in(std::filesystem::path(COMPTONAUT_SHARED_DATA) / "tpx3/241Am_gamma_60sec.t3pa", std::ios::binary);
  if (!in) return state.SkipWithError("no recordings at COMPTONAUT_SHARED_DATA");
  run(state, std::string(std::istreambuf_iterator<char>(in), {}), true);
}

BENCHMARK(text_to_hits)->Unit(benchmark::kMillisecond);
BENCHMARK(text_to_events)->Arg(10'000)->Arg(100'000)->Arg(2'350'000)->Unit(benchmark::kMillisecond);
BENCHMARK(americium_to_events)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace comptonaut

BENCHMARK_MAIN();
