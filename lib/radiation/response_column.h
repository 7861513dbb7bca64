// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "radiation/cone_table.h"
#include "radiation/joint_data.h"
#include "radiation/smooth_response.h"

namespace comptonaut {

/// What the likelihood knows about the detector and the air.
struct JointPhysics {
  SmoothResponse response;
  ConeTable cones;
  double attenuation_per_m = 0.0;            ///< mu of air
  double obstacles_per_m = 0.0;              ///< mu of occupied space
  std::vector<JointPhysics> of_others = {};  ///< the same of what other nuclides leave in this one's channel
};

/// What a source of 1 Bq at one place would give (design, section 5.4):
///   singles[v] = Delta_v L^p exp(-mu d) / d^2                                          counts in viewpoint v
///   pairs[i]   = t_i = L^c exp(-mu d) / d^2 sum_H w_H density_H(angle(u, a_H))         at pair i, 1 / (s sr)
///   exposure_s[drone] = s^c, the sum over its viewpoints of Delta_v L^c exp(-mu d) / d^2
/// each times what obstacles let through, where the data have some.
struct ResponseColumn {
  std::vector<double> singles;
  std::vector<double> pairs;
  std::vector<double> exposure_s;
  /// Derivatives by x, y and z of the place, as far as somebody asked for them (slope_of).
  mutable std::array<std::shared_ptr<const ResponseColumn>, 3> slope_per_m = {};
};

/// Fills all of the column, slopes apart; d is at least kDistanceMin_m.
void fill_column(const JointPhysics& physics, const JointData& data, const Eigen::Vector3d& p_W,
                 ResponseColumn& column);

/// t_i of one pair alone, obstacles left out.
[[nodiscard]] double pair_density(const JointPhysics& physics, const Pair& pair, const Eigen::Vector3d& p_W);

}  // namespace comptonaut
