// SPDX-License-Identifier: BSD-3-Clause
#include "flight/route.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/segment.h"
#include "flight/grid_search.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Distance of a point from a leg in units of the separation: 1 is just far enough.
double separations(const Envelope& separation, const Eigen::Vector3d& p_W, const Leg& leg) {
  const Eigen::Vector3d unit(separation.radius_m, separation.radius_m, separation.half_height_m);
  const Eigen::Vector3d p = p_W.cwiseQuotient(unit);
  return (p - nearest_on<3>(leg.from_W.cwiseQuotient(unit), leg.to_W.cwiseQuotient(unit), p)).norm();
}

Envelope with_margin(const RouteConfig& config) {
  return {.radius_m = config.envelope.radius_m + config.margin_m, .half_height_m = config.envelope.half_height_m};
}

class LegCheck {
 public:
  LegCheck(const World& world, const RouteConfig& config, std::span<const Leg> taken, const Eigen::Vector3d& start_W)
      : world_(world), config_(config), taken_(taken), wide_(with_margin(config)), start_W_(start_W) {
    start_envelope_ = kept_envelope(world, wide_, start_W);
  }

  [[nodiscard]] bool clear(const Leg& leg) const {
    return config_.fence.allows(leg) && keeps_from_taken(leg) &&
           (starts_in_the_open(leg) || !meets_closed(world_, gets_away(leg) ? start_envelope_ : wide_, leg));
  }

  /// Whether no way can lead there, so that a search would be in vain.
  [[nodiscard]] bool hopeless(const Eigen::Vector3d& start_W, const Eigen::Vector3d& goal_W) const {
    if (!config_.fence.contains(goal_W) || !clear({goal_W, goal_W})) return true;
    return std::ranges::any_of(taken_, [&](const Leg& other) {
      const double at_start = separations(config_.separation, start_W, other);
      return separations(config_.separation, goal_W, other) < std::min(1.0, at_start);
    });
  }

 private:
  /// Whether it is the first step of the grid.
  [[nodiscard]] bool gets_away(const Leg& leg) const {
    return leg.from_W == start_W_ && (leg.to_W - leg.from_W).norm() < 1.8 * config_.step_m;
  }

  [[nodiscard]] bool keeps_from_taken(const Leg& leg) const {
    return std::ranges::all_of(taken_, [&](const Leg& other) { return keeps_apart(config_.separation, leg, other); });
  }

  /// Whether there is no closed space at all as far as a step of the grid leads: one look for all 26 steps from a
  /// point.
  [[nodiscard]] bool starts_in_the_open(const Leg& leg) const {
    if ((leg.to_W - leg.from_W).cwiseAbs().maxCoeff() > kGoalReach * config_.step_m) return false;
    if (!open_from_ || *open_from_ != leg.from_W) {
      Box around = bounds(wide_, {leg.from_W, leg.from_W});
      around.min_W.array() -= kGoalReach * config_.step_m;
      around.max_W.array() += kGoalReach * config_.step_m;
      open_from_ = leg.from_W;
      open_ = !world_.closed(around);
    }
    return open_;
  }

  const World& world_;
  const RouteConfig& config_;
  std::span<const Leg> taken_;
  Envelope wide_;            ///< the envelope with its margin
  Envelope start_envelope_;  ///< what of it a leg from the start can keep
  Eigen::Vector3d start_W_;
  mutable std::optional<Eigen::Vector3d> open_from_;  ///< the last point that was looked at
  mutable bool open_ = false;
};

// Of each point, goes on to the last one that a clear leg reaches.
Points shortened(const Points& points, const LegCheck& check) {
  Points result{points.front()};
  for (std::size_t i = 0; i + 1 < points.size();) {
    std::size_t next = points.size() - 1;
    while (next > i + 1 && !check.clear({points[i], points[next]})) --next;
    result.push_back(points[next]);
    i = next;
  }
  return result;
}

