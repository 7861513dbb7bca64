// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/cells.h"
#include "core/time.h"
#include "nodes/map_tile.h"
#include "nodes/status.h"
#include "nodes/truth.h"
#include "nodes/vehicle_state.h"
#include "radiation/source_estimate.h"
#include "report/map_history.h"

namespace comptonaut {

struct TrackPoint {
  Utime utime = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
};

/// Events of one drone within one second of data time.
struct EventSums {
  std::int64_t live_us = 0;
  std::int64_t singles = 0;
  std::int64_t pairs = 0;
  std::int64_t others = 0;
};

/// A plan that was not simply the rest of the plan before it.
struct PlanRecord {
  Utime utime = 0;
  std::string status;
  std::vector<Eigen::Vector3d> waypoints;  ///< p_W, m
};

/// How good a drone's poses were, by its own word and, where simulated, by the truth. NaN and -1: not told.
struct PoseRecord {
  std::int64_t poses = 0;
  std::int64_t qualities = 0;
  double sigma_sum_m = 0.0;  ///< over messages that tell a horizontal sigma
  std::int64_t sigmas = 0;
  std::int32_t worst_percent = -1;
  std::int32_t resets = 0;
  double error_sum_m2 = 0.0;  ///< squared distance from the true position, over `errors` moments
  std::int64_t errors = 0;
};

/// The nearest that another drone came.
struct NearestDrone {
  double distance_m = std::numeric_limits<double>::infinity();
  int mav = 0;
  Utime utime = 0;
};

struct DroneRecord {
  std::vector<TrackPoint> track;  ///< at each half metre; of the poses, or of the batches where no pose was recorded
  double distance_m = 0.0;        ///< flown, along the track
  std::map<Utime, EventSums> seconds;  ///< by the start of the second
  EventSums total;
  std::int64_t batches = 0;
  std::int64_t batches_missing = 0;
  std::int64_t batches_repeated = 0;
  std::int64_t refused = 0;  ///< messages of this drone that did not decode
  std::vector<PlanRecord> plans;
  PoseRecord pose;
  std::optional<VehicleState> vehicle;  ///< the last
  NearestDrone nearest;
};

/// The last word of one daemon; its counters may come in several messages.
struct DaemonRecord {
  std::string version;
  std::string state;
  std::map<std::string, std::int64_t> counters;
  std::int64_t messages = 0;
};

/// How clear the ground is: of each place what the newest tile says.
struct ClearanceRecord {
  std::string nuclide;
  double cell_m = 0.0;
  std::map<VoxelKey, double> limit_Bq;
};

/// What a recording of the ground bus says about a mission.
struct MissionRecord {
  Utime start_utime = 0;
  Utime end_utime = 0;
  std::optional<Truth> truth;                   ///< the last; nothing in a real flight
  std::vector<SourceReport> reports;            ///< one per tick, by time
  std::map<int, DroneRecord> drones;            ///< by MAV number
  std::map<std::string, DaemonRecord> daemons;  ///< by "MAVn daemon"
  MapRecord map;                                ///< of the nuclide that comes first
  std::vector<MapRecord> more_maps;             ///< one per other nuclide
  ClearanceRecord clearance;
  std::optional<PatchReport> patches;           ///< the last
  std::vector<Area> buildings;                  ///< of the terrain, which no recording holds; they do not overlap
  std::optional<CoordinatorState> coordinator;  ///< the last
  int leaders = 0;                              ///< terms seen
  std::map<std::string, std::int64_t> refused;  ///< messages that did not decode, by channel
  std::int64_t out_of_time = 0;                 ///< messages more than a day from the others, left out
  std::map<std::string, std::int64_t> others;   ///< messages that the report does not read, by channel
  std::int64_t messages = 0;                    ///< that told something
  std::string damage;                           ///< why the recording could not be read to its end; empty: it was

  [[nodiscard]] double t_s(Utime utime) const { return seconds(utime - start_utime); }
  [[nodiscard]] double duration_s() const { return t_s(end_utime); }
};

}  // namespace comptonaut
