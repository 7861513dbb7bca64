// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/cells.h"
#include "radiation/joint_model.h"

namespace comptonaut {

/// The ground that sources lie on.
struct Ground {
  Area area;                                                  ///< sources stay within
  double height_max_m = 0.0;                                  ///< and at most so high above it or the wall beside
  std::function<double(double x_m, double y_m)> z_m;          ///< height in W
  std::function<double(double x_m, double y_m)> wall_m = {};  ///< height of the walls beside above it; none: flat

  /// How high above the ground a source may be.
  [[nodiscard]] double limit_m(const Eigen::Vector3d& p_W) const {
    return height_max_m + (wall_m ? wall_m(p_W.x(), p_W.y()) : 0.0);
  }
};

/// Which places of a model's parameters hold what. Positive ones are fitted as logarithms.
struct ParameterLayout {
  std::size_t sources = 0, drones = 0;
  std::vector<std::size_t> movable;  ///< sources whose x and y are fitted
  std::vector<std::size_t> lifted;   ///< sources of these whose height is fitted as well
  std::size_t drift_points = 0;      ///< of each drone
  bool align = false;                ///< how the detectors are turned is fitted as well

  [[nodiscard]] std::size_t log_activity(std::size_t k) const { return k; }
  [[nodiscard]] std::size_t x_m(std::size_t m) const { return sources + 2 * m; }
  [[nodiscard]] std::size_t z_m(std::size_t l) const { return sources + 2 * movable.size() + l; }
  [[nodiscard]] std::size_t log_singles(std::size_t d) const { return z_m(lifted.size()) + 3 * d; }
  [[nodiscard]] std::size_t log_pairs(std::size_t d) const { return log_singles(d) + 1; }
  [[nodiscard]] std::size_t scale(std::size_t d) const { return log_singles(d) + 2; }
  [[nodiscard]] std::size_t scatter() const { return log_singles(drones); }
  [[nodiscard]] std::size_t drift(std::size_t d, std::size_t j) const { return scatter() + 1 + drift_points * d + j; }
  /// Of the rotation about x of D; those about y and z follow.
  [[nodiscard]] std::size_t alignment(std::size_t d) const { return drift(drones, 0) + 3 * d; }
  [[nodiscard]] std::size_t size() const { return alignment(align ? drones : 0); }
};

/// The log likelihood's first derivatives and the information (expected for singles and their priors, observed outer
/// products for pairs) about all parameters.
struct Linearisation {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

[[nodiscard]] Linearisation linearise(const JointProblem& problem, const JointState& state,
                                      const ParameterLayout& layout);

/// The layout of all that a fit of these sources' places moves: heights of those that stand above the surface. `align`:
/// how the detectors are turned as well.
[[nodiscard]] ParameterLayout layout_of(const Ground& ground, const JointModel& model,
                                        const std::vector<std::size_t>& movable, bool align = false);

/// How high a source stands above the surface, m.
[[nodiscard]] double height_m(const Ground& ground, const PointSource& source);

/// d column / d x, y or z (axis 0, 1, 2) of source k, per m; kept with the column.
[[nodiscard]] const ResponseColumn& slope_of(const JointProblem& problem, const JointState& state, std::size_t k,
                                             int axis);

/// Fisher scoring with Marquardt's damping: all activities, backgrounds and the response's nuisances, and the positions
/// of `movable` (the heights of those that stand above the surface: one on it stays there), until a step gains less
/// than `gain_min` or after `steps`. The likelihood never falls.
void refit(const JointProblem& problem, const Ground& ground, const std::vector<std::size_t>& movable, int steps,
           double gain_min, JointState& state);

/// One step of the same in all parameters together with how the detectors are turned, which turns the data. The
/// likelihood never falls.
void align(const JointConfig& config, const JointPhysics& physics, const Ground& ground, JointData& data,
           JointState& state);

/// 0, 1, ..., n - 1.
[[nodiscard]] std::vector<std::size_t> all_of(std::size_t n);

}  // namespace comptonaut
