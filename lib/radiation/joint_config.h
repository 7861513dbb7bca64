// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace comptonaut {

class Config;

/// The estimator of point sources from pairs and singles together.
struct JointConfig {
  bool use_pairs = true;
  bool use_singles = true;
  double attenuation_per_m = 0.0093;    ///< mu, of air at 662 keV
  double attitude_sigma_rad = 0.025;    ///< of cones' axes, per axis: odometry and mount
  double pass_sigma_m = 0.03;           ///< of poses, per axis: odometry, and attitude as seen from some metres,
  double pass_s = 2.0;                  ///< anew after so long
  double alignment_sigma_rad = 0.0175;  ///< of each detector's mount, per axis: expected, and estimated along
  double response_rel_sigma = 0.03;     ///< of each drone's response against the table
  double scatter_share = 0.24;          ///< singles scattered in ground and air, per single of the table: expected,
  double scatter_share_sigma = 0.05;    ///< and how far the data may move it
  double gain_to_add = 18.0;            ///< in log likelihood, that a new source must bring
  double loss_to_drop = 16.0;           ///< a source whose removal costs less goes
  double loss_to_reseed = 100.0;        ///< one whose removal costs less is also tried elsewhere
  double height_max_m = 1.5;            ///< a source may stand so high above the surface,
  double gain_to_lift = 12.0;           ///< where that gains so much log likelihood
  double drift_s = 100.0;               ///< in so long, the logarithm of a drone's background
  double drift_sigma = 0.3;             ///< walks about so far
  double score_spacing_m = 1.0;         ///< of the places where a new source is looked for
  int candidates = 6;                   ///< of these, tried at a time
  double activity_min_Bq = 1e8;         ///< sources that are looked for: log-uniform between
  double activity_max_Bq = 1e10;
  double known_rel_sigma = 0.1;  ///< of what sources of other nuclides leave in a channel, besides their activity's
  int sources_max = 32;          ///< what fits one datagram
  int map_steps = 4;             ///< at most per update, of the map of what sources do not explain; 0: no map
};

[[nodiscard]] JointConfig read_joint_config(Config& config);

}  // namespace comptonaut
