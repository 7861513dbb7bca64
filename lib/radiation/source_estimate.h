// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "core/time.h"

namespace comptonaut {

/// One estimated source. NaN where the estimator does not tell.
struct SourceEstimate {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string nuclide;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double activity_Bq = 0.0;
  Eigen::Vector3d position_sigma_m = Eigen::Vector3d::Constant(kUnknown);  ///< along x, y, z of W
  double position_cov_xy_m2 = kUnknown;
  double activity_sigma_Bq = kUnknown;
  double significance = kUnknown;  ///< gain in log likelihood
};

/// Activity that is spread over some ground, no point source, as the even disc that explains the data best.
struct PatchEstimate {
  std::string nuclide;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< centroid, m
  double area_m2 = 0.0;
  double activity_Bq = 0.0;  ///< in all
  double gain = 0.0;         ///< its log likelihood less that of the points it stands for

  bool operator==(const PatchEstimate&) const = default;
};

/// The team's answer at one tick, strongest source first.
struct SourceReport {
  std::int64_t mission = 0;
  Utime utime = 0;
  std::string estimator;
  double certificate = SourceEstimate::kUnknown;  ///< largest score anywhere
  double coverage = 0.0;                          ///< share of cells that count as searched
  std::vector<SourceEstimate> sources;
};

/// Where points do not explain what the team measured until one tick, strongest first. Beside SourceReport.
struct PatchReport {
  std::int64_t mission = 0;
  Utime utime = 0;
  std::vector<PatchEstimate> patches;
};

}  // namespace comptonaut
