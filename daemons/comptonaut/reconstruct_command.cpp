// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "output.h"
#include "picture/picture.h"
#include "reconstruct_picture.h"
#include "reconstruct_setup.h"
#include "reconstruct_summary.h"
#include "report/measurement_csv.h"
#include "report/reconstruction_files.h"
#include "report/recorded_measurements.h"

namespace comptonaut {
namespace {

constexpr double kShareOfMemory = 0.7;  // of the machine's

struct ReconstructOptions {
  std::vector<std::filesystem::path> recording;
  std::filesystem::path config = "config/coordinator.yaml";
  GridOptions grid;
  std::string nuclide, estimator = "joint";
  int iterations = 0;
  std::filesystem::path lambda, sources, image, cones_csv, viewpoints_csv;
};

ReconstructionConfig config_of(const ReconstructOptions& options, ReconstructionConfig config) {
  config.estimator = options.estimator;
  config.with_map = !options.lambda.empty() || !options.image.empty();
  if (options.iterations > 0) config.mlem.iterations = config.updates_max = options.iterations;
  config.memory_max_B =
      kShareOfMemory * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return config;
}

RecordedMeasurements measurements_of(const ReconstructOptions& options, const std::string& nuclide) {
  const auto& files = options.recording;
  return files.size() == 1 ? read_measurements(files[0], nuclide) : read_measurements(files[0], files[1], nuclide);
}

/// What lies above the ground; throws where that is nothing.
std::vector<MeasurementBatch> usable(RecordedMeasurements recorded, const ReconstructOptions& options) {
  std::int64_t below = 0;
  const std::string file = options.recording.back().string();
  const double ground_m = options.grid.ground_m;
  std::vector<MeasurementBatch> batches = above_ground(std::move(recorded.batches), ground_m, below);
  if (batches.empty()) {
    throw std::runtime_error(fmt::format("{}: all is measured from below the ground, --z {}", file, ground_m));
  }
  if (below > 0) {
    recorded.remarks.push_back(
        fmt::format("{}: {} viewpoints and cones are left out: below the ground, --z {}", file, below, ground_m));
  }
  for (const std::string& remark : recorded.remarks) fmt::print(stderr, "comptonaut: {}\n", remark);
  return batches;
}

void run(const ReconstructOptions& options) {
  require_picture(options.image);
  for (const auto& file : {options.lambda, options.sources, options.image, options.cones_csv, options.viewpoints_csv}) {
    require_writable(file);
  }
  const NuclideTables tables = load_tables(options.config, options.nuclide);
  const ReconstructionConfig config = config_of(options, tables.config);
  const auto batches = usable(measurements_of(options, config.nuclide), options);
  const Cells cells = cells_of(options.grid, batches);
  if (!options.cones_csv.empty()) write_text(options.cones_csv, cones_csv(batches, config.nuclide));
  if (!options.viewpoints_csv.empty()) write_text(options.viewpoints_csv, viewpoints_csv(batches, config.nuclide));

  const bool terminal = isatty(STDERR_FILENO) == 1;
  const Reconstruction result = reconstruct(config, cells, tables.response, tables.cones, batches,
                                            terminal ? show_progress : std::function<void(double)>{});
  if (terminal) hide_progress();
  if (!options.lambda.empty()) write_text(options.lambda, lambda_csv(cells, result));
  write_text(options.sources, sources_json(result));
  write_map_picture(options.image, cells, result);
  fmt::print("{}", reconstruction_summary(cells, result));
}

}  // namespace

void add_reconstruct_command(CLI::App& app) {
  const auto options = std::make_shared<ReconstructOptions>();
  CLI::App* command = app.add_subcommand("reconstruct", "Finds the sources in a recording of measurements");
  command->footer(
      fmt::format("cones.csv:      {}\nviewpoints.csv: {}\nNumbers are in the world (east, north, up); q "
                  "rotates the detector's frame to it.",
                  kConeColumns, kViewpointColumns));
  command
      ->add_option("recording", options->recording,
                   "An LCM log with MAVn_MEASUREMENTS, or two CSV files: cones and viewpoints")
      ->required()
      ->expected(1, 2);
  command->add_option("--grid", options->grid.grid,
                      "x0:x1:y0:y1:cell in m, where sources may lie; default: 10 m around the viewpoints");
  command->add_option("--z", options->grid.ground_m, "Height of the flat ground, m")
      ->check(CLI::Range(-1e5, 1e5))
      ->capture_default_str();
  command
      ->add_option("--estimator", options->estimator,
                   "joint: point sources of pairs and singles; mlem: the published map of pairs and its maxima")
      ->check(CLI::IsMember({"joint", "mlem"}))
      ->capture_default_str();
  command
      ->add_option("--iterations", options->iterations,
                   "Of MLEM, exactly; updates of the joint estimator, at most. Default: as configured; 100")
      ->check(CLI::Range(1, 100000));
  command->add_option("--nuclide", options->nuclide, "With tables beside the configured ones; default: as configured");
  command->add_option("--lambda", options->lambda, "Map to write, CSV: x_m,y_m,z_m,lambda_Bq,sensitivity_s");
  command->add_option("--sources", options->sources, "Sources to write with 95 % intervals, JSON");
  command->add_option("--image", options->image, "Map with the sources to write, .png or .svg");
  command->add_option("--cones-csv", options->cones_csv, "The recording's cones to write, CSV");
  command->add_option("--viewpoints-csv", options->viewpoints_csv, "The recording's viewpoints to write, CSV");
  command->add_option("--config", options->config, "A coordinator's: nuclide, tables, estimators")
      ->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace comptonaut
