// SPDX-License-Identifier: BSD-3-Clause
#include "sim/box_view.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

/// Solid angle of the rectangle (0, x) x (0, y) from height h > 0 above its corner, with the signs of x and y:
///   tan = x y / (h sqrt(x^2 + y^2 + h^2))                                      [Gotoh and Yagi 1971]
double corner_solid_angle(double x, double y, double h) {
  return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h));
}

/// Of the rectangle x0..x1, y0..y1.
double rectangle_solid_angle(double x0, double x1, double y0, double y1, double h) {
  return corner_solid_angle(x1, y1, h) - corner_solid_angle(x0, y1, h) - corner_solid_angle(x1, y0, h) +
         corner_solid_angle(x0, y0, h);
}

}  // namespace

BoxView::BoxView(const Eigen::Vector3d& half, const Eigen::Vector3d& eye) : half_(half), eye_(eye) {
  for (int axis = 0; axis < 3; ++axis) {
    const double h = std::abs(eye[axis]) - half[axis];
    if (h <= 0.0) continue;
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    solid_angle_[axis] =
        rectangle_solid_angle(-half[x] - eye[x], half[x] - eye[x], -half[y] - eye[y], half[y] - eye[y], h);
  }
}

int BoxView::sample_face(Random& random) const {
  double left = random.uniform() * solid_angle();
  for (int axis = 0; axis < 2; ++axis) {
    if (left < solid_angle_[axis]) return axis;
    left -= solid_angle_[axis];
  }
  return solid_angle_[2] > 0.0 ? 2 : (solid_angle_[1] > 0.0 ? 1 : 0);
}

Ray BoxView::sample(Random& random) const {
  const int axis = sample_face(random);
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  Eigen::Vector3d nearest = eye_.cwiseMax(-half_).cwiseMin(half_);
  const double r2_min = (nearest - eye_).squaredNorm();
  // A uniform point of the face, thinned by what its surface element spans: h / r^3, at most h / r_min^3.
  for (;;) {
    Eigen::Vector3d p;
    p[axis] = std::copysign(half_[axis], eye_[axis]);
    p[x] = random.uniform(-half_[x], half_[x]);
    p[y] = random.uniform(-half_[y], half_[y]);
    const Eigen::Vector3d line = p - eye_;
    const double share = r2_min / line.squaredNorm();
    if (random.uniform() < share * std::sqrt(share)) return {.p = p, .direction = line.normalized()};
  }
}

}  // namespace comptonaut
