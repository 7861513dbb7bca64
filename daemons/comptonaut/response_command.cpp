// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "angle_report.h"
#include "commands.h"
#include "config/config.h"
#include "nodes/detector_reader_config.h"
#include "nuclides.h"
#include "output.h"
#include "response/fit_cone_density.h"
#include "response/make_response.h"

namespace comptonaut {
namespace {

struct ResponseOptions {
  ResponseConfig config;
  std::optional<double> line_keV;
  std::filesystem::path detector, nuclide, out, cones, angles, picture;
};

/// The nuclide that is named, or Cs-137. A line that is given besides must be that nuclide's.
NuclideChannel channel_of(const ResponseOptions& options) {
  const NuclideChannel channel = options.nuclide.empty() ? NuclideChannel{} : find_nuclide(options.nuclide.string());
  if (options.line_keV && std::abs(*options.line_keV - channel.line_keV) > 0.1) {
    throw std::runtime_error(fmt::format("--line-keV {}: {} has its line at {}; give the line's --nuclide",
                                         *options.line_keV, channel.name, channel.line_keV));
  }
  return channel;
}

/// What makes the same files again.
std::string command_of(const ResponseOptions& options) {
  const ResponseConfig& config = options.config;
  const ResponseConfig usual;
  std::string command = "comptonaut response";
  const auto add_path = [&](const char* option, const std::filesystem::path& path) {
    if (!path.empty()) command += fmt::format(" {} {}", option, path.string());
  };
  add_path("--config", options.detector);
  add_path("--nuclide", options.nuclide);
  command += fmt::format(" --photons {} --grid-deg {} --seed {}", config.photons, config.grid_deg, config.seed);
  if (config.single_rel_sigma > 0.0) {
    command +=
        fmt::format(" --single-rel-sigma {} --pair-rel-sigma {}", config.single_rel_sigma, config.pair_rel_sigma);
  }
  if (config.thinning != usual.thinning) command += fmt::format(" --thinning {}", config.thinning);
  add_path("--out", options.out);
  add_path("--cones", options.cones);
  add_path("--angles", options.angles);
  add_path("--picture", options.picture);
  return command;
}

/// What the pairs tell, where it is asked for.
void save_angles(const ResponseOptions& options, const std::string& nuclide, const std::vector<SimulatedPair>& pairs) {
  if (options.cones.empty() && options.angles.empty() && options.picture.empty()) return;
  const std::string command = command_of(options);
  const ConeDensity density = fit_cone_density(pairs, {{"nuclide", nuclide}, {"command", command}});
  if (!options.cones.empty()) density.save(options.cones);
  const AngleReport report{.nuclide = nuclide,
                           .command = command,
                           .angles = angle_histogram(pairs, density),
                           .probabilities = reliability(pairs)};
  write_text(options.angles, angle_csv(report));
  write_picture(options.picture, angle_picture(report));
}

void print_summary(const ResponseOptions& options, const Response& response, double took_s) {
  const auto line = [&](const char* name, const Eigen::Vector3d& u_D) {
    const ResponseEntry& entry = response.table.entries()[response.table.nearest(u_D)];
    fmt::print("{:<11} single {:.3e} +- {:.1f} %   pair {:.3e} +- {:.1f} %\n", name, entry.single,
               100.0 * entry.single_rel_sigma, entry.pair, 100.0 * entry.pair_rel_sigma);
  };
  const auto degrees = [](double rad) { return rad * 57.29577951308232; };
  const AngularSummary& angular = response.angular;
  fmt::print("{} at {} keV: events per decay at 1 m\n", response.table.facts().at("nuclide"),
             response.table.facts().at("line_keV"));
  line("face on", Eigen::Vector3d::UnitZ());
  line("side on", Eigen::Vector3d::UnitX());
  line("from behind", -Eigen::Vector3d::UnitZ());
  if (angular.pairs > 0)
    fmt::print(
        "{} pairs: hypothesis A true {:.1f} %; angular error of the better hypothesis {:.1f} degrees (median), "
        "{:.1f} (95 %); of the true one {:.1f}, {:.1f}\n",
        angular.pairs, 100.0 * angular.a_is_true, degrees(angular.best_median_rad), degrees(angular.best_q95_rad),
        degrees(angular.true_median_rad), degrees(angular.true_q95_rad));
  fmt::print("{}: {} directions, {:.1f} s\n", options.out.string(), response.table.entries().size(), took_s);
}

void make(ResponseOptions& options) {
  const NuclideChannel channel = channel_of(options);
  if (!options.detector.empty()) {
    options.config.rules = load_config(options.detector, read_detector_reader_config).rules;
  }
  options.config.rules.channels = {channel};
  check(options.config);
  if (!channel.pairs && !(options.cones.empty() && options.angles.empty() && options.picture.empty())) {
    throw std::runtime_error(fmt::format("{} is without pairs: give no --cones, --angles or --picture", channel.name));
  }
  require_writable(options.out);
  require_writable(options.cones);
  require_writable(options.angles);
  require_picture(options.picture);
  require_writable(options.picture);
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto start = std::chrono::steady_clock::now();
  Response response =
      make_response(options.config, load_cdte(), terminal ? show_progress : std::function<void(double)>{});
  if (terminal) hide_progress();
  ResponseTable::Facts facts = response.table.facts();
  facts["command"] = command_of(options);
  response.table = ResponseTable(response.table.entries(), facts);
  response.table.save(options.out);
  save_angles(options, channel.name, response.pairs);
  print_summary(options, response, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

void add_response_command(CLI::App& app) {
  const auto options = std::make_shared<ResponseOptions>();
  ResponseConfig& config = options->config;
  config.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CLI::App* command = app.add_subcommand("response", "Makes a response table by Monte Carlo");
  command->add_option("--line-keV", options->line_keV, "Energy of the line, to be sure of it (default: the nuclide's)");
  command->add_option("--config", options->detector,
                      "The detector as in config/detector-reader.yaml: sensor and rules of events (default: a MiniPIX "
                      "TPX3 with 2 mm CdTe at -450 V)");
  command->add_option("--nuclide", options->nuclide,
                      "By name (Co-60) or a file as in config/nuclides: line, branching, windows (default: Cs-137)");
  command->add_option("--photons", config.photons, "Photons that reach the block, per direction")
      ->capture_default_str();
  CLI::Option* single = command->add_option("--single-rel-sigma", config.single_rel_sigma,
                                            "Relative error of singles that is enough; ends a direction early");
  command->add_option("--pair-rel-sigma", config.pair_rel_sigma, "The same of pairs")->needs(single);
  command->add_option("--out", options->out, "Table to write, CSV")->required();
  command->add_option("--cones", options->cones,
                      "Density of the source's direction about a pair's cones to write, CSV");
  command->add_option("--angles", options->angles,
                      "Histogram of the cones' angular error, and how often hypotheses are true, to write, CSV");
  command->add_option("--picture", options->picture, "The same as a picture to write, .png or .svg");
  command
      ->add_option("--thinning", config.thinning, "Of photons that can hardly make a pair one in so many is digitized")
      ->capture_default_str();
  command->add_option("--seed", config.seed, "Of the random numbers")->capture_default_str();
  command->add_option("--threads", config.threads, "The table does not depend on it")->capture_default_str();
  command->add_option("--grid-deg", config.grid_deg, "Step of phi and theta; divides 90")->capture_default_str();
  command->callback([options] { make(*options); });
}

}  // namespace comptonaut
