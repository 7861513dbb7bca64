// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cramer_rao.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "radiation/sight_lines.h"

namespace comptonaut {
namespace {

/// Without priors: such wide ones say nothing.
JointConfig without_priors(JointConfig config) {
  constexpr double kWide = 1e9;
  config.response_rel_sigma = config.scatter_share_sigma = kWide;
  return config;
}

}  // namespace

CramerRao::CramerRao(const JointConfig& config, JointPhysics physics, std::string nuclide,
                     std::vector<PointSource> truth, const std::vector<int>& mavs, const World& world)
    : config_(config), physics_(std::move(physics)), nuclide_(std::move(nuclide)) {
  data_.senders.assign(mavs.begin(), mavs.end());
  data_.live_s.assign(mavs.size(), 0.0);
  data_.R_ND.assign(mavs.size(), Eigen::Matrix3d::Identity());
  if (!world.is_flat()) data_.sight = std::make_shared<SightLines>(world);
  truth_.sources = std::move(truth);
  truth_.drones.resize(mavs.size());
  truth_.scatter = 1.0 + config.scatter_share;
  information_ = information(without_priors(config));
}

ParameterLayout CramerRao::layout() const {
  return {.sources = truth_.sources.size(), .drones = truth_.drones.size(), .movable = all_of(truth_.sources.size())};
}

Eigen::MatrixXd CramerRao::information(const JointConfig& config) const {
  const JointProblem problem{.config = config, .physics = physics_, .data = data_};
  return linearise(problem, state_of(problem, truth_), layout()).information;
}

double CramerRao::rmse_m() {
  information_ += information(without_priors(config_));
  data_.viewpoints = {};
  data_.pairs.clear();
  if (data_.sight) data_.sight = std::make_shared<SightLines>(data_.sight->world());
  const std::size_t n = truth_.sources.size();
  Eigen::MatrixXd total = information_ + information(config_);
  total.diagonal().array() += 1e-9;
  const Eigen::MatrixXd covariance = total.inverse();
  double sum_m2 = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t x = layout().x_m(k);
    sum_m2 += covariance(x, x) + covariance(x + 1, x + 1);
  }
  return n > 0 ? std::sqrt(sum_m2 / static_cast<double>(n)) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace comptonaut
