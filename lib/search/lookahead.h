// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "search/prospect.h"

namespace comptonaut {

/// A flight that is thought of, and what the team does not know after it.
struct FlightPath {
  std::vector<Eigen::Vector3d> points_W;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< at its end
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< at its end: it does not stop there
  double time_s = 0.0;
  Eigen::ArrayXf open;  ///< of the weights of the prospect's questions
  double gain = 0.0;    ///< what it answers of them; what comes after t seconds counts exp(-t / patience_s)
  double score = 0.0;   ///< gain over the most that as much time could gain at a steady rate of 1 per s
};

/// What a MAV's flights are judged by.
struct Lookahead {
  const CoarseGround& ground;
  const Prospect& prospect;
  const InformationConfig& config;
  double set_height_m = 2.0;
  double speed_max_m_s = 8.0;
  double acceleration_max_m_s2 = 3.6;
  double corner_deviation_max_m = 0.25;  ///< by which it cuts corners
  /// Whether a MAV may fly from its place to a point at once: the others are not in the way.
  std::function<bool(const Eigen::Vector3d& to_W)> free;
  /// Where a MAV may hover instead of at a point, above the same square: there, unless an obstacle is too near.
  std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector3d& p_W)> hover_at = [](const Eigen::Vector3d& p_W) {
    return std::optional(p_W);
  };
};

/// A flight of no time.
[[nodiscard]] FlightPath start_flight(const Eigen::Vector3d& p_W, const Eigen::Vector3d& v_W, Eigen::ArrayXf open);

/// The flight and one straight leg more: turned from its velocity into the leg's direction, then as fast as
/// acceleration and speed allow; corners are taken as slowly as pose-bridge takes them.
[[nodiscard]] FlightPath with_leg(const Lookahead& lookahead, FlightPath path, const Eigen::Vector3d& to_W);

/// Of the flights that go on where `start` ends until they last config.horizon_s (or have config.legs_ahead legs more)
/// the one of the best score, found by following the config.paths_kept best of each number of legs. Legs lead straight
/// in 16 directions, in stretches of config.stretch_m of which each ends with a point, or to a source. The first point
/// is free; where none is, the answer is `start`.
[[nodiscard]] FlightPath best_flight(const Lookahead& lookahead, const FlightPath& start,
                                     std::span<const SourceEstimate> sources);

/// The flight with its points shifted sideways and along, one after another, wherever that scores better; the first
/// stays free.
[[nodiscard]] FlightPath polished(const Lookahead& lookahead, const FlightPath& start, FlightPath path);

}  // namespace comptonaut
