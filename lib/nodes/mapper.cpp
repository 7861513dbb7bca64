// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mapper.h"

#include <cmath>

#include "nodes/cones.h"

namespace comptonaut {
namespace {

/// The batch's frame of time and place, without anything measured.
MeasurementBatch empty_batch(const EventBatch& events, const Eigen::Isometry3d& X_WD, const Eigen::Vector3d& v_WD,
                             double battery_percent) {
  return {.key = {},
          .utime = events.utime,
          .duration_us = events.duration_us,
          .live_us = 0,
          .utime_sigma_us = events.utime_sigma_us,
          .p_WD = X_WD.translation(),
          .q_WD = Eigen::Quaterniond(X_WD.linear()).normalized(),
          .v_WD = v_WD,
          .battery_percent = battery_percent,
          .others = 0,
          .channels = {},
          .cones = {}};
}

}  // namespace

Mapper::Mapper(const MapperConfig& config, const BatchKey& first_key, const World& terrain)
    : config_(config),
      next_key_(first_key),
      poses_(microseconds(config.pose_gap_max_s)),
      terrain_(terrain, config.points, microseconds(config.pose_wait_s)) {}

std::vector<MeasurementBatch> Mapper::on_pose(const StampedPose& pose) {
  StampedPose unit = pose;
  unit.q_WB.normalize();  // a float's rounding would grow into axes that are not unit
  ++(poses_.add(unit) ? counts_.poses : counts_.poses_refused);
  terrain_.on_poses(poses_, pose.utime);
  return release(false);
}

std::vector<MeasurementBatch> Mapper::on_events(const EventBatch& events) {
  return accept(events) ? release(false) : std::vector<MeasurementBatch>{};
}

void Mapper::on_points(const RangePoints& points) { terrain_.on_points(points); }

void Mapper::on_vehicle(const VehicleState& vehicle) {
  if (vehicle.sender == next_key_.sender) battery_percent_ = vehicle.battery_percent;
}

std::vector<TerrainTile> Mapper::take_terrain() {
  return released_until_ ? terrain_.take_tiles(*released_until_, next_key_) : std::vector<TerrainTile>{};
}

std::vector<MeasurementBatch> Mapper::on_end() { return release(true); }

Mapper::Position Mapper::position_of(const BatchKey& key) {
  const auto [epoch, first] = epochs_.try_emplace(key.boot_epoch, std::ssize(epochs_));
  return {epoch->second, key.number};
}

bool Mapper::accept(const EventBatch& events) {
  if (events.key.sender != next_key_.sender || events.key.mission != next_key_.mission) {
    ++counts_.events_of_others;
    return false;
  }
  const Position position = position_of(events.key);
  const bool in_order = waiting_.empty() || position > waiting_.rbegin()->first;
  if ((last_released_ && position <= *last_released_) || !waiting_.emplace(position, events).second) {
    ++counts_.events_refused;
    return false;
  }
  ++counts_.events;
  if (in_order) newest_utime_ = events.utime + events.duration_us;
  if (!in_order) ++counts_.events_reordered;
  return true;
}

std::vector<MeasurementBatch> Mapper::release(bool everything) {
  std::vector<MeasurementBatch> released;
  while (!waiting_.empty()) {
    const auto& [position, events] = *waiting_.begin();
    const Utime end = events.utime + events.duration_us;
    const bool waited_enough = newest_utime_ >= end + microseconds(config_.pose_wait_s);
    if (!everything && !waited_enough && !poses_.at(end)) break;
    for (MeasurementBatch& batch : measured(events)) {
      batch.key = next_key_;
      ++next_key_.number;
      released_until_ = batch.end_utime();
      released.push_back(std::move(batch));
    }
    count_missing(position);
    last_released_ = position;
    waiting_.erase(waiting_.begin());
  }
  counts_.batches += static_cast<std::int64_t>(released.size());
  return released;
}

std::vector<MeasurementBatch> Mapper::measured(const EventBatch& events) {
  const Utime middle = events.utime + events.duration_us / 2;
  const auto X_WD_at = [this](Utime utime) -> std::optional<Eigen::Isometry3d> {
    const auto pose = poses_.at(utime);
    return pose ? std::optional<Eigen::Isometry3d>(pose->X_WB() * config_.X_BD) : std::nullopt;
  };
  const auto pose = poses_.at(middle);
  if (!pose) {
    const auto last = poses_.last_known(middle);
    ++(last ? counts_.batches_without_pose : counts_.batches_before_first_pose);
    if (!last) return {};
    const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return {empty_batch(events, last->X_WB() * config_.X_BD, unknown, battery_percent_)};
  }
  const Eigen::Vector3d v_WD_B = pose->v_WB_B + pose->w_WB_B.cross(config_.X_BD.translation());
  MeasurementBatch batch = empty_batch(events, pose->X_WB() * config_.X_BD, pose->q_WB * v_WD_B, battery_percent_);
  batch.live_us = events.live_us;
  batch.others = events.others;
  batch.channels = events.channels;
  batch.cones = to_cones(events, X_WD_at);
  const std::int64_t photons = batch.cones.empty() ? 0 : batch.cones.back().event + 1;
  counts_.pairs_without_pose += static_cast<std::int64_t>(events.pairs.size()) - photons;
  counts_.cones += static_cast<std::int64_t>(batch.cones.size());
  std::vector<MeasurementBatch> parts = in_datagrams(std::move(batch));
  counts_.batches_continued += static_cast<std::int64_t>(parts.size()) - 1;
  return parts;
}

void Mapper::count_missing(const Position& position) {
  const auto [epoch, number] = position;
  const bool same_epoch = last_released_ && last_released_->first == epoch;
  counts_.events_missing += same_epoch ? number - last_released_->second - 1 : last_released_ ? number : 0;
}

std::vector<Counter> Mapper::counters() const {
  std::vector<Counter> counters = {{"events", counts_.events},
                                   {"events_refused", counts_.events_refused},
                                   {"events_reordered", counts_.events_reordered},
                                   {"events_missing", counts_.events_missing},
                                   {"events_of_others", counts_.events_of_others},
                                   {"events_waiting", static_cast<std::int64_t>(waiting_.size())},
                                   {"poses", counts_.poses},
                                   {"poses_refused", counts_.poses_refused},
                                   {"batches", counts_.batches},
                                   {"batches_without_pose", counts_.batches_without_pose},
                                   {"batches_before_first_pose", counts_.batches_before_first_pose},
                                   {"batches_continued", counts_.batches_continued},
                                   {"pairs_without_pose", counts_.pairs_without_pose},
                                   {"cones", counts_.cones}};
  for (Counter& counter : terrain_.counters()) counters.push_back(std::move(counter));
  return counters;
}

}  // namespace comptonaut
