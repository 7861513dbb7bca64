// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "report/json_parts.h"

namespace comptonaut {
namespace {

using nlohmann::json;

json track_to_json(const MissionRecord& record, const DroneRecord& drone) {
  json t_s = json::array(), x_m = json::array(), y_m = json::array(), z_m = json::array();
  for (const TrackPoint& point : drone.track) {
    t_s.push_back(rounded(record.t_s(point.utime), 2));
    x_m.push_back(rounded(point.p_W.x(), 2));
    y_m.push_back(rounded(point.p_W.y(), 2));
    z_m.push_back(rounded(point.p_W.z(), 1));
  }
  return {{"t_s", t_s}, {"x_m", x_m}, {"y_m", y_m}, {"z_m", z_m}};
}

json rates_to_json(const MissionRecord& record, const DroneRecord& drone) {
  json rates = {{"t_s", json::array()}, {"live_s", json::array()}};
  for (const char* kind : {"singles", "pairs", "others"}) rates[kind] = json::array();
  for (const auto& [utime, sums] : drone.seconds) {
    rates["t_s"].push_back(rounded(record.t_s(utime), 2));
    rates["live_s"].push_back(rounded(seconds(sums.live_us), 3));
    rates["singles"].push_back(sums.singles);
    rates["pairs"].push_back(sums.pairs);
    rates["others"].push_back(sums.others);
  }
  return rates;
}

json plans_to_json(const MissionRecord& record, const DroneRecord& drone) {
  json plans = json::array();
  for (const PlanRecord& plan : drone.plans) {
    json waypoints = json::array();
    for (const Eigen::Vector3d& p_W : plan.waypoints) waypoints.push_back({rounded(p_W.x(), 1), rounded(p_W.y(), 1)});
    plans.push_back({{"t_s", rounded(record.t_s(plan.utime), 2)}, {"status", plan.status}, {"waypoints_m", waypoints}});
  }
  return plans;
}

json pose_to_json(const PoseRecord& pose) {
  const double none = std::nan("");
  const auto mean = [none](double sum, std::int64_t n) { return n > 0 ? sum / static_cast<double>(n) : none; };
  return {{"messages", pose.poses},
          {"sigma_mean_m", rounded(mean(pose.sigma_sum_m, pose.sigmas), 3)},
          {"quality_worst_percent", pose.worst_percent < 0 ? json(nullptr) : json(pose.worst_percent)},
          {"resets", pose.resets},
          {"error_rms_m", rounded(std::sqrt(mean(pose.error_sum_m2, pose.errors)), 3)}};
}

json vehicle_to_json(const VehicleState& vehicle) {
  return {{"connected", vehicle.connected},
          {"armed", vehicle.armed},
          {"mode", vehicle.mode},
          {"battery_percent", rounded(vehicle.battery_percent, 0)},
          {"hold_reason", vehicle.hold_reason}};
}

json fence_to_json(const VehicleState& vehicle) {
  json fence = json::array();
  for (const Eigen::Vector2d& corner : vehicle.fence_m)
    fence.push_back({rounded(corner.x(), 2), rounded(corner.y(), 2)});
  return fence;
}

json drone_to_json(const MissionRecord& record, int mav, const DroneRecord& drone) {
  const double flown_s = drone.track.empty() ? 0.0 : seconds(drone.track.back().utime - drone.track.front().utime);
  json result = {{"mav", mav},
                 {"track", track_to_json(record, drone)},
                 {"rates", rates_to_json(record, drone)},
                 {"plans", plans_to_json(record, drone)},
                 {"pose", pose_to_json(drone.pose)},
                 {"vehicle", nullptr},
                 {"fence_m", json::array()},
                 {"nearest", nullptr},
                 {"live_s", rounded(seconds(drone.total.live_us), 2)},
                 {"distance_m", rounded(drone.distance_m, 1)},
                 {"speed_mean_m_s", rounded(flown_s > 0 ? drone.distance_m / flown_s : 0.0, 2)},
                 {"singles", drone.total.singles},
                 {"pairs", drone.total.pairs},
                 {"others", drone.total.others},
                 {"batches", drone.batches},
                 {"batches_missing", drone.batches_missing},
                 {"batches_repeated", drone.batches_repeated},
                 {"refused", drone.refused}};
  if (drone.vehicle) {
    result["vehicle"] = vehicle_to_json(*drone.vehicle);
    result["fence_m"] = fence_to_json(*drone.vehicle);
  }
  if (std::isfinite(drone.nearest.distance_m)) {
    result["nearest"] = {{"distance_m", rounded(drone.nearest.distance_m, 2)},
                         {"mav", drone.nearest.mav},
                         {"t_s", rounded(record.t_s(drone.nearest.utime), 1)}};
  }
  return result;
}

/// Whether a counter that is not zero tells of something that went wrong. By its name, since each node has its own.
bool tells_of_a_fault(std::string_view name) {
  static constexpr std::array kWords = {
      "refused", "lost",     "drop",    "gap",      "missing",     "invalid",    "fail",         "error",
      "late",    "timeout",  "skipped", "given_up", "cut_short",   "reset",      "without",      "bad",
      "range",   "too_",     "stale",   "backward", "not_six",     "not_finite", "no_time",      "out_of",
      "marker",  "repeated", "zero",    "held",     "unreachable", "gave_way",   "incompatible", "overflow"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [name](const char* word) { return name.find(word) != std::string_view::npos; });
}

}  // namespace

json drones_to_json(const MissionRecord& record) {
  json drones = json::array();
  for (const auto& [mav, drone] : record.drones) drones.push_back(drone_to_json(record, mav, drone));
  return drones;
}

json daemons_to_json(const MissionRecord& record) {
  json daemons = json::array();
  for (const auto& [name, daemon] : record.daemons) {
    json faults = json::object(), others = json::object();
    for (const auto& [counter, value] : daemon.counters) {
      (value != 0 && tells_of_a_fault(counter) ? faults : others)[counter] = value;
    }
    daemons.push_back({{"name", name},
                       {"version", daemon.version},
                       {"state", daemon.state},
                       {"messages", daemon.messages},
                       {"faults", faults},
                       {"counters", others}});
  }
  return daemons;
}

}  // namespace comptonaut
