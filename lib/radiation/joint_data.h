// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "radiation/measurement_batch.h"
#include "response/cone_density.h"

namespace comptonaut {

class SightLines;

/// Viewpoints as arrays: where each detector was for 50 ms, for how long it could see, and what it counted.
struct Viewpoints {
  std::vector<double> x_m, y_m, z_m;        ///< p_WD
  std::array<std::vector<double>, 9> R_DW;  ///< row by row; rotates W to D
  std::vector<double> live_s;
  std::vector<double> singles;  ///< counted
  std::vector<int> drone;       ///< index into JointData::senders
  std::vector<Utime> utime;     ///< of the batch

  [[nodiscard]] std::size_t size() const { return live_s.size(); }
};

/// One reading of a pair.
struct Hypothesis {
  Eigen::Vector3d axis_W;  ///< unit vector to the source's side
  double beta_rad = 0.0;
  double weight = 0.0;  ///< probability
};

/// One Compton pair: one photon.
struct Pair {
  Eigen::Vector3d p_WS;
  Eigen::Matrix3d R_DW;
  int drone = 0;
  Utime utime = 0;  ///< of the batch
  Readings readings = Readings::kBoth;
  std::vector<Hypothesis> hypotheses;  ///< one or two
};

/// What the team measured of one nuclide, as the joint likelihood needs it. Plain data; `add` appends.
struct JointData {
  Viewpoints viewpoints;
  std::vector<Pair> pairs;
  std::vector<std::int32_t> senders;  ///< MAV number of each drone, in the order of their first batches
  std::vector<double> live_s;         ///< per drone: T
  std::vector<Eigen::Matrix3d> R_ND;  ///< per drone: from D as poses tell it to D as it is, in all that is added
  std::shared_ptr<SightLines> sight = nullptr;  ///< what obstacles let through to it; null: there are none
};

/// Appends a batch's viewpoint and pairs of the nuclide. A batch without live time adds no viewpoint; photons without a
/// hypothesis of positive weight add nothing.
void add(JointData& data, const MeasurementBatch& batch, const std::string& nuclide);

/// Turns the detector of each drone by rotation_D[drone], a rotation vector in its frame, rad: for all data, also what
/// comes later.
void turn(JointData& data, const std::vector<Eigen::Vector3d>& rotation_D);

}  // namespace comptonaut
