// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "nodes/coordinator_config.h"
#include "radiation/joint_channel.h"
#include "response/cone_density.h"
#include "response/response_table.h"

namespace comptonaut {

/// What photons give in one channel.
struct ChannelTables {
  ResponseTable response;
  ConeDensity cones;
};

/// A nuclide that a coordinator looks for besides its first one. Its line lies above those of the nuclides before it,
/// in whose channels it therefore leaves singles and pairs of less than its full energy.
struct MoreNuclide {
  std::string nuclide;
  ChannelTables own;
  std::vector<ChannelTables> left;  ///< in the channel of the first nuclide, then of the more ones before it
};

/// The tables of config.more_nuclides, from the folder of config.response_table: of Co-60-1332 beside Cs-137
/// co-60-1332.csv, co-60-1332-cones.csv, co-60-1332-in-cs-137.csv and co-60-1332-in-cs-137-cones.csv.
/// Throws std::runtime_error that names the file.
[[nodiscard]] std::vector<MoreNuclide> load_more_nuclides(const CoordinatorConfig& config);

/// What the joint likelihood knows of all nuclides' channels, by rising line; `first` are the tables of config.nuclide.
[[nodiscard]] std::vector<JointChannel> joint_channels(const CoordinatorConfig& config, const ChannelTables& first,
                                                       const std::vector<MoreNuclide>& more);

/// Attenuation in air of a table's line, where that of another table's line is given: as the cross section of free
/// electrons, which all absorption in air is between 0.2 and 3 MeV but for 1 %. Tables without `line_keV`: the same.
[[nodiscard]] double attenuation_per_m(const ResponseTable& table, const ResponseTable& other, double of_other_per_m);

}  // namespace comptonaut
