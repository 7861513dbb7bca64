// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "core/cells.h"
#include "radiation/joint_model.h"

namespace comptonaut {

/// The ground that sources lie on.
struct Ground {
  Area area;                                          ///< sources stay within
  std::function<double(double x_m, double y_m)> z_m;  ///< height in W
};

/// Which places of a model's parameters hold what. Positive ones are fitted as logarithms.
struct ParameterLayout {
  std::size_t sources = 0, drones = 0;
  std::vector<std::size_t> movable;  ///< sources whose x and y are fitted
  bool align = false;                ///< how the detectors are turned is fitted as well

  [[nodiscard]] std::size_t log_activity(std::size_t k) const { return k; }
  [[nodiscard]] std::size_t x_m(std::size_t m) const { return sources + 2 * m; }
  [[nodiscard]] std::size_t log_singles(std::size_t d) const { return sources + 2 * movable.size() + 3 * d; }
  [[nodiscard]] std::size_t log_pairs(std::size_t d) const { return log_singles(d) + 1; }
  [[nodiscard]] std::size_t scale(std::size_t d) const { return log_singles(d) + 2; }
  [[nodiscard]] std::size_t scatter() const { return log_singles(drones); }
  /// Of the rotation about x of D; those about y and z follow.
  [[nodiscard]] std::size_t alignment(std::size_t d) const { return scatter() + 1 + 3 * d; }
  [[nodiscard]] std::size_t size() const { return align ? alignment(drones) : scatter() + 1; }
};

/// The log likelihood's first derivatives and the information (expected for singles and their priors, observed outer
/// products for pairs) about all parameters.
struct Linearisation {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

[[nodiscard]] Linearisation linearise(const JointProblem& problem, const JointState& state,
                                      const ParameterLayout& layout);

/// d column / d x and d column / d y of source k, per m.
[[nodiscard]] std::array<ResponseColumn, 2> slopes_of(const JointProblem& problem, const JointState& state,
                                                      std::size_t k);

/// Fisher scoring with Marquardt's damping: all activities, backgrounds and the response's nuisances, and the positions
/// of `movable`, until a step gains less than `gain_min` or after `steps`. The likelihood never falls.
void refit(const JointProblem& problem, const Ground& ground, const std::vector<std::size_t>& movable, int steps,
           double gain_min, JointState& state);

/// One step of the same in all parameters together with how the detectors are turned, which turns the data. The
/// likelihood never falls.
void align(const JointConfig& config, const JointPhysics& physics, const Ground& ground, JointData& data,
           JointState& state);

/// 0, 1, ..., n - 1.
[[nodiscard]] std::vector<std::size_t> all_of(std::size_t n);

}  // namespace comptonaut
