// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/batch_key.h"
#include "core/pose.h"
#include "detector/event_batch.h"
#include "nodes/mapper_config.h"
#include "nodes/pose_buffer.h"
#include "nodes/status.h"
#include "nodes/terrain_mapper.h"
#include "nodes/vehicle_state.h"
#include "radiation/measurement_batch.h"

namespace comptonaut {

/// Gives the events of one detector the pose of their moment: counts that of the middle of their batch, each cone that
/// of its own photon. Batches leave in the order of their numbers in EVENTS, each once; those of a detector-reader that
/// started again follow all that still waits of the one before, whatever the wall clock named the two. Once they leave,
/// what comes late of the one before is refused.
///
/// A batch waits until poses enclose it. After pose_wait_s of data time, or where a later one shows that the clock was
/// set back, it leaves without live time, counts and cones, at the last known pose; before any pose has come it is
/// counted and left out. What EVENTS lost is counted as well, and its live time is nowhere.
/// No LCM, no threads, no clock of its own: replaying the same inputs gives the same outputs.
class Mapper {
 public:
  /// `first_key` names the mission, the MAV and this process; its batches are numbered from first_key.number on.
  /// `terrain` is the map that its range points are held against.
  Mapper(const MapperConfig& config, const BatchKey& first_key, const World& terrain = World::flat());

  /// What either input releases; a batch with more cones than fit a datagram makes several.
  [[nodiscard]] std::vector<MeasurementBatch> on_pose(const StampedPose& pose);
  [[nodiscard]] std::vector<MeasurementBatch> on_events(const EventBatch& events);
  void on_points(const RangePoints& points);
  /// Batches that leave from now on say what is left of this battery.
  void on_vehicle(const VehicleState& vehicle);
  /// The changed voxels that are due (TerrainMapper), numbered after the batches that have left, none before the first:
  /// to be called when batches left, and sent after them.
  [[nodiscard]] std::vector<TerrainTile> take_terrain();
  /// No more input comes: what still waits leaves now.
  [[nodiscard]] std::vector<MeasurementBatch> on_end();

  /// End of the newest events by their number, 0 before the first.
  [[nodiscard]] Utime utime() const { return newest_utime_; }
  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  using Position = std::pair<std::int64_t, std::int64_t>;  // in EVENTS: boot epochs that appeared before, number

  [[nodiscard]] Position position_of(const BatchKey& key);
  [[nodiscard]] bool accept(const EventBatch& events);
  [[nodiscard]] std::vector<MeasurementBatch> release(bool everything);
  [[nodiscard]] std::vector<MeasurementBatch> measured(const EventBatch& events);
  void count_missing(const Position& position);

  MapperConfig config_;
  BatchKey next_key_;
  PoseBuffer poses_;
  TerrainMapper terrain_;
  std::optional<Utime> released_until_;          ///< end of the last batch that left
  std::map<std::int64_t, std::int64_t> epochs_;  ///< how many had appeared before each
  std::map<Position, EventBatch> waiting_;
  std::optional<Position> last_released_;
  Utime newest_utime_ = 0;
  double battery_percent_ = std::numeric_limits<double>::quiet_NaN();

  struct Counts {
    std::int64_t events = 0, events_refused = 0, events_reordered = 0, events_missing = 0, events_of_others = 0;
    std::int64_t poses = 0, poses_refused = 0;
    std::int64_t batches = 0, batches_without_pose = 0, batches_before_first_pose = 0, batches_continued = 0;
    std::int64_t pairs_without_pose = 0, cones = 0;
  } counts_;
};

}  // namespace comptonaut
