// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace comptonaut {

class Config;

/// Photons of one energy.
struct GammaLine {
  double energy_keV = 0.0;
  double per_decay = 0.0;
  bool operator==(const GammaLine&) const = default;
};

/// One gamma line (or several that cannot be told apart) whose events are counted apart from all others'.
struct NuclideChannel {
  std::string name = "Cs-137";
  double line_keV = 661.657;
  double branching = 0.8499;      ///< photons of the line per decay
  double singles_min_keV = 40.0;  ///< above the 32 keV X-rays of the daughter
  double singles_max_keV = 800.0;
  bool pairs = true;                 ///< the line gives Compton pairs that can be told from other events
  double pair_sum_rel_window = 0.2;  ///< a pair's summed energy lies within this share of the line
  double pair_sigmas = 2.0;          ///< an electron's energy may pass its limit (detector/pair.h) by this many sigma
  std::vector<GammaLine> emissions;  ///< all that the nuclide emits; empty: the line alone
};

/// What the nuclide emits: its emissions, or the line with its branching.
[[nodiscard]] std::vector<GammaLine> emitted_lines(const NuclideChannel& channel);

/// One channel, as config/nuclides/*.yaml holds it.
[[nodiscard]] NuclideChannel read_nuclide_channel(Config& config);

/// Throws std::invalid_argument that names the channels where two have windows of singles that overlap.
void check(const std::vector<NuclideChannel>& channels);

}  // namespace comptonaut
