// SPDX-License-Identifier: BSD-3-Clause
#include "detector/nuclide.h"

#include <fmt/format.h>

#include <stdexcept>

#include "config/config.h"

namespace comptonaut {

NuclideChannel read_nuclide_channel(Config& config) {
  NuclideChannel channel;
  config.require("name", channel.name);
  config.require("line_keV", channel.line_keV, Range{.min = 10.0, .max = 10e3});
  config.require("branching", channel.branching, Range{.min = 1e-6, .max = 10.0});
  config.require("singles_min_keV", channel.singles_min_keV, Range{.min = 1.0, .max = 10e3});
  config.require("singles_max_keV", channel.singles_max_keV, Range{.min = 1.0, .max = 10e3});
  config.read("pairs", channel.pairs);
  config.read("pair_sum_rel_window", channel.pair_sum_rel_window, {.min = 0.001, .max = 0.9});
  config.read("pair_sigmas", channel.pair_sigmas, {.min = 0.0, .max = 10.0});
  config.each("emissions", [&](Config& section) {
    GammaLine line;
    section.require("energy_keV", line.energy_keV, Range{.min = 5.0, .max = 3e3});
    section.require("per_decay", line.per_decay, Range{.min = 1e-6, .max = 10.0});
    channel.emissions.push_back(line);
  });
  if (channel.singles_min_keV >= channel.singles_max_keV) {
    throw config.error("singles_max_keV", "must be above singles_min_keV");
  }
  return channel;
}

std::vector<GammaLine> emitted_lines(const NuclideChannel& channel) {
  if (!channel.emissions.empty()) return channel.emissions;
  return {{.energy_keV = channel.line_keV, .per_decay = channel.branching}};
}

void check(const std::vector<NuclideChannel>& channels) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const NuclideChannel &a = channels[j], &b = channels[i];
      if (a.singles_min_keV < b.singles_max_keV && b.singles_min_keV < a.singles_max_keV) {
        throw std::invalid_argument(
            fmt::format("channels {} ({}..{} keV) and {} ({}..{} keV): windows of singles must not overlap", a.name,
                        a.singles_min_keV, a.singles_max_keV, b.name, b.singles_min_keV, b.singles_max_keV));
      }
    }
  }
}

}  // namespace comptonaut
