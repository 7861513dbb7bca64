// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/pose.h"
#include "flight/plan.h"
#include "nodes/terrain_tile.h"
#include "radiation/measurement_batch.h"
#include "report/mission_record.h"
#include "report/seen_batches.h"

namespace comptonaut {

/// Accumulates the messages of a ground bus in the order of their recording. Pure: no file, no clock. Repeated batches
/// count once. The mission starts where the simulator says so, else with the first dated message.
class MissionRecorder {
 public:
  void on_measurements(const MeasurementBatch& batch);
  /// Numbered in one sequence with the measurements.
  void on_terrain(const TerrainTile& tile);
  void on_pose(int mav, const StampedPose& pose);
  void on_pose_quality(int mav, const PoseQuality& quality);
  void on_vehicle(int mav, const VehicleState& vehicle);
  void on_plan(int mav, const Plan& plan);
  void on_status(int mav, const DaemonStatus& status);
  void on_sources(const SourceReport& report);
  void on_map(const MapTile& tile);
  void on_clearance(const ClearanceTile& tile);
  void on_patches(const PatchReport& report);
  void on_coordinator(const CoordinatorState& state);
  void on_truth(const Truth& truth);
  /// A message that did not decode; mav < 0: of no drone's channel.
  void on_refused(int mav, const std::string& channel);
  /// A message on a channel that the report does not read.
  void on_other(const std::string& channel) { ++record_.others[channel]; }

  [[nodiscard]] MissionRecord finish() &&;

 private:
  /// What is needed of a drone only while recording.
  struct Live {
    SeenBatches batches;
    std::optional<StampedPose> pose;
    std::vector<TrackPoint> batch_track;
  };

  /// Counts a message that tells these times.
  [[nodiscard]] bool in_time(std::initializer_list<Utime> utimes);
  void measure_distances(int mav, const StampedPose& pose);
  [[nodiscard]] MapHistory& map_of(const std::string& nuclide);
  void close_frame(MapHistory& map);

  MissionRecord record_;
  struct NuclideMap {
    std::string nuclide;
    MapHistory history;
  };
  std::vector<NuclideMap> maps_;  ///< in the order in which they came
  std::map<int, Live> live_;
  std::set<std::int64_t> terms_;
  std::optional<Utime> first_utime_;
};

}  // namespace comptonaut