/// The straight line, or over a grid and shortened: the fine grid where the goal is near and soon found, else the wide
/// one, whose few points lead far but not through every gap, and the fine one where that leads nowhere.
GridAnswer search(const World& world, const RouteConfig& config, const Eigen::Vector3d& start_W,
                  const Eigen::Vector3d& goal_W, std::span<const Leg> taken) {
  constexpr double kNear_steps = 30.0, kWide = 4.0;
  constexpr std::size_t kSoon = 1000;
  const LegCheck check(world, config, taken, start_W);
  if (check.hopeless(start_W, goal_W)) return {};
  if (check.clear({start_W, goal_W})) return {.path = Points{start_W, goal_W}, .pocket_W = {}};
  const auto over_grid = [&](double step_m, std::size_t expanded_max) {
    GridAnswer answer = shortest_grid_path({.start_W = start_W,
                                            .goal_W = goal_W,
                                            .step_m = step_m,
                                            .clear = [&](const Leg& leg) { return check.clear(leg); },
                                            .expanded_max = expanded_max,
                                            .both_ways = config.fence.contains(start_W)});
    if (answer.path) answer.path = shortened(*answer.path, check);
    return answer;
  };
  if ((goal_W - start_W).norm() <= kNear_steps * config.step_m) {
    GridAnswer soon = over_grid(config.step_m, std::min(kSoon, config.expanded_max));
    if (soon.path || !soon.pocket_W.empty()) return soon;
  }
  GridAnswer wide = over_grid(kWide * config.step_m, config.expanded_max);
  return wide.path ? wide : over_grid(config.step_m, config.expanded_max);
}

}  // namespace

bool meets_closed(const World& world, const Envelope& envelope, const Leg& leg) {
  return world.any_closed(bounds(envelope, leg), [&](const Box& box) { return sweep_meets(envelope, leg, box); });
}

bool may_hover(const World& world, const RouteConfig& config, const Eigen::Vector3d& p_W) {
  return !meets_closed(world, with_margin(config), {p_W, p_W});
}

Envelope kept_envelope(const World& world, Envelope envelope, const Eigen::Vector3d& p_W) {
  constexpr double kSmaller = 0.7;
  constexpr int kTries = 8;  // 0.6 m are then 3 cm
  for (int i = 0; i < kTries && meets_closed(world, envelope, {p_W, p_W}); ++i) {
    envelope.radius_m *= kSmaller;
    envelope.half_height_m *= kSmaller;
  }
  return envelope;
}

// The allowance is more than what counts as a hit, so that a MAV right beside the other leg, or on it, is not stuck
// there.
double kept_share(const Envelope& separation, const Eigen::Vector3d& p_W, const Leg& other) {
  constexpr double kAllowance_m = 2.0 * kCollisionTolerance_m;
  const double now = separations(separation, p_W, other);
  return now < 1.0 ? now - kAllowance_m / std::min(separation.radius_m, separation.half_height_m) : 1.0;
}

bool keeps_apart(const Envelope& separation, const Leg& leg, const Leg& other) {
  const double share = kept_share(separation, leg.from_W, other);
  return share <= 0.0 || !sweep_meets({share * separation.radius_m, share * separation.half_height_m}, leg, other);
}

std::optional<Points> find_route(const World& world, const RouteConfig& config, const Eigen::Vector3d& start_W,
                                 const Eigen::Vector3d& goal_W, std::span<const Leg> taken) {
  return search(world, config, start_W, goal_W, taken).path;
}

NoRoute why_no_route(const World& world, const RouteConfig& config, const Eigen::Vector3d& start_W,
                     const Eigen::Vector3d& goal_W) {
  const Fence& fence = config.fence;
  if (!fence.within_border(goal_W)) return {"it is outside the fence"};
  if (!fence.contains(goal_W)) return {"nobody may fly there"};
  if (!may_hover(world, config, goal_W)) return {"it is at an obstacle or in unknown space"};
  const Envelope kept = kept_envelope(world, with_margin(config), start_W);
  if (meets_closed(world, kept, {start_W, start_W})) return {"the MAV is at an obstacle or in unknown space"};
  const GridAnswer alone = search(world, config, start_W, goal_W, {});
  if (alone.path) return {.why = "other MAVs are in the way", .without_others = false};
  if (!alone.pocket_W.empty()) return {.why = "it is walled in", .pocket_W = alone.pocket_W};
  return {fmt::format("it is walled in, or farther than {} steps", config.expanded_max)};
}

}  // namespace comptonaut
