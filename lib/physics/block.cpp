// SPDX-License-Identifier: BSD-3-Clause
#include "physics/block.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

/// Shadow of the face across each axis.
Eigen::Vector3d shadows_m2(const Block& block, const Eigen::Vector3d& u_D) {
  const Eigen::Vector3d& h = block.half_m;
  return 4.0 * Eigen::Vector3d(h.y() * h.z(), h.z() * h.x(), h.x() * h.y()).cwiseProduct(u_D.cwiseAbs());
}

}  // namespace

double Block::projected_area_m2(const Eigen::Vector3d& u_D) const { return shadows_m2(*this, u_D).sum(); }

double Block::distance_to_exit_m(const Eigen::Vector3d& p_D, const Eigen::Vector3d& flight_D) const {
  double distance_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (flight_D[axis] == 0.0) continue;
    const double face_m = std::copysign(half_m[axis], flight_D[axis]);
    distance_m = std::min(distance_m, (face_m - p_D[axis]) / flight_D[axis]);
  }
  return std::max(distance_m, 0.0);
}

double solid_angle_sr(const Block& block, const Eigen::Vector3d& u_D, double distance_m) {
  return block.projected_area_m2(u_D) / (distance_m * distance_m);
}

Photon sample_entry(const Block& block, const Eigen::Vector3d& u_D, double distance_m, double energy_keV,
                    Random& random) {
  const Eigen::Vector3d shadows = shadows_m2(block, u_D);
  const double draw = random.uniform() * shadows.sum();
  const int face = draw < shadows.x() ? 0 : draw < shadows.x() + shadows.y() ? 1 : 2;
  const Eigen::Vector3d& h = block.half_m;
  Eigen::Vector3d p_D;
  for (int axis = 0; axis < 3; ++axis) {
    p_D[axis] = axis == face ? std::copysign(h[axis], u_D[axis]) : random.uniform(-h[axis], h[axis]);
  }
  // From the source to the point, written so that it holds at infinity too.
  const Eigen::Vector3d flight_D = (p_D / distance_m - u_D).normalized();
  return {.p_D = p_D, .flight_D = flight_D, .energy_keV = energy_keV};
}

}  // namespace comptonaut
