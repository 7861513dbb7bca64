// SPDX-License-Identifier: BSD-3-Clause
#include "search/information.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/time.h"
#include "flight/route.h"
#include "search/lookahead.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// What no way led to is not tried again for so long, nor what is so near to it.
constexpr double kAlone_s = 10.0;
constexpr double kAlone_m = 4.0;

/// The first legs of MAVs that have chosen, and where the others are.
std::vector<Leg> others_legs(const SearchState& state, const Targets& chosen, std::int32_t mav) {
  std::vector<Leg> legs;
  for (const Searcher& other : state.mavs) {
    if (other.mav == mav) continue;
    const auto targets = chosen.find(other.mav);
    const bool goes = other.mav < mav && targets != chosen.end() && !targets->second.empty();
    legs.push_back({.from_W = other.p_W, .to_W = goes ? targets->second.front() : other.p_W});
  }
  return legs;
}

FlightPath flown(const Lookahead& lookahead, FlightPath path, const Points& points_W) {
  for (const Eigen::Vector3d& to_W : points_W) path = with_leg(lookahead, std::move(path), to_W);
  return path;
}

}  // namespace

Information::Information(const SearchConfig& config) : config_(config) {}

std::vector<Course> Information::plan(const SearchState& state) {
  remember(state);
  const Prospect prospect = make_prospect(*ground_, kernels_, state, config_, live_s_, hover_W_);
  const bool nowhere = std::ranges::count(prospect.flyable, true) == 0;
  const bool finished = prospect.all_clear && prospect.all_precise && !nowhere;
  if (finished) {
    for (const Searcher& mav : state.mavs) targets_[mav.mav] = {homes_W_.at(mav.mav)};
  } else if (nowhere) {
    targets_.clear();
  } else {
    choose(state, prospect);
  }
  std::vector<Course> courses = make_courses(state, config_, targets_);
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Searcher& mav = state.mavs[i];
    leave_alone(mav.mav, courses[i], state.utime);
    if (nowhere) courses[i].status = "nobody may fly above any of the ground";
    if (finished) courses[i].status = said_at_the_end(state, prospect, mav);
  }
  return courses;
}

std::string Information::said_at_the_end(const SearchState& state, const Prospect& prospect,
                                         const Searcher& mav) const {
  const bool home = (mav.p_W - homes_W_.at(mav.mav)).head<2>().norm() <= config_.reach_m;
  const auto unseen = static_cast<double>(std::ranges::count(prospect.unseen, true));
  const std::string but = unseen > 0.0 ? fmt::format(" but for {:.0f} m2 over which nobody may fly",
                                                     unseen * std::pow(ground_->edge_m(), 2))
                                       : "";
  return fmt::format("clear above {:.3g} Bq{}, {} sources within {} m: {}", state.facts.activity_min_Bq, but,
                     state.sources.size(), config_.information.source_sigma_m, home ? "at home" : "flying home");
}

void Information::leave_alone(std::int32_t mav, const Course& course, Utime utime) {
  if (course.unreachable) left_alone_[mav].push_back({.p_W = targets_.at(mav).front(), .since = utime});
  for (std::size_t i = 0; i < ground_->size() && !course.pocket_W.empty(); ++i) {
    const auto beside = [&](const Eigen::Vector3d& p_W) {
      return hover_W_[i] && (p_W - *hover_W_[i]).cwiseAbs().maxCoeff() <= 0.5 * config_.route.step_m;
    };
    if (std::ranges::any_of(course.pocket_W, beside)) hover_W_[i].reset();
  }
}

bool Information::is_left_alone(std::int32_t mav, const Eigen::Vector3d& p_W) const {
  const auto places = left_alone_.find(mav);
  return places != left_alone_.end() && std::ranges::any_of(places->second, [&](const LeftAlone& place) {
           return (place.p_W - p_W).head<2>().norm() < kAlone_m;
         });
}

