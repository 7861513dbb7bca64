// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiation/ground_tree.h"

namespace comptonaut {

/// A function over the ground about a node's middle, of second degree in the way (x, y) from there, m:
///   value + x dx + y dy + xx dx^2 + xy dx dy + yy dy^2
struct NodeField {
  double value = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double factor, const NodeField& f) {
    value += factor * f.value;
    x += factor * f.x;
    y += factor * f.y;
    xx += factor * f.xx;
    xy += factor * f.xy;
    yy += factor * f.yy;
  }
  NodeField& operator*=(double factor) {
    for (double* part : {&value, &x, &y, &xx, &xy, &yy}) *part *= factor;
    return *this;
  }
  [[nodiscard]] double at(double dx_m, double dy_m) const {
    return value + dx_m * (x + xx * dx_m + xy * dy_m) + dy_m * (y + yy * dy_m);
  }
  /// The same function about a place (dx, dy) from there.
  [[nodiscard]] NodeField about(double dx_m, double dy_m) const {
    return {at(dx_m, dy_m), x + 2.0 * xx * dx_m + xy * dy_m, y + 2.0 * yy * dy_m + xy * dx_m, xx, xy, yy};
  }
  /// Its mean over the cells of its node.
  [[nodiscard]] double mean(const GroundNode& node) const {
    return value + xx * node.sigma_x_m * node.sigma_x_m + xy * node.covariance_m2 +
           yy * node.sigma_y_m * node.sigma_y_m;
  }
};

}  // namespace comptonaut
