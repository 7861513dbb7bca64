// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "config/config.h"
#include "core/statistics.h"
#include "detect_csv.h"
#include "detector/events.h"
#include "detector/hit_stream.h"
#include "output.h"

namespace comptonaut {
namespace {

struct DetectOptions {
  std::filesystem::path file;
  std::filesystem::path calibration;
  std::string nuclide = "Cs-137";
  std::filesystem::path clusters;
  std::filesystem::path pairs;
};

/// What a recording held.
struct Tally {
  std::int64_t clusters = 0;
  std::int64_t clustered_hits = 0;
  std::int64_t coincident_clusters = 0;  ///< with another one within the drift time
  std::vector<double> coincidence_px;    ///< distances within groups of two
  std::int64_t events = 0;
  std::int64_t singles = 0;
  std::int64_t pairs = 0;
  double duration_s = 0.0;
  double live_s = 0.0;
};

EventRules rules_for(const std::string& nuclide) {
  EventRules rules;
  if (nuclide == rules.channels[0].name) return rules;
  if (!std::filesystem::is_regular_file(nuclide)) {
    throw std::runtime_error(fmt::format("--nuclide {}: must be {} or a file such as config/nuclides/cs-137.yaml",
                                         nuclide, rules.channels[0].name));
  }
  rules.channels = {load_config(nuclide, read_nuclide_channel)};
  return rules;
}

void add_group(std::span<const Cluster> group, Tally& tally) {
  for (const Cluster& cluster : group) {
    ++tally.clusters;
    tally.clustered_hits += cluster.size_px;
  }
  if (group.size() > 1) tally.coincident_clusters += std::ssize(group);
  if (group.size() == 2) {
    tally.coincidence_px.push_back(std::hypot(group[0].x_px - group[1].x_px, group[0].y_px - group[1].y_px));
  }
}

void add_events(EventFinder& finder, std::span<const Hit> hits, CsvFile& clusters, CsvFile& pairs, Tally& tally) {
  std::size_t first = 0;
  for (const DetectorEvent& event : finder.find(hits)) {
    const auto group = finder.clusters().subspan(first, static_cast<std::size_t>(event.clusters));
    first += group.size();
    add_group(group, tally);
    for (const Cluster& cluster : group) clusters.add(cluster);
    if (event.kind == EventKind::kPair) pairs.add(finder.rules().sensor, event);
    ++tally.events;
    tally.singles += event.kind == EventKind::kSingle ? 1 : 0;
    tally.pairs += event.kind == EventKind::kPair ? 1 : 0;
  }
}

void print_faults(const std::filesystem::path& file, const RowFaults& faults) {
  for (std::size_t i = 0; i < kRowFaults; ++i) {
    if (faults.count[i] == 0) continue;
    fmt::print("  {:>10}  {}, first at {}:{}\n", faults.count[i], describe(static_cast<RowFault>(i)), file.string(),
               faults.first_line[i]);
  }
}

double percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

void print_summary(const DetectOptions& options, const HitStreamCounts& counts, const EventFinder& finder,
                   const Tally& tally, double took_s) {
  const double mean_size =
      static_cast<double>(tally.clustered_hits) / static_cast<double>(std::max<std::int64_t>(1, tally.clusters));
  const auto rate = [&](std::int64_t n) { return tally.live_s > 0.0 ? static_cast<double>(n) / tally.live_s : 0.0; };
  const std::int64_t others = tally.events - tally.singles - tally.pairs;
  fmt::print("{}\n", options.file.string());
  fmt::print("rows        {:>10}  of them {} refused\n", counts.rows, counts.faults.total());
  print_faults(options.file, counts.faults);
  fmt::print("hits        {:>10}  {:.1f}/s; {} repaired by 16384 ticks, {} saturated, {} repeated, {} without energy\n",
             counts.hits, rate(counts.hits), counts.repaired, counts.saturated, finder.cluster_finder().repeated(),
             finder.cluster_finder().without_energy());
  fmt::print("pixels      {:>10}  masked: no valid calibration\n", finder.calibration().masked_pixels());
  fmt::print("time        {:>10.3f}  s; live {:.3f} s; {} gaps of lost data; {} epochs\n", tally.duration_s,
             tally.live_s, counts.lost_gaps, counts.epochs);
  fmt::print(
      "clusters    {:>10}  {:.1f}/s; mean size {:.2f} pixels; {:.1f} % in coincidence, two of them {:.1f} px apart in "
      "the median\n",
      tally.clusters, rate(tally.clusters), mean_size, percent(tally.coincident_clusters, tally.clusters),
      tally.coincidence_px.empty() ? 0.0 : median(tally.coincidence_px));
  fmt::print("events      {:>10}  {:.1f}/s\n", tally.events, rate(tally.events));
  fmt::print("  singles   {:>10}  {:.1f} %  {:.2f}/s of {}\n", tally.singles, percent(tally.singles, tally.events),
             rate(tally.singles), finder.rules().channels[0].name);
  fmt::print("  pairs     {:>10}  {:.1f} %  {:.2f}/s\n", tally.pairs, percent(tally.pairs, tally.events),
             rate(tally.pairs));
  fmt::print("  others    {:>10}  {:.1f} %  {:.2f}/s\n", others, percent(others, tally.events), rate(others));
  fmt::print("speed       {:>10.2f}  million hits/s, output included\n",
             1e-6 * static_cast<double>(counts.hits) / took_s);
}

void detect(const DetectOptions& options) {
  std::ifstream in(options.file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(options.file)) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read; must be a .t3pa, .t3p or .clog file", options.file.string()));
  }
  EventFinder finder(rules_for(options.nuclide), Calibration::load(options.calibration));
  const HitFormat format = hit_format_of(options.file);
  HitStream stream({}, finder.quiet(), true, format);
  CsvFile clusters(options.clusters, kClusterColumns), pairs(options.pairs, kPairColumns);
  Tally tally;
  const auto start = std::chrono::steady_clock::now();
  const auto drain = [&] {
    while (const auto part = stream.next()) {
      add_events(finder, part->hits, clusters, pairs, tally);
      if (!part->ends_epoch) continue;
      tally.duration_s += 1e-9 * kChipTime_ns * static_cast<double>(part->until);
      tally.live_s += 1e-9 * kChipTime_ns * static_cast<double>(stream.life().live(0, part->until));
    }
  };
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const double size = static_cast<double>(std::filesystem::file_size(options.file));
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
  clusters.finish();
  pairs.finish();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;

  const HitStreamCounts counts = stream.counts();
  if (counts.hits == 0 && (counts.faults.total() > 0 || size == 0.0)) {
    print_faults(options.file, counts.faults);
    throw std::runtime_error(fmt::format("{}: holds no hit; {}", options.file.string(), describe_row(format)));
  }
  print_summary(options, counts, finder, tally, took.count());
}

}  // namespace

void add_detect_command(CLI::App& app) {
  const auto options = std::make_shared<DetectOptions>();
  CLI::App* command = app.add_subcommand("detect", "Finds clusters and Compton pairs in a recording of pixel hits");
  command->add_option("file", options->file, "Recording (.t3pa, .t3p or .clog)")->required();
  command->add_option("--calibration", options->calibration, "Folder with the chip's a.txt b.txt c.txt t.txt")
      ->required();
  command->add_option("--nuclide", options->nuclide, "Cs-137, or a file as in config/nuclides")->capture_default_str();
  command->add_option("--clusters", options->clusters, "CSV file of clusters to write");
  command->add_option("--pairs", options->pairs, "CSV file of Compton pairs to write");
  command->callback([options] { detect(*options); });
}

}  // namespace comptonaut