void Information::remember(const SearchState& state) {
  if (!ground_) {
    ground_.emplace(state.cells, config_.information.square_m,
                    static_cast<std::size_t>(config_.information.squares_max));
    kernels_ = singles_kernels(*ground_, state, config_.set_height_m);
    live_s_ = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(ground_->size()));
  }
  const bool world_is_new = std::exchange(world_hash_, state.world.hash()) != state.world.hash();
  if (hover_W_.empty() || world_is_new) {
    hover_W_ = hover_places(*ground_, state.world, config_.route, config_.set_height_m);
  }
  for (auto& [mav, places] : left_alone_) {
    std::erase_if(places, [&](const LeftAlone& place) { return seconds(state.utime - place.since) > kAlone_s; });
  }
  for (const Searcher& mav : state.mavs) {
    homes_W_.try_emplace(mav.mav, mav.track_W.empty() ? mav.p_W : mav.track_W.front());
    for (std::size_t i = 1; i < mav.track_W.size(); ++i) {
      live_s_(static_cast<Eigen::Index>(ground_->at(mav.track_W[i]))) += static_cast<float>(seconds(kBatch_us));
    }
    take_reached(targets_[mav.mav], mav.track_W, config_.reach_m);
  }
}

void Information::choose(const SearchState& state, const Prospect& prospect) {
  const Eigen::ArrayXf open = open_weight(prospect.weight, prospect.known);
  // The share of each question that a MAV's course leaves open; those that have yet to choose count with what they were
  // about to do.
  std::map<std::int32_t, Eigen::ArrayXf> leaves;
  const auto leave = [&](const Searcher& mav) {
    const FlightPath start = start_flight(mav.p_W, mav.v_W, Eigen::ArrayXf::Ones(open.size()));
    leaves[mav.mav] = flown(outlook(state, prospect, mav), start, targets_[mav.mav]).open;
  };
  for (const Searcher& mav : state.mavs) leave(mav);
  for (const Searcher& mav : state.mavs) {
    Eigen::ArrayXf left = open;
    for (const auto& [other, share] : leaves) {
      if (other != mav.mav) left *= share;
    }
    const FlightPath start = start_flight(mav.p_W, mav.v_W, std::move(left));
    targets_[mav.mav] = choice(state, mav, outlook(state, prospect, mav), start).points_W;
    leave(mav);
  }
}

Lookahead Information::outlook(const SearchState& state, const Prospect& prospect, const Searcher& mav) const {
  const auto free = [this, &mav, others = others_legs(state, targets_, mav.mav)](const Eigen::Vector3d& to_W) {
    const Envelope& apart = config_.route.separation;
    return !is_left_alone(mav.mav, to_W) && std::ranges::all_of(others, [&](const Leg& other) {
      return keeps_apart(apart, {mav.p_W, to_W}, other);
    });
  };
  return {.ground = *ground_,
          .prospect = prospect,
          .config = config_.information,
          .set_height_m = config_.set_height_m,
          .speed_max_m_s = state.facts.speed_max_m_s,
          .acceleration_max_m_s2 = state.facts.acceleration_max_m_s2,
          .corner_deviation_max_m = state.facts.corner_deviation_max_m,
          .free = free,
          .hover_at = [this, &state](const Eigen::Vector3d& p_W) {
            return may_hover(state.world, config_.route, p_W) ? std::optional(p_W) : hover_W_[ground_->at(p_W)];
          }};
}

FlightPath Information::choice(const SearchState& state, const Searcher& mav, const Lookahead& lookahead,
                               const FlightPath& start) const {
  FlightPath best = polished(lookahead, start, best_flight(lookahead, start, state.sources));
  const Points& before = targets_.at(mav.mav);
  if (before.empty() || !lookahead.free(before.front())) return best;
  const FlightPath kept = best_flight(lookahead, flown(lookahead, start, before), state.sources);
  const FlightPath better = polished(lookahead, start, kept);
  const double keep_factor = config_.information.keep_factor;
  if (best.score > keep_factor * better.score) return best;
  return better.score > keep_factor * kept.score ? better : kept;
}

}  // namespace comptonaut
