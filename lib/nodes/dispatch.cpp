// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/dispatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/plan_of.h"
#include "search/courses.h"

namespace comptonaut {
namespace {

/// The way home is hardly ever straight, and never as quick as its length.
constexpr double kDetour = 1.5;
constexpr double kDetourOfWay = 1.2;  // of one that is known

/// Between obstacles the way home is looked for from when it could matter, were it so much longer than straight.
constexpr double kFarthest = 4.0;
constexpr double kFarthest_m = 50.0;

/// A MAV whose detector has been dead for so long has nothing to do out there.
constexpr double kBlind_s = 10.0;

/// One that has been lost for so long is not told to hold any more: without plans it returns on its own.
constexpr double kGivenUp_s = 30.0;

/// From when it is time until the MAV hears of it: a plan comes each second.
constexpr double kHears_s = 2.0;

/// For each other MAV that goes home so near: they wait for each other.
constexpr double kWaits_s = 2.5;
constexpr double kNearHome_m = 25.0;

constexpr double kStands_m_s = 0.5;

constexpr double kTells_percent = 3.0;        // autopilots tell whole ones: how quickly it falls is known after so many
constexpr double kNewBattery_percent = 30.0;  // more than before: without its load one tells some more, too
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Of the separation that ways keep in space: flights, which keep it in space and time, need less.
constexpr double kFlightShare = 0.85;

/// Those on their way home keep more, as far as their homes are apart: they hang there, one after another, and the
/// last line of a MAV that stands before one lets it go on with half a metre more than the separation.
constexpr double kHomeShareMax = 1.25;
constexpr double kOfHomes = 0.95;
constexpr double kHomeFlightShare = 0.9;  // of what their ways keep

double length_m(std::span<const Eigen::Vector3d> way_W) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < way_W.size(); ++i) sum_m += (way_W[i] - way_W[i - 1]).norm();
  return sum_m;
}

RouteConfig with_separation(RouteConfig route, double share) {
  route.separation.radius_m *= share;
  route.separation.half_height_m *= share;
  return route;
}

}  // namespace

Dispatch::Dispatch(const CoordinatorConfig& config, const SearchFacts& facts)
    : config_(config),
      facts_(facts),
      strategy_(make_strategy(config.search)),
      team_flight_({.limits = {.speed_max_m_s = config.speed_max_m_s,
                               .acceleration_max_m_s2 = config.acceleration_max_m_s2,
                               .corner_deviation_max_m = config.corner_deviation_max_m}}) {}

void Dispatch::begin_tick() {
  for (auto& [number, mav] : mavs_) {
    mav.searcher.track_W = {mav.searcher.p_W};
    mav.tick_utime = 0;  // batches of one MAV come in order, but its clock may have been set back
  }
}

void Dispatch::see(const MeasurementBatch& batch) {
  if (!batch.has_pose()) return;
  const auto [it, is_new] = mavs_.try_emplace(batch.key.sender);
  Mav& mav = it->second;
  if (!is_new && batch.utime < mav.tick_utime) return;
  mav.tick_utime = batch.utime;
  mav.last_utime = batch.utime;
  if (is_new) {
    mav.first_utime = mav.live_utime = batch.utime;
    mav.home_W = batch.p_WD;
    mav.searcher.mav = batch.key.sender;
  }
  mav.searcher.p_W = batch.p_WD;
  mav.searcher.v_W = batch.v_WD;
  note_battery(batch, mav);
  if (batch.live_us == 0) return;
  mav.live_utime = batch.utime;
  mav.searcher.track_W.push_back(batch.p_WD);
}

/// With a new battery it searches again.
void Dispatch::note_battery(const MeasurementBatch& batch, Mav& mav) {
  if (std::isnan(batch.battery_percent)) return;
  const bool first = std::isnan(mav.battery_percent);
  const bool is_new = batch.battery_percent >= mav.battery_percent + kNewBattery_percent;
  mav.battery_percent = batch.battery_percent;
  if (!first && !is_new) return;
  mav.begin_percent = batch.battery_percent;
  mav.begin_utime = batch.utime;
  if (!is_new) return;
  mav.first_utime = batch.utime;
  mav.goes_home = false;
}

double Dispatch::battery_left_s(const Mav& mav) const {
  if (config_.battery_reserve_percent <= 0.0) return kInfinite;
  const double left_percent = mav.battery_percent - config_.battery_reserve_percent;
  if (left_percent <= 0.0) return 0.0;
  const double used_percent = mav.begin_percent - mav.battery_percent;
  if (!(used_percent >= kTells_percent)) return kInfinite;
  return left_percent / used_percent * seconds(mav.last_utime - mav.begin_utime);
}

bool Dispatch::is_lost(const Mav& mav, Utime tick) const {
  return tick - mav.last_utime > microseconds(config_.gap_give_up_s) + kSecond_us;
}

std::string_view Dispatch::why_home(const Mav& mav, Utime tick) {
  if (mav.goes_home) return "battery";
  return tick - mav.live_utime > microseconds(kBlind_s) ? "its detector measures nothing" : "";
}

