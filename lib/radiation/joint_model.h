// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiation/joint_config.h"
#include "radiation/joint_data.h"
#include "radiation/metrics.h"
#include "radiation/response_column.h"

namespace comptonaut {

/// What is estimated along the way of each drone.
struct DroneModel {
  double singles_per_s = 3.0;  ///< background b_p > 0 when the data begin,
  std::vector<double> drift;   ///< and its logarithm's growth until 1, 2, ... drift_s later, straight between and
                               ///< constant after; nothing: constant
  double pairs_per_s = 0.01;   ///< background b_c > 0, isotropic
  double scale = 1.0;          ///< true response over the table's, singles and pairs alike
  /// How the detector is turned against what the pose says, a rotation vector in D, rad; the data is turned already.
  Eigen::Vector3d alignment_rad = Eigen::Vector3d::Zero();
};

/// A source of another nuclide, which leaves something in this channel, as that nuclide's own channel knows it.
struct KnownSource {
  std::size_t other = 0;  ///< which nuclide: index into JointPhysics::of_others
  PointSource source;
  Eigen::Matrix2d place_information = Eigen::Matrix2d::Zero();  ///< of x and y, 1 / m^2
  double activity_rel_sigma = 0.1;                              ///< of what it leaves here
};

/// All that the likelihood is a function of.
struct JointModel {
  std::vector<PointSource> sources;     ///< first those of `known`, as this channel's data move them
  std::vector<KnownSource> known = {};  ///< what is believed of them
  std::vector<DroneModel> drones = {};  ///< as in JointData::senders
  /// The drones' scales are believed to differ from 1 by so much, where more than config.response_rel_sigma.
  double response_spread = 0.0;
  double scatter = 1.2;  ///< singles per single of the table: 1 + those scattered in ground and air
};

/// The density of directions of an isotropic background, 1 / sr.
inline constexpr double kIsotropic_per_sr = 0.07957747154594767;

/// A model with what its sources would give, column by column.
struct JointState {
  JointModel model;
  std::vector<ResponseColumn> columns;  ///< one per source
  double log_likelihood = 0.0;
};

/// What a likelihood is made of, by reference.
struct JointProblem {
  const JointConfig& config;
  const JointPhysics& physics;
  const JointData& data;
};

/// What source k of the model looks like in the channel.
[[nodiscard]] const JointPhysics& physics_of(const JointPhysics& physics, const JointModel& model, std::size_t k);

/// Sources of the channel's own nuclide.
[[nodiscard]] std::size_t own_sources(const JointModel& model);

/// How far the drones' scales may be off, from how far those that were fitted differ from each other: the square root
/// of (response_rel_sigma^2 + sum_d (scale_d - mean)^2) / (n - 1). What all have in common the data cannot tell from
/// stronger sources; a few drones tell little, and rather too wide than too narrow.
[[nodiscard]] double response_spread(const JointConfig& config, const JointModel& model);

/// The joint log likelihood (design, section 5.4) up to a constant of the data, with the priors of the response:
///   sum_i log f_i - sum_d (scale_d sum_k A_k s^c_kd + b_c,d T_d)    f_i = scale_d sum_k A_k t_ik + b_c,d / (4 pi)
///   + sum_v [n_v log mu_v - mu_v]       mu_v = scale_d scatter sum_k A_k a_kv + b_p,d Delta_v
///   - sum_d ((scale_d - 1) / response_rel_sigma)^2 / 2 - ((scatter - 1 - share) / share_sigma)^2 / 2
///   - sum_d (|alignment_d| / alignment_sigma)^2 / 2 - sum_d sum_j ((drift_dj - drift_d,j-1) / drift_sigma)^2 / 2
///   - sum_known [(p - p_known)^T information (p - p_known) + (log(A / A_known) / activity_rel_sigma)^2] / 2
/// b_p,d being singles_per_s exp(drift) at the viewpoint's time, drift_d0 = 0;
/// with response_rel_sigma or, if larger, the model's response_spread, and the channels that config.use_* names.
[[nodiscard]] double log_likelihood(const JointProblem& problem, const JointModel& model,
                                    const std::vector<ResponseColumn>& columns);

/// Fills the columns and the likelihood of a model.
[[nodiscard]] JointState state_of(const JointProblem& problem, JointModel model);

/// Where a moment lies among the points of a drone's drift: between drift[at - 1] (0 for at = 0) and drift[at], this
/// share on the way; at is below `points`, share 1 after the last.
struct DriftPlace {
  std::size_t at = 0;
  double share = 0.0;
};
[[nodiscard]] DriftPlace drift_place(const JointProblem& problem, Utime utime, std::size_t points);

/// Points of drift that the data's length asks for: one where each drift_s ends, none below one and a half.
[[nodiscard]] std::size_t drift_points(const JointProblem& problem);

/// b_p Delta_v.
[[nodiscard]] double background(const JointProblem& problem, const JointModel& model, std::size_t viewpoint);

/// mu_v and f_i.
struct Expected {
  std::vector<double> singles;
  std::vector<double> pairs;
};
[[nodiscard]] Expected expected(const JointProblem& problem, const JointModel& model,
                                const std::vector<ResponseColumn>& columns);

}  // namespace comptonaut
