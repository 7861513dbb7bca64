// SPDX-License-Identifier: BSD-3-Clause
#include "search/information.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/time.h"
#include "flight/route.h"
#include "search/lookahead.h"

namespace comptonaut {
namespace {

using Points = std::vector<Eigen::Vector3d>;

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

}  // namespace

Information::Information(const SearchConfig& config) : config_(config) {}

std::vector<Course> Information::plan(const SearchState& state) {
  remember(state);
  const Prospect prospect = make_prospect(*ground_, kernel_, state, config_, live_s_);
  const bool finished = prospect.all_clear && prospect.all_precise;
  if (finished) {
    for (const Searcher& mav : state.mavs) targets_[mav.mav] = {homes_W_.at(mav.mav)};
    for (const Searcher& mav : state.mavs) take_reached(targets_[mav.mav], {mav.p_W}, config_.reach_m);
  } else {
    choose(state, prospect);
  }
  std::vector<Course> courses = make_courses(state, config_, targets_);
  for (std::size_t i = 0; finished && i < courses.size(); ++i) {
    const bool home = targets_[state.mavs[i].mav].empty();
    courses[i].status =
        fmt::format("clear above {:.3g} Bq, {} sources within {} m: {}", state.facts.activity_min_Bq,
                    state.sources.size(), config_.information.source_sigma_m, home ? "at home" : "flying home");
  }
  return courses;
}

void Information::remember(const SearchState& state) {
  if (!ground_) {
    ground_.emplace(state.cells, config_.information.square_m,
                    static_cast<std::size_t>(config_.information.squares_max));
    kernel_ = singles_kernel(*ground_, state, config_.set_height_m);
    live_s_ = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(ground_->size()));
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
  Eigen::ArrayXf known = prospect.known;
  for (const Searcher& mav : state.mavs) {
    const std::vector<Leg> others = others_legs(state, targets_, mav.mav);
    const Envelope& apart = config_.route.separation;
    const auto free = [&](const Eigen::Vector3d& to_W) {
      return std::ranges::all_of(others, [&](const Leg& other) { return keeps_apart(apart, {mav.p_W, to_W}, other); });
    };
    const Lookahead lookahead{.ground = *ground_,
                              .prospect = prospect,
                              .config = config_.information,
                              .set_height_m = config_.set_height_m,
                              .speed_max_m_s = state.facts.speed_max_m_s,
                              .free = free};
    targets_[mav.mav] = choice(state, mav, lookahead, known);
  }
}

/// `known` grows by what the choice will see.
Points Information::choice(const SearchState& state, const Searcher& mav, Lookahead lookahead, Eigen::ArrayXf& known) {
  const Path start{.points_W = {}, .p_W = mav.p_W, .v_W = mav.v_W, .known = known};
  Path best = best_path(lookahead, start, state.sources);
  const Points& before = targets_[mav.mav];
  if (!before.empty() && lookahead.free(before.front())) {
    Path kept = start;
    for (const Eigen::Vector3d& to_W : before) kept = with_leg(lookahead, kept, to_W);
    if (kept.gain_per_s() * config_.information.keep_factor >= best.gain_per_s()) best = std::move(kept);
  }
  known = best.known;
  return best.points_W;
}

}  // namespace comptonaut
