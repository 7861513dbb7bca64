// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace comptonaut {
namespace {

int drone_of(JointData& data, std::int32_t sender) {
  const auto at = std::find(data.senders.begin(), data.senders.end(), sender);
  const auto drone = static_cast<int>(at - data.senders.begin());
  if (at == data.senders.end()) {
    data.senders.push_back(sender);
    data.live_s.push_back(0.0);
    data.R_ND.push_back(Eigen::Matrix3d::Identity());
  }
  return drone;
}

void add_viewpoint(Viewpoints& viewpoints, const MeasurementBatch& batch, const Eigen::Matrix3d& R_DW, double singles,
                   int drone) {
  viewpoints.x_m.push_back(batch.p_WD.x());
  viewpoints.y_m.push_back(batch.p_WD.y());
  viewpoints.z_m.push_back(batch.p_WD.z());
  for (int i = 0; i < 9; ++i) viewpoints.R_DW[i].push_back(R_DW(i / 3, i % 3));
  viewpoints.live_s.push_back(seconds(batch.live_us));
  viewpoints.singles.push_back(singles);
  viewpoints.drone.push_back(drone);
  viewpoints.utime.push_back(batch.utime);
}

/// One photon, of cones[first] to cones[last - 1].
Pair pair_of(const std::vector<Cone>& cones, std::size_t first, std::size_t last, const Eigen::Matrix3d& R_DW,
             int drone) {
  Pair pair{.p_WS = cones[first].p_WS,
            .R_DW = R_DW,
            .drone = drone,
            .readings = last - first > 1 ? Readings::kBoth : Readings::kSole,
            .hypotheses = {}};
  for (std::size_t i = first; i < last; ++i) {
    if (!(cones[i].weight > 0.0)) continue;
    const double beta_rad = std::acos(std::clamp(cones[i].cos_beta, -1.0, 1.0));
    pair.hypotheses.push_back({.axis_W = cones[i].axis_W, .beta_rad = beta_rad, .weight = cones[i].weight});
  }
  return pair;
}

/// The same axes of D point elsewhere in W.
void turn(Pair& pair, const Eigen::Matrix3d& R_ND) {
  const Eigen::Matrix3d R_NW = R_ND * pair.R_DW;
  for (Hypothesis& hypothesis : pair.hypotheses) {
    hypothesis.axis_W = R_NW.transpose() * (pair.R_DW * hypothesis.axis_W);
  }
  pair.R_DW = R_NW;
}

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& rotation) {
  const double angle_rad = rotation.norm();
  if (angle_rad == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, rotation / angle_rad).toRotationMatrix();
}

}  // namespace

void add(JointData& data, const MeasurementBatch& batch, const std::string& nuclide) {
  const int drone = drone_of(data, batch.key.sender);
  const Eigen::Matrix3d& R_ND = data.R_ND[drone];
  const Eigen::Matrix3d R_DW = batch.q_WD.conjugate().toRotationMatrix();
  if (batch.live_us > 0) {
    double singles = 0.0;
    for (const ChannelCounts& counts : batch.channels) {
      if (counts.nuclide == nuclide) singles += counts.singles;
    }
    add_viewpoint(data.viewpoints, batch, R_ND * R_DW, singles, drone);
    data.live_s[drone] += seconds(batch.live_us);
  }
  for (std::size_t first = 0, last = 0; first < batch.cones.size(); first = last) {
    const Cone& cone = batch.cones[first];
    while (last < batch.cones.size() && batch.cones[last].event == cone.event) ++last;
    if (batch.channels.at(static_cast<std::size_t>(cone.channel)).nuclide != nuclide) continue;
    Pair pair = pair_of(batch.cones, first, last, R_DW, drone);
    pair.utime = batch.utime;
    turn(pair, R_ND);
    if (!pair.hypotheses.empty()) data.pairs.push_back(std::move(pair));
  }
}

void turn(JointData& data, const std::vector<Eigen::Vector3d>& rotation_D) {
  std::vector<Eigen::Matrix3d> R_ND;  // from the frame of the detector before to that after
  for (std::size_t d = 0; d < rotation_D.size(); ++d) {
    R_ND.push_back(rotation_by(rotation_D[d]).transpose());
    data.R_ND[d] = R_ND[d] * data.R_ND[d];
  }
  Viewpoints& v = data.viewpoints;
  for (std::size_t i = 0; i < v.size(); ++i) {
    Eigen::Matrix3d R_DW;
    for (int r = 0; r < 9; ++r) R_DW(r / 3, r % 3) = v.R_DW[r][i];
    R_DW = R_ND[v.drone[i]] * R_DW;
    for (int r = 0; r < 9; ++r) v.R_DW[r][i] = R_DW(r / 3, r % 3);
  }
  for (Pair& pair : data.pairs) turn(pair, R_ND[pair.drone]);
}

}  // namespace comptonaut
