// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "detector_options.h"
#include "nuclides.h"
#include "output.h"
#include "recording.h"
#include "spectrum.h"

namespace comptonaut {
namespace {

constexpr double kHighest_keV = 3000.0;

struct SpectrumOptions {
  DetectorOptions detector;
  std::filesystem::path file, image, csv;
  std::vector<std::string> nuclides;
  double bin_keV = 1.0;
  double max_keV = 0.0;
};

void spectrum(const SpectrumOptions& options) {
  require_recording(options.file, {options.csv});
  require_picture(options.image);
  require_writable(options.image);
  require_writable(options.csv);
  std::vector<NuclideChannel> nuclides;
  for (const std::string& name : options.nuclides) nuclides.push_back(find_nuclide(name));
  if (nuclides.empty()) nuclides = known_nuclides();
  const DetectorReaderConfig detector = detector_of(options.detector);
  EventFinder finder(detector.rules, load_calibration(detector));
  Spectrum spectrum(options.bin_keV, static_cast<std::size_t>(kHighest_keV / options.bin_keV));
  const RecordingTotals totals = read_recording(options.file, detector, finder, [&](const auto&, const auto& events) {
    spectrum.add(finder.clusters(), events, detector.rules.pair_distance_min_px);
  });
  const double max_keV = options.max_keV > 0.0 ? options.max_keV : spectrum.end_keV();
  write_text(options.csv, spectrum.csv(max_keV));
  const std::string title = fmt::format("{}, {:.1f} s", options.file.filename().string(), totals.live_s);
  if (!options.image.empty()) write_picture(options.image, {spectrum.picture(title, max_keV, nuclides)});
  fmt::print("{}: {} hits, {} clusters, {} pairs in {:.3f} s of live time\n", options.file.string(), totals.counts.hits,
             spectrum.clusters(), spectrum.pairs(), totals.live_s);
  print_faults(options.file, totals.counts.faults);
}

}  // namespace

void add_spectrum_command(CLI::App& app) {
  const auto options = std::make_shared<SpectrumOptions>();
  CLI::App* command =
      app.add_subcommand("spectrum", "Histograms of the energies of clusters and of pairs in a recording");
  command->add_option("file", options->file, "Recording (.t3pa, .t3p or .clog)")->required();
  add_detector_options(*command, options->detector);
  command->add_option("--image", options->image, "Picture to write, .png or .svg");
  command->add_option("--csv", options->csv, "CSV file to write");
  command->add_option("--nuclide", options->nuclides,
                      "Whose lines are marked, by name or file; all that are known else");
  command->add_option("--bin-keV", options->bin_keV, "Width of a bin")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--max-keV", options->max_keV, "End of the histograms; where few are beyond it else")
      ->check(CLI::Range(1.0, kHighest_keV));
  command->callback([options] { spectrum(*options); });
}

}  // namespace comptonaut
