// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/pass_shifts.h"

#include <map>
#include <utility>

#include "radiation/joint_fit.h"

namespace comptonaut {
namespace {

/// One drone during one stretch of time.
using Pass = std::pair<int, std::int64_t>;
using Informations = std::map<Pass, Eigen::Matrix2d>;

/// What each pass tells about the place of source k, 1 / m^2.
Informations informations(const JointProblem& problem, const JointState& state, const Expected& sums, std::size_t k) {
  const Viewpoints& v = problem.data.viewpoints;
  const JointModel& model = state.model;
  const ResponseColumn &by_x = slope_of(problem, state, k, 0), &by_y = slope_of(problem, state, k, 1);
  const Utime pass_us = microseconds(problem.config.pass_s);
  const double activity_Bq = model.sources[k].activity_Bq;
  Informations result;
  const auto add = [&](int drone, Utime utime, const Eigen::Vector2d& slope, double weight) {
    Eigen::Matrix2d& sum = result.try_emplace({drone, utime / pass_us}, Eigen::Matrix2d::Zero()).first->second;
    sum += weight * slope * slope.transpose();
  };
  for (std::size_t i = 0; problem.config.use_singles && i < v.size(); ++i) {
    const double factor = activity_Bq * model.drones[v.drone[i]].scale * model.scatter;
    add(v.drone[i], v.utime[i], factor * Eigen::Vector2d(by_x.singles[i], by_y.singles[i]), 1.0 / sums.singles[i]);
  }
  for (std::size_t i = 0; problem.config.use_pairs && i < problem.data.pairs.size(); ++i) {
    const Pair& pair = problem.data.pairs[i];
    const double factor = activity_Bq * model.drones[pair.drone].scale / sums.pairs[i];
    add(pair.drone, pair.utime, factor * Eigen::Vector2d(by_x.pairs[i], by_y.pairs[i]), 1.0);
  }
  return result;
}

}  // namespace

std::vector<Eigen::Matrix2d> pass_shifts(const JointProblem& problem, const JointState& state,
                                         const std::vector<Eigen::Matrix2d>& covariances) {
  const Expected sums = expected(problem, state.model, state.columns);
  const double variance_m2 = problem.config.pass_sigma_m * problem.config.pass_sigma_m;
  std::vector<Eigen::Matrix2d> result(covariances.size(), Eigen::Matrix2d::Zero());
  for (std::size_t k = 0; k < covariances.size(); ++k) {
    for (const auto& [pass, information] : informations(problem, state, sums, k)) {
      const Eigen::Matrix2d pull = covariances[k] * information;
      result[k] += variance_m2 * pull * pull.transpose();
    }
  }
  return result;
}

}  // namespace comptonaut
