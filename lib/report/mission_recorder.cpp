// SPDX-License-Identifier: BSD-3-Clause
#include "report/mission_recorder.h"

#include <algorithm>
#include <cmath>

#include "report/track.h"

namespace comptonaut {
namespace {

constexpr double kDay_us = 86'400e6;

bool is_rest_of(const std::vector<Eigen::Vector3d>& waypoints, const std::vector<Eigen::Vector3d>& before) {
  return waypoints.size() <= before.size() && std::equal(waypoints.rbegin(), waypoints.rend(), before.rbegin());
}

}  // namespace

bool MissionRecorder::in_time(std::initializer_list<Utime> utimes) {
  if (!first_utime_) first_utime_ = record_.end_utime = *utimes.begin();
  const bool near = std::all_of(utimes.begin(), utimes.end(), [this](Utime utime) {
    return std::abs(static_cast<double>(utime) - static_cast<double>(*first_utime_)) < kDay_us;
  });
  ++(near ? record_.messages : record_.out_of_time);
  if (!near) return false;
  first_utime_ = std::min(*first_utime_, std::min(utimes));
  record_.end_utime = std::max(record_.end_utime, std::max(utimes));
  return true;
}

void MissionRecorder::on_measurements(const MeasurementBatch& batch) {
  if (!in_time({batch.utime})) return;
  DroneRecord& drone = record_.drones[batch.key.sender];
  Live& live = live_[batch.key.sender];
  if (!live.batches.add(batch.key)) {
    ++drone.batches_repeated;
    return;
  }
  ++drone.batches;
  for (EventSums* sums : {&drone.total, &drone.seconds[floor_to(batch.utime, kSecond_us)]}) {
    sums->live_us += batch.live_us;
    sums->others += batch.others;
    for (const ChannelCounts& channel : batch.channels) {
      sums->singles += channel.singles;
      sums->pairs += channel.pairs;
    }
  }
  if (batch.live_us > 0) extend_track(live.batch_track, {batch.utime + batch.duration_us / 2, batch.p_WD});
}

void MissionRecorder::on_terrain(const TerrainTile& tile) {
  if (!in_time({tile.utime})) return;
  DroneRecord& drone = record_.drones[tile.key.sender];
  drone.batches_repeated += live_[tile.key.sender].batches.add(tile.key) ? 0 : 1;
}

void MissionRecorder::on_pose(int mav, const StampedPose& pose) {
  if (!in_time({pose.utime})) return;
  DroneRecord& drone = record_.drones[mav];
  ++drone.pose.poses;
  extend_track(drone.track, {pose.utime, pose.p_WB});
  measure_distances(mav, pose);
  live_[mav].pose = pose;
}

void MissionRecorder::measure_distances(int mav, const StampedPose& pose) {
  for (const auto& [other, live] : live_) {
    const auto p_WOther = live.pose ? position_at(*live.pose, pose.utime) : std::nullopt;
    if (other == mav || !p_WOther) continue;
    const double distance_m = (*p_WOther - pose.p_WB).norm();
    for (const auto& [one, two] : {std::pair(mav, other), std::pair(other, mav)}) {
      NearestDrone& nearest = record_.drones[one].nearest;
      if (distance_m < nearest.distance_m) nearest = {.distance_m = distance_m, .mav = two, .utime = pose.utime};
    }
  }
}

void MissionRecorder::on_pose_quality(int mav, const PoseQuality& quality) {
  PoseRecord& pose = record_.drones[mav].pose;
  ++pose.qualities;
  if (!std::isnan(quality.position_sigma_m)) {
    pose.sigma_sum_m += quality.position_sigma_m;
    ++pose.sigmas;
  }
  const bool told = quality.quality_percent >= 0;
  if (told && (pose.worst_percent < 0 || quality.quality_percent < pose.worst_percent)) {
    pose.worst_percent = quality.quality_percent;
  }
  pose.resets = std::max(pose.resets, quality.resets);
}

void MissionRecorder::on_vehicle(int mav, const VehicleState& vehicle) { record_.drones[mav].vehicle = vehicle; }

void MissionRecorder::on_plan(int mav, const Plan& plan) {
  if (!in_time({plan.utime})) return;
  PlanRecord next{.utime = plan.utime, .status = plan.status, .waypoints = {}};
  for (const Waypoint& waypoint : plan.waypoints) next.waypoints.push_back(waypoint.p_W);
  std::vector<PlanRecord>& plans = record_.drones[mav].plans;
  const bool nothing_new =
      !plans.empty() && !next.waypoints.empty() && is_rest_of(next.waypoints, plans.back().waypoints);
  if (!nothing_new) plans.push_back(std::move(next));
}

void MissionRecorder::on_status(int mav, const DaemonStatus& status) {
  const std::string machine = mav == 0 ? "ground" : "MAV" + std::to_string(mav);
  DaemonRecord& daemon = record_.daemons[machine + " " + status.daemon];
  daemon.version = status.version;
  daemon.state = status.state;
  for (const Counter& counter : status.counters) daemon.counters[counter.name] = counter.value;
  ++daemon.messages;
  ++record_.messages;
}

void MissionRecorder::on_sources(const SourceReport& report) {
  if (!in_time({report.utime})) return;
  std::vector<SourceReport>& reports = record_.reports;
  const auto at = std::lower_bound(reports.begin(), reports.end(), report.utime,
                                   [](const SourceReport& r, Utime utime) { return r.utime < utime; });
  if (at != reports.end() && at->utime == report.utime) {
    *at = report;
  } else {
    reports.insert(at, report);
  }
}

/// Of more nuclides than anybody looks for, the tiles do not fit the first map and are counted there.
MapHistory& MissionRecorder::map_of(const std::string& nuclide) {
  constexpr std::size_t kMapsMax = 8;
  for (NuclideMap& map : maps_) {
    if (map.nuclide == nuclide) return map.history;
  }
  if (maps_.size() == kMapsMax) return maps_.front().history;
  return maps_.emplace_back(NuclideMap{.nuclide = nuclide, .history = {}}).history;
}

void MissionRecorder::on_map(const MapTile& tile) {
  if (!in_time({tile.utime})) return;
  MapHistory& map = map_of(tile.nuclide);
  if (map.opens_frame(tile)) close_frame(map);
  map.add(tile);
}

/// Of one cell size and one nuclide, those that come first: what is of another is left out.
void MissionRecorder::on_clearance(const ClearanceTile& tile) {
  if (!in_time({tile.utime})) return;
  ClearanceRecord& clearance = record_.clearance;
  if (clearance.cell_m == 0.0) clearance.cell_m = tile.cell_m, clearance.nuclide = tile.nuclide;
  if (tile.cell_m != clearance.cell_m || tile.nuclide != clearance.nuclide) return;
  for (const ClearanceCell& cell : tile.cells) clearance.limit_Bq[cell.key] = cell.limit_Bq;
}

void MissionRecorder::on_patches(const PatchReport& report) {
  if (in_time({report.utime})) record_.patches = report;
}

void MissionRecorder::close_frame(MapHistory& map) {
  double coverage = 0.0;
  for (const SourceReport& report : record_.reports) {
    if (report.utime <= map.frame_utime()) coverage = report.coverage;
  }
  map.close_frame(coverage);
}

void MissionRecorder::on_coordinator(const CoordinatorState& state) {
  if (!in_time({state.utime})) return;
  record_.coordinator = state;
  terms_.insert(state.term);
}

void MissionRecorder::on_truth(const Truth& truth) {
  if (!in_time({truth.utime, truth.start_utime})) return;
  for (const TrueMav& mav : truth.mavs) {
    const auto live = live_.find(mav.mav);
    const bool known = live != live_.end() && live->second.pose;
    const auto p_WB = known ? position_at(*live->second.pose, truth.utime) : std::nullopt;
    if (!p_WB) continue;
    PoseRecord& pose = record_.drones[mav.mav].pose;
    pose.error_sum_m2 += (*p_WB - mav.p_WB).squaredNorm();
    ++pose.errors;
  }
  record_.truth = truth;
}

void MissionRecorder::on_refused(int mav, const std::string& channel) {
  ++record_.refused[channel];
  if (mav > 0) ++record_.drones[mav].refused;
}

MissionRecord MissionRecorder::finish() && {
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    close_frame(maps_[i].history);
    MapRecord& map = i == 0 ? record_.map : record_.more_maps.emplace_back();
    map = std::move(maps_[i].history).finish();
  }
  record_.start_utime = record_.truth ? record_.truth->start_utime : first_utime_.value_or(0);
  record_.leaders = static_cast<int>(terms_.size());
  for (auto& [mav, drone] : record_.drones) {
    Live& live = live_[mav];
    drone.batches_missing = live.batches.missing();
    if (drone.track.empty()) drone.track = std::move(live.batch_track);
    drone.distance_m = length_m(drone.track);
  }
  return std::move(record_);
}

}  // namespace comptonaut
