// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/random.h"

namespace comptonaut {

/// A straight line into the box: a point of its surface and the direction of flight, unit.
struct Ray {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// A box around the origin, edges along the axes, as a point outside sees it: exact at any distance.
class BoxView {
 public:
  /// `half` holds half the edges, in the unit of `eye`. An eye inside the box or on its surface sees nothing.
  BoxView(const Eigen::Vector3d& half, const Eigen::Vector3d& eye);

  /// sr, of all faces turned to the eye together.
  [[nodiscard]] double solid_angle() const { return solid_angle_[0] + solid_angle_[1] + solid_angle_[2]; }

  /// A line from the eye to the box, isotropic within the solid angle. Needs solid_angle() > 0.
  [[nodiscard]] Ray sample(Random& random) const;

 private:
  [[nodiscard]] int sample_face(Random& random) const;

  Eigen::Vector3d half_;
  Eigen::Vector3d eye_;
  std::array<double, 3> solid_angle_{};  ///< of the face across x, y, z that is turned to the eye; 0: none is
};

}  // namespace comptonaut
