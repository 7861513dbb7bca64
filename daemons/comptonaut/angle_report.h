// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "picture/picture.h"
#include "response/angle_histogram.h"
#include "response/angular_error.h"

namespace comptonaut {

/// What the cones of a nuclide are worth.
struct AngleReport {
  std::string nuclide, command;
  std::vector<AngleBin> angles;
  std::vector<ReliabilityBin> probabilities;
};

/// Rows `delta_deg,from,to,samples,measured,model` (densities per degree) and `probability,from,to,hypotheses,share
/// that is true,mean stated`.
[[nodiscard]] std::string angle_csv(const AngleReport& report);

/// Two diagrams: the density of delta, measured and model, on a logarithmic scale; the share of true hypotheses over
/// the stated probability.
[[nodiscard]] std::vector<Panel> angle_picture(const AngleReport& report);

}  // namespace comptonaut
