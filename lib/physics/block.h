// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/random.h"

namespace comptonaut {

/// A photon in flight, in the detector frame D.
struct Photon {
  Eigen::Vector3d p_D = Eigen::Vector3d::Zero();         ///< m
  Eigen::Vector3d flight_D = -Eigen::Vector3d::UnitZ();  ///< unit vector, where it flies to
  double energy_keV = 0.0;
};

/// The sensor's crystal: a box around the origin of D with faces across its axes, z_D from the pixels (low) to the
/// cathode (high).
struct Block {
  Eigen::Vector3d half_m{7.04e-3, 7.04e-3, 1.0e-3};  ///< half edges: 256 pixels of 55 um, 2 mm

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_D) const {
    return (p_D.cwiseAbs().array() <= half_m.array()).all();
  }
  /// Area of its shadow on a plane across u_D (unit vector), m^2.
  [[nodiscard]] double projected_area_m2(const Eigen::Vector3d& u_D) const;
  /// Way from a point in it along a unit vector to the surface, m.
  [[nodiscard]] double distance_to_exit_m(const Eigen::Vector3d& p_D, const Eigen::Vector3d& flight_D) const;
};

/// Solid angle under which a source in direction u_D at this distance sees the block, sr: projected area / distance^2.
/// Relative error below (half diagonal / distance)^2, 1e-4 from 1 m on.
[[nodiscard]] double solid_angle_sr(const Block& block, const Eigen::Vector3d& u_D, double distance_m);

/// A photon of a point source in direction u_D (unit vector) at a distance (infinity: parallel beam) at the point
/// where it enters the block: uniform over the shadow, with the error of solid_angle_sr.
[[nodiscard]] Photon sample_entry(const Block& block, const Eigen::Vector3d& u_D, double distance_m, double energy_keV,
                                  Random& random);

}  // namespace comptonaut
