// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "search/prospect.h"

namespace comptonaut {

/// A flight that is thought of, and what the team knows after it.
struct Path {
  std::vector<Eigen::Vector3d> points_W;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< at its end
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< at its end: it does not stop there
  double time_s = 0.0;
  Eigen::ArrayXf known;  ///< answers to the prospect's questions
  double gain = 0.0;     ///< in worth

  [[nodiscard]] double gain_per_s() const { return time_s > 0.0 ? gain / time_s : 0.0; }
};

/// What a MAV's flights are judged by.
struct Lookahead {
  const CoarseGround& ground;
  const Prospect& prospect;
  const InformationConfig& config;
  double set_height_m = 2.0;
  double speed_max_m_s = 8.0;
  /// Whether a MAV may fly from its place to a point at once: the others are not in the way.
  std::function<bool(const Eigen::Vector3d& to_W)> free;
};

/// The path and one straight leg more: turned from its velocity into the leg's direction, then as fast as acceleration
/// and speed allow. A leg that ends where it starts is a stop of one second.
[[nodiscard]] Path with_leg(const Lookahead& lookahead, const Path& path, const Eigen::Vector3d& to_W);

/// Of the flights of config.legs_ahead legs from where `start` ends, the one that gains most per second, found by
/// following the config.paths_kept best of each length; among legs are stops. `sources_W` are places worth a visit.
/// Its first leg is free.
[[nodiscard]] Path best_path(const Lookahead& lookahead, const Path& start, std::span<const SourceEstimate> sources);

}  // namespace comptonaut
