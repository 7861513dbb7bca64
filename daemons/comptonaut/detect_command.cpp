// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "commands.h"
#include "core/statistics.h"
#include "detect_csv.h"
#include "detector_options.h"
#include "hit_map.h"
#include "nuclides.h"
#include "output.h"
#include "recording.h"

namespace comptonaut {
namespace {

constexpr std::size_t kHotPixelsShown = 10;

struct DetectOptions {
  DetectorOptions detector;
  std::filesystem::path file, clusters, pairs, image;
  std::vector<std::string> nuclides;
};

struct ChannelTally {
  std::int64_t singles = 0;
  std::int64_t pairs = 0;
};

/// What a recording held.
struct Tally {
  std::int64_t clusters = 0;
  std::int64_t clustered_hits = 0;
  std::int64_t coincident_clusters = 0;  ///< with another one within the drift time
  std::vector<double> coincidence_px;    ///< distances within groups of two
  std::int64_t events = 0;
  std::int64_t others = 0;
  std::vector<ChannelTally> channels;
};

EventRules rules_for(EventRules rules, const std::vector<std::string>& nuclides) {
  if (nuclides.empty()) return rules;
  rules.channels.clear();
  for (const std::string& nuclide : nuclides) rules.channels.push_back(find_nuclide(nuclide));
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

void add_event(const DetectorEvent& event, Tally& tally) {
  ++tally.events;
  if (event.kind == EventKind::kOther) {
    ++tally.others;
    return;
  }
  ChannelTally& channel = tally.channels[static_cast<std::size_t>(event.channel)];
  ++(event.kind == EventKind::kPair ? channel.pairs : channel.singles);
}

double percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// Hot ones are found as the detector-reader finds them, while hits come.
void print_pixels(const EventFinder& finder, const RecordingTotals& totals) {
  const std::vector<HotPixelTotals>& hot = totals.hot_pixels;
  fmt::print("pixels      {:>10}  masked: no valid calibration; {} hot{}\n", finder.calibration().masked_pixels(),
             hot.size(), hot.empty() ? "" : ", hits left out:");
  for (const HotPixelTotals& pixel : std::span(hot).first(std::min(hot.size(), kHotPixelsShown))) {
    fmt::print("  {:>10}  x {}, y {}\n", pixel.hits, pixel_x(pixel.pixel), pixel_y(pixel.pixel));
  }
}

void print_summary(const DetectOptions& options, const RecordingTotals& totals, const EventFinder& finder,
                   const Tally& tally) {
  const HitStreamCounts& counts = totals.counts;
  const double mean_size =
      static_cast<double>(tally.clustered_hits) / static_cast<double>(std::max<std::int64_t>(1, tally.clusters));
  const auto rate = [&](std::int64_t n) { return totals.live_s > 0.0 ? static_cast<double>(n) / totals.live_s : 0.0; };
  fmt::print("{}\n", options.file.string());
  fmt::print("rows        {:>10}  of them {} refused\n", counts.rows, counts.faults.total());
  print_faults(options.file, counts.faults);
  fmt::print("hits        {:>10}  {:.1f}/s; {} repaired by 16384 ticks, {} saturated, {} repeated, {} without energy\n",
             counts.hits, rate(counts.hits), counts.repaired, counts.saturated, finder.cluster_finder().repeated(),
             finder.cluster_finder().without_energy());
  print_pixels(finder, totals);
  fmt::print("time        {:>10.3f}  s; live {:.3f} s; {} gaps of lost data; {} epochs\n", totals.duration_s,
             totals.live_s, counts.lost_gaps, counts.epochs);
  fmt::print(
      "clusters    {:>10}  {:.1f}/s; mean size {:.2f} pixels; {:.1f} % in coincidence, two of them {:.1f} px apart in "
      "the median\n",
      tally.clusters, rate(tally.clusters), mean_size, percent(tally.coincident_clusters, tally.clusters),
      tally.coincidence_px.empty() ? 0.0 : median(tally.coincidence_px));
  fmt::print("events      {:>10}  {:.1f}/s\n", tally.events, rate(tally.events));
  for (std::size_t c = 0; c < tally.channels.size(); ++c) {
    const auto [singles, pairs] = tally.channels[c];
    const std::string& name = finder.rules().channels[c].name;
    fmt::print("  singles   {:>10}  {:.1f} %  {:.2f}/s of {}\n", singles, percent(singles, tally.events), rate(singles),
               name);
    fmt::print("  pairs     {:>10}  {:.1f} %  {:.2f}/s of {}\n", pairs, percent(pairs, tally.events), rate(pairs),
               name);
  }
  fmt::print("  others    {:>10}  {:.1f} %  {:.2f}/s\n", tally.others, percent(tally.others, tally.events),
             rate(tally.others));
  fmt::print("speed       {:>10.2f}  million hits/s, output included\n",
             1e-6 * static_cast<double>(counts.hits) / totals.took_s);
}

void detect(const DetectOptions& options) {
  require_recording(options.file, {options.clusters, options.pairs});
  require_picture(options.image);
  require_writable(options.image);
  const DetectorReaderConfig detector = detector_of(options.detector);
  EventFinder finder(rules_for(detector.rules, options.nuclides), load_calibration(detector));
  CsvFile clusters(options.clusters, kClusterColumns), pairs(options.pairs, kPairColumns);
  Tally tally{.channels = std::vector<ChannelTally>(finder.rules().channels.size())};
  HitMap map;
  const auto take = [&](std::span<const Hit> hits, std::span<const DetectorEvent> events) {
    map.add(hits);
    std::size_t first = 0;
    for (const DetectorEvent& event : events) {
      const auto group = finder.clusters().subspan(first, static_cast<std::size_t>(event.clusters));
      first += group.size();
      add_group(group, tally);
      add_event(event, tally);
      for (const Cluster& cluster : group) clusters.add(cluster);
      if (event.kind == EventKind::kPair) pairs.add(finder.rules().sensor, event);
    }
  };
  const RecordingTotals totals = read_recording(options.file, detector, finder, take);
  clusters.finish();
  pairs.finish();
  const std::string title =
      fmt::format("{}: {} hits in {:.1f} s", options.file.filename().string(), totals.counts.hits, totals.duration_s);
  if (!options.image.empty()) write_picture(options.image, {map.picture(title, totals.hot_pixels)});
  print_summary(options, totals, finder, tally);
}

}  // namespace

void add_detect_command(CLI::App& app) {
  const auto options = std::make_shared<DetectOptions>();
  CLI::App* command = app.add_subcommand("detect", "Finds clusters and Compton pairs in a recording of pixel hits");
  command->add_option("file", options->file, "Recording (.t3pa, .t3p or .clog)")->required();
  add_detector_options(*command, options->detector);
  command->add_option("--nuclide", options->nuclides,
                      "By name (Cs-137) or a file as in config/nuclides; several whose windows do not overlap; else "
                      "those of --config, or Cs-137");
  command->add_option("--clusters", options->clusters, "CSV file of clusters to write");
  command->add_option("--pairs", options->pairs, "CSV file of Compton pairs to write");
  command->add_option("--image", options->image, "Picture of the hits per pixel to write, .png or .svg");
  command->callback([options] { detect(*options); });
}

}  // namespace comptonaut
