// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/cells.h"
#include "core/time.h"
#include "radiation/look.h"
#include "radiation/source_estimate.h"
#include "search/search_config.h"

namespace comptonaut {

class World;

/// One MAV as the search sees it.
struct Searcher {
  std::int32_t mav = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< last known position, m
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< m/s
  std::vector<Eigen::Vector3d> track_W;           ///< where it was since the tick before, in order, p_W last
};

/// What a nuclide's photons give in a channel, and what is in their way.
struct LineFacts {
  double single_response = 1e-6;      ///< chance of a single per decay at 1 m, mean over all directions
  double attenuation_per_m = 0.0093;  ///< of air
  double obstacles_per_m = 17.9;      ///< of what is occupied
};

/// The channel of one nuclide: in it count its own sources and those of the nuclides above it.
struct ChannelFacts {
  std::string nuclide = "Cs-137";
  std::vector<LineFacts> lines = {{}};  ///< its own, then of the nuclides of the channels after it
};

/// What stays the same all through a mission.
struct SearchFacts {
  double activity_min_Bq = 1e8;  ///< sources that are looked for
  double activity_max_Bq = 1e10;
  std::vector<ChannelFacts> channels = {{}};  ///< by rising line
  double gain_to_add = 18.0;                  ///< in log likelihood, by which the estimator adds a source
  double speed_max_m_s = 8.0;                 ///< of every leg
  double acceleration_max_m_s2 = 3.6;
  double corner_deviation_max_m = 0.25;  ///< by which MAVs cut corners
};

/// What a strategy decides on, at one tick.
struct SearchState {
  const Cells& cells;
  const World& world;
  std::span<const double> lambda_Bq;             ///< per cell
  std::span<const double> sensitivity_s;         ///< s_j of pairs, per cell
  std::span<const Searcher> mavs;                ///< of known position, by number
  Utime utime = 0;                               ///< the tick
  std::span<const SourceEstimate> sources = {};  ///< as known at the tick; NaN where the estimator does not tell
  SearchFacts facts = {};
  std::span<const std::vector<Look>> looks = {};  ///< per channel all that the team counted; none: nobody tells
};

/// What one MAV is to do: points to fly to, one after another in straight legs. None: hold.
struct Course {
  std::vector<Eigen::Vector3d> points_W;
  std::string status;                          ///< in words
  bool unreachable = false;                    ///< no way leads to the MAV's first target, whoever else is there,
  std::vector<Eigen::Vector3d> pocket_W = {};  ///< places, found on the way, to which none leads either
};

/// Proposes where to fly next; safety is not its business. Deterministic: what it says depends on its configuration and
/// on the states that it was shown, tick by tick, alone.
class Strategy {
 public:
  virtual ~Strategy() = default;
  /// One course per MAV of the state, in their order. A list that was begun is kept, without the points that have been
  /// reached, until the strategy has a reason to change it.
  virtual std::vector<Course> plan(const SearchState& state) = 0;
};

/// The strategy that the configuration names. Throws std::invalid_argument where there is none of that name. "none"
/// gives no strategy: nullptr.
[[nodiscard]] std::unique_ptr<Strategy> make_strategy(const SearchConfig& config);

}  // namespace comptonaut
