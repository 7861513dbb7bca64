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

#include "commands.h"
#include "config/config.h"
#include "output.h"
#include "response/make_response.h"

namespace comptonaut {
namespace {

struct ResponseOptions {
  ResponseConfig config;
  std::optional<double> line_keV;
  std::filesystem::path nuclide, out, cones;
};

/// The nuclide of the file, or Cs-137. A line that is given besides must be that nuclide's.
NuclideChannel channel_of(const ResponseOptions& options) {
  const NuclideChannel channel =
      options.nuclide.empty() ? NuclideChannel{} : load_config(options.nuclide, read_nuclide_channel);
  if (options.line_keV && std::abs(*options.line_keV - channel.line_keV) > 0.1) {
    throw std::runtime_error(fmt::format("--line-keV {}: {} has its line at {}; give the line's --nuclide file",
                                         *options.line_keV, channel.name, channel.line_keV));
  }
  return channel;
}

/// What makes the same table again.
std::string command_of(const ResponseOptions& options, const NuclideChannel& channel) {
  const std::string nuclide = options.nuclide.empty() ? "" : fmt::format(" --nuclide {}", options.nuclide.string());
  const std::string cones = options.cones.empty() ? "" : fmt::format(" --cones {}", options.cones.string());
  return fmt::format("comptonaut response --line-keV {}{} --photons {} --grid-deg {} --seed {} --out {}{}",
                     channel.line_keV, nuclide, options.config.photons, options.config.grid_deg, options.config.seed,
                     options.out.string(), cones);
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
  fmt::print(
      "{} pairs: hypothesis A true {:.1f} %; angular error of the better hypothesis {:.1f} degrees (median), "
      "{:.1f} (95 %); of the true one {:.1f}, {:.1f}\n",
      angular.pairs, 100.0 * angular.a_is_true, degrees(angular.best_median_rad), degrees(angular.best_q95_rad),
      degrees(angular.true_median_rad), degrees(angular.true_q95_rad));
  fmt::print("{}: {} directions, {:.1f} s\n", options.out.string(), response.table.entries().size(), took_s);
}

void make(ResponseOptions& options) {
  const NuclideChannel channel = channel_of(options);
  options.config.rules.channels = {channel};
  check(options.config);
  require_writable(options.out);
  require_writable(options.cones);
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto start = std::chrono::steady_clock::now();
  Response response =
      make_response(options.config, load_cdte(), terminal ? show_progress : std::function<void(double)>{});
  if (terminal) hide_progress();
  ResponseTable::Facts facts = response.table.facts();
  facts["command"] = command_of(options, channel);
  response.table = ResponseTable(response.table.entries(), facts);
  response.table.save(options.out);
  if (!options.cones.empty()) {
    fit_cone_density(response.cones, {{"nuclide", channel.name}, {"command", facts["command"]}}).save(options.cones);
  }
  print_summary(options, response, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

void add_response_command(CLI::App& app) {
  const auto options = std::make_shared<ResponseOptions>();
  ResponseConfig& config = options->config;
  config.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CLI::App* command = app.add_subcommand("response", "Makes a response table by Monte Carlo");
  command->add_option("--line-keV", options->line_keV, "Energy of the line, to be sure of it (default: the nuclide's)");
  command->add_option("--nuclide", options->nuclide, "File of the nuclide: line, branching, windows (default: Cs-137)");
  command->add_option("--photons", config.photons, "Photons that reach the block, per direction")
      ->capture_default_str();
  command->add_option("--out", options->out, "Table to write, CSV")->required();
  command->add_option("--cones", options->cones,
                      "Density of the source's direction about a pair's cones to write, CSV");
  command->add_option("--seed", config.seed, "Of the random numbers")->capture_default_str();
  command->add_option("--threads", config.threads, "The table does not depend on it")->capture_default_str();
  command->add_option("--grid-deg", config.grid_deg, "Step of phi and theta; divides 90")->capture_default_str();
  command->callback([options] { make(*options); });
}

}  // namespace comptonaut
