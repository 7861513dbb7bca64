// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "radiation/joint_fit.h"
#include "radiation/measurement_batch.h"
#include "world/world.h"

namespace comptonaut {

/// The Cramer-Rao bound of a trajectory: what no unbiased estimator of true point sources can beat on these
/// viewpoints, with background, response scale and scatter as unknown as they are to the joint estimator.
class CramerRao {
 public:
  CramerRao(const JointConfig& config, JointPhysics physics, std::string nuclide, std::vector<PointSource> truth,
            const std::vector<int>& mavs, const World& world = World::flat());

  void add(const MeasurementBatch& batch) { comptonaut::add(data_, batch, nuclide_); }

  /// Root of the mean over the sources of sigma_x^2 + sigma_y^2, m; NaN without sources, infinite while some source
  /// was not seen at all.
  [[nodiscard]] double rmse_m();

 private:
  [[nodiscard]] ParameterLayout layout() const;
  /// The information of data_ on the truth, with the priors of `config`.
  [[nodiscard]] Eigen::MatrixXd information(const JointConfig& config) const;

  JointConfig config_;
  JointPhysics physics_;
  std::string nuclide_;
  JointModel truth_;
  JointData data_;               ///< since the last call of rmse_m
  Eigen::MatrixXd information_;  ///< of all data before, without priors
};

}  // namespace comptonaut
