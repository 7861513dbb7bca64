// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "radiation/joint_channel.h"
#include "radiation/joint_fit.h"
#include "radiation/measurement_batch.h"
#include "world/world.h"

namespace comptonaut {

/// The Cramer-Rao bound of a trajectory: what no unbiased estimator of true point sources can beat on these
/// viewpoints, with background, response scale and scatter as unknown as they are to the joint estimator. Of several
/// nuclides, a source tells its place in its own channel and in those below, and its activity in these but for
/// known_rel_sigma.
class CramerRao {
 public:
  /// Channels by rising line. Sources of no channel's nuclide count in the first.
  CramerRao(std::vector<JointChannel> channels, const std::vector<PointSource>& truth, const std::vector<int>& mavs,
            const World& world = World::flat());

  void add(const MeasurementBatch& batch);

  /// Root of the mean over the sources of sigma_x^2 + sigma_y^2, m; NaN without sources, infinite while some source
  /// was not seen at all.
  [[nodiscard]] double rmse_m();

 private:
  struct Channel {
    JointChannel of;
    std::vector<std::size_t> sources;  ///< of the truth, those that count in it: of other nuclides first
    JointModel truth;
    JointData data;               ///< since the last call of rmse_m
    Eigen::MatrixXd information;  ///< of all data before, without priors

    [[nodiscard]] ParameterLayout layout() const;
    /// The information of its data on the truth, with the priors of `config`.
    [[nodiscard]] Eigen::MatrixXd information_of_data(const JointConfig& config) const;
    void fold();
  };

  /// About all sources' log activities, then their x and y, then what only single channels know.
  [[nodiscard]] Eigen::MatrixXd total() const;

  std::size_t sources_;
  std::vector<Channel> channels_;
};

}  // namespace comptonaut
