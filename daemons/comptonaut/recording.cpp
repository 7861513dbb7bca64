// SPDX-License-Identifier: BSD-3-Clause
#include "recording.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "output.h"

namespace comptonaut {
namespace {

std::vector<HotPixelTotals> hottest_first(const std::map<std::uint16_t, std::int64_t>& hits) {
  std::vector<HotPixelTotals> totals;
  for (const auto& [pixel, count] : hits) totals.push_back({.pixel = pixel, .hits = count});
  std::stable_sort(totals.begin(), totals.end(), [](const auto& a, const auto& b) { return a.hits > b.hits; });
  return totals;
}

std::ifstream open_recording(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file)) {
    throw std::runtime_error(fmt::format("{}: cannot be read; must be a .t3pa, .t3p or .clog file", file.string()));
  }
  return in;
}

}  // namespace

void require_recording(const std::filesystem::path& file, std::initializer_list<std::filesystem::path> outputs) {
  (void)open_recording(file);
  for (const std::filesystem::path& output : outputs) {
    std::error_code none_yet;
    if (!output.empty() && std::filesystem::equivalent(file, output, none_yet)) {
      throw std::runtime_error(fmt::format("{}: is the recording; it would be written over", output.string()));
    }
  }
}

RecordingTotals read_recording(const std::filesystem::path& file, const DetectorReaderConfig& config,
                               EventFinder& finder, const TakeStretch& take) {
  std::ifstream in = open_recording(file);
  const HitFormat format = hit_format_of(file);
  HitStream stream(config.stream, finder.quiet(), true, format);
  HotPixels hot_pixels(config.hot_pixels);
  std::map<std::uint16_t, std::int64_t> left_out_of;
  RecordingTotals totals;
  const auto start = std::chrono::steady_clock::now();
  ChipTime lived = 0, counted_until = 0;  // of the epoch
  const auto drain = [&] {
    while (const auto part = stream.next()) {
      const auto [kept, left_out] = hot_pixels.split(part->hits, part->until);
      for (const Hit& hit : left_out) ++left_out_of[hit.pixel];
      take(part->hits, finder.find(kept));
      lived += stream.life().live(counted_until, part->until);
      counted_until = part->until;
      stream.forget_life_before(part->until);
      if (!part->ends_epoch) continue;
      totals.duration_s += 1e-9 * kChipTime_ns * static_cast<double>(part->until);
      totals.live_s += 1e-9 * kChipTime_ns * static_cast<double>(std::exchange(lived, 0));
      counted_until = 0;
    }
  };
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const double size = static_cast<double>(std::filesystem::file_size(file));
  double read = 0.0;
  for (std::vector<char> buffer(std::size_t{1} << 18); in; drain()) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    stream.feed(std::span(buffer).first(static_cast<std::size_t>(in.gcount())));
    read += static_cast<double>(in.gcount());
    if (terminal && size > 0.0) show_progress(std::min(1.0, read / size));
  }
  if (terminal) hide_progress();
  stream.end();
  drain();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  totals.took_s = took.count();
  totals.counts = stream.counts();
  const auto hits = static_cast<double>(totals.counts.hits),
             lost = static_cast<double>(totals.counts.faults.hits_lost());
  if (hits > 0.0) totals.live_s *= hits / (hits + lost);
  totals.hot_pixels = hottest_first(left_out_of);
  if (totals.counts.hits == 0 && (totals.counts.faults.total() > 0 || size == 0.0)) {
    print_faults(file, totals.counts.faults);
    throw std::runtime_error(fmt::format("{}: holds no hit; {}", file.string(), describe_row(format)));
  }
  return totals;
}

void print_faults(const std::filesystem::path& file, const RowFaults& faults) {
  for (std::size_t i = 0; i < kRowFaults; ++i) {
    if (faults.count[i] == 0) continue;
    fmt::print("  {:>10}  {}, first at {}:{}\n", faults.count[i], describe(static_cast<RowFault>(i)), file.string(),
               faults.first_line[i]);
  }
}

}  // namespace comptonaut
