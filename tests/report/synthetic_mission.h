// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "bus/codec.h"
#include "report/mission_recorder.h"

namespace comptonaut {

/// A message of the ground bus before it is encoded.
struct Sent {
  std::string channel;
  int mav = 0;
  std::variant<MeasurementBatch, StampedPose, PoseQuality, VehicleState, Plan, DaemonStatus, SourceReport, MapTile,
               CoordinatorState, Truth>
      message;
};

struct SyntheticConfig {
  std::uint64_t seed = 1;
  int duration_s = 30;
  int drones = 3;
  double edge_m = 50.0;  ///< of the square area
  double cell_m = 0.5;
  bool with_truth = true;
  std::string estimator = "mlem";
};

inline constexpr Utime kSyntheticStart = 1'700'000'000'000'000;

/// What a mission looks like on the ground bus, without physics: drones zigzag over the area, each source's bump in the
/// map grows sharp and its estimate near with time, events come by the inverse square of the distance.
[[nodiscard]] std::vector<Sent> synthetic_mission(const SyntheticConfig& config);

/// As the recorder sees it when nothing is lost.
[[nodiscard]] MissionRecord record_of(const std::vector<Sent>& sent);

/// As lcm-logger writes it.
void write_log(const std::vector<Sent>& sent, const std::filesystem::path& file);

}  // namespace comptonaut