bool Dispatch::must_go_home(const World& world, const RouteConfig& route, const Mav& mav, Utime tick) const {
  const double turn_and_stop_s = 2.0 * config_.speed_max_m_s / config_.acceleration_max_m_s2;
  const auto beside = std::ranges::count_if(
      mavs_, [&](const auto& other) { return (other.second.home_W - mav.home_W).norm() < kNearHome_m; });
  const double waits_s = kWaits_s * static_cast<double>(beside - 1);
  const double endurance_left_s =
      config_.endurance_s > 0.0 ? config_.endurance_s - config_.reserve_s - seconds(tick - mav.first_utime) : kInfinite;
  const double left_s = std::min(endurance_left_s, battery_left_s(mav));
  const auto is_time = [&](double way_m) {
    return kHears_s + waits_s + turn_and_stop_s + way_m / config_.speed_max_m_s >= left_s;
  };
  const double straight_m = (mav.searcher.p_W - mav.home_W).norm();
  if (world.is_flat()) return is_time(kDetour * straight_m);
  if (!is_time(kFarthest_m + kFarthest * straight_m)) return false;
  const auto way = find_route(world, route, mav.searcher.p_W, route.fence.nearest_allowed(mav.home_W));
  return is_time(way ? kDetourOfWay * length_m(*way) : kDetour * straight_m);
}

std::vector<Leg> Dispatch::standing(const Mav& mav, Utime tick) const {
  std::vector<Leg> places;
  for (const auto& [number, other] : mavs_) {
    const Searcher& searcher = other.searcher;
    const bool stays = !why_home(other, tick).empty() && searcher.v_W.norm() <= kStands_m_s;
    if (stays && number != mav.searcher.mav) places.push_back({.from_W = searcher.p_W, .to_W = searcher.p_W});
  }
  return places;
}

double Dispatch::home_share(const RouteConfig& route) const {
  double nearest_m = kInfinite;
  for (const auto& [number, mav] : mavs_) {
    for (const auto& [other, beside] : mavs_) {
      if (other < number) nearest_m = std::min(nearest_m, (mav.home_W - beside.home_W).norm());
    }
  }
  return std::clamp(kOfHomes * nearest_m / route.separation.radius_m, kFlightShare, kHomeShareMax);
}

Course Dispatch::home_course(const World& world, const RouteConfig& route, const Mav& mav, Utime tick) const {
  const Eigen::Vector3d& p_W = mav.searcher.p_W;
  const Eigen::Vector3d home_W = route.fence.nearest_allowed(mav.home_W);
  const std::string_view why = why_home(mav, tick);
  const bool stands = mav.searcher.v_W.norm() <= kStands_m_s;  // else it would overshoot
  if (stands && (p_W - home_W).norm() <= config_.search.reach_m)
    return {.points_W = {}, .status = fmt::format("{}: at home", why)};
  auto way = find_route(world, route, p_W, home_W, standing(mav, tick));
  if (!way) way = find_route(world, route, p_W, home_W);  // they began nearer to each other than they fly
  if (way) return {.points_W = {way->begin() + 1, way->end()}, .status = fmt::format("{}: flying home", why)};
  return {.points_W = {},
          .status = fmt::format("{}: no way home: {}", why, why_no_route(world, route, p_W, home_W).why)};
}

/// What the strategy proposes to those that are neither lost nor on their way home.
std::map<std::int32_t, Course> Dispatch::search_courses(const Map& map, Utime tick) {
  std::vector<Searcher> searchers;
  for (const auto& [number, mav] : mavs_) {
    if (!is_lost(mav, tick) && why_home(mav, tick).empty()) searchers.push_back(mav.searcher);
  }
  std::map<std::int32_t, Course> courses;
  if (searchers.empty()) return courses;
  const std::vector<Course> found = strategy_->plan({.cells = map.cells,
                                                     .world = map.world,
                                                     .lambda_Bq = map.lambda_Bq,
                                                     .sensitivity_s = map.sensitivity_s,
                                                     .mavs = searchers,
                                                     .utime = tick,
                                                     .sources = map.sources,
                                                     .facts = facts_,
                                                     .looks = map.looks});
  for (std::size_t i = 0; i < searchers.size(); ++i) courses[searchers[i].mav] = found[i];
  return courses;
}

std::vector<Plan> Dispatch::plans(const Map& map, Utime tick, std::int64_t term) {
  if (!strategy_ || mavs_.empty()) return {};
  const RouteConfig route = with_keep_out(map.sources, config_.search).route;
  for (auto& [number, mav] : mavs_) {
    mav.goes_home = mav.goes_home || (!is_lost(mav, tick) && must_go_home(map.world, route, mav, tick));
  }
  std::map<std::int32_t, Course> courses = search_courses(map, tick);
  const double homeward_share = home_share(route);
  std::vector<Flyer> homeward, others;
  for (const auto& [number, mav] : mavs_) {
    const bool lost = is_lost(mav, tick), goes_home = !lost && !why_home(mav, tick).empty();
    Course& course = courses[number];
    if (goes_home) course = home_course(map.world, with_separation(route, homeward_share), mav, tick);
    if (lost) course.status = fmt::format("lost: no position for {} s", (tick - mav.last_utime) / kSecond_us);
    const Motion now{.p_W = mav.searcher.p_W, .v_W = mav.searcher.v_W, .a_W = Eigen::Vector3d::Zero()};
    (goes_home ? homeward : others).push_back({.mav = number, .now = now, .course_W = course.points_W, .lost = lost});
  }
  const double flight_share =
      homeward.empty() ? kFlightShare : std::max(kFlightShare, kHomeFlightShare * homeward_share);
  std::vector<Flyer> flyers = std::move(homeward);  // they have the right of way
  flyers.insert(flyers.end(), others.begin(), others.end());
  const std::vector<Flight> flights = team_flight_.plan(map.world, with_separation(route, flight_share), flyers, tick);
  std::vector<Plan> plans;
  for (std::size_t i = 0; i < flyers.size(); ++i) {
    if (tick - mavs_.at(flyers[i].mav).last_utime > microseconds(kGivenUp_s)) continue;
    plans.push_back(plan_of(courses[flyers[i].mav].status, flights[i], flyers[i].mav, config_, tick, term));
  }
  std::ranges::sort(plans, {}, &Plan::mav);
  return plans;
}

}  // namespace comptonaut
