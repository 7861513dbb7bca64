// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "bus/codec.h"

// One valid message of each type, in which no two fields hold the same number.
namespace comptonaut {

inline const Utime kSampleUtime = 1'700'000'000'000'000;  // a whole second

template <class T>
T sample();

template <>
inline EventBatch sample() {
  const PairEvent pair{.offset_ns = 1'234'567,
                       .channel = 1,
                       .e1_keV = 210.5,
                       .e2_keV = 450.25,
                       .a = {.axis_D = {0.6, 0.0, 0.8}, .cos_beta = 0.7, .probability = 0.4},
                       .b = {.axis_D = {0.0, -0.6, -0.8}, .cos_beta = -0.3, .probability = 0.6}};
  PairEvent half_physical = pair;
  half_physical.channel = 0;
  half_physical.a = {.axis_D = {0.0, 1.0, 0.0}, .cos_beta = 0.25, .probability = 1.0};
  half_physical.b = {};
  return {.key = {.mission = 7, .sender = 3, .boot_epoch = kSampleUtime - 5, .number = 41},
          .utime = kSampleUtime,
          .duration_us = 50'000,
          .live_us = 49'123,
          .utime_sigma_us = 12,
          .others = 9,
          .channels = {{"Cs-137", 100, 2}, {"Co-60", 31, 1}},
          .pairs = {pair, half_physical}};
}

template <>
inline MeasurementBatch sample() {
  const Cone cone{.offset_us = 1'234,
                  .event = 5,
                  .channel = 1,
                  .p_WS = {10.001, -20.002, 2.003},
                  .axis_W = {0.6, 0.0, 0.8},
                  .cos_beta = 0.7,
                  .weight = 0.4};
  return {.key = {.mission = 7, .sender = 3, .boot_epoch = kSampleUtime - 5, .number = 41},
          .utime = kSampleUtime,
          .duration_us = 50'000,
          .live_us = 49'123,
          .utime_sigma_us = 12,
          .p_WD = {10.0, -20.0, 2.0},
          .q_WD = {0.5, 0.1, -0.7, 0.5},
          .v_WD = {4.0, -3.0, 0.5},
          .battery_percent = 76.0,
          .others = 9,
          .channels = {{"Cs-137", 100, 2}, {"Co-60", 31, 1}},
          .cones = {cone, cone}};
}

template <>
inline RangePoints sample() {
  return {.utime = kSampleUtime + 31,
          .p_BR = {0.125, -0.25, 0.5},
          .range_max_m = 20.5,
          .points_B = {{1.5F, 2.5F, -3.5F}, {4.25F, -5.75F, 6.125F}}};
}

template <>
inline TerrainTile sample() {
  return {.key = {.mission = 7, .sender = 3, .boot_epoch = kSampleUtime - 5, .number = 41},
          .utime = kSampleUtime + 50'000,
          .voxel_m = 0.25,
          .voxels = {{{100, -200, 3}, Occupancy::kOccupied},
                     {{227, -327, 4}, Occupancy::kFree},
                     {{101, -199, -5}, Occupancy::kUnknown}}};
}

template <>
inline StampedPose sample() {
  return {.utime = kSampleUtime + 1,
          .p_WB = {1, 2, 3},
          .q_WB = {0.1, 0.7, 0.1, -0.7},
          .v_WB_B = {4, 5, 6},
          .w_WB_B = {7, 8, 9},
          .a_WB_B = {10, 11, 12}};
}

template <>
inline PoseQuality sample() {
  return {.utime = kSampleUtime + 2,
          .position_sigma_m = 0.02,
          .height_sigma_m = 0.03,
          .yaw_sigma_rad = 0.004,
          .quality_percent = 95,
          .resets = 6};
}

template <>
inline VehicleState sample() {
  return {.utime = kSampleUtime + 3,
          .sender = 2,
          .connected = true,
          .armed = false,
          .mode = "offboard",
          .battery_percent = 81.5,
          .p_WHome = {1, 2, 3},
          .fence_m = {{0, 10}, {20, 30}, {40, 50}},
          .fence_floor_m = 0.5,
          .fence_ceiling_m = 30.5,
          .plan_number = 17,
          .waypoint = 4,
          .hold_reason = "no plan for 3 s"};
}

inline Basis sample_basis() {
  return {{.sender = 1, .boot_epoch = 100, .number = 50, .skipped = {3, 3, 7, 9}},
          {.sender = 1, .boot_epoch = 200, .number = -1, .skipped = {}},
          {.sender = 2, .boot_epoch = 50, .number = 60, .skipped = {60, 60}}};
}

template <>
inline Plan sample() {
  return {.mission = 7,
          .utime = kSampleUtime,
          .mav = 2,
          .term = 3,
          .number = 44,
          .basis = sample_basis(),
          .status = "searching",
          .waypoints = {{.p_W = {1, 2, 3}, .speed_max_m_s = 8.0, .utime = 0},
                        {.p_W = {4, 5, 6}, .speed_max_m_s = 7.5, .utime = kSampleUtime + 9}}};
}

template <>
inline SourceReport sample() {
  SourceEstimate known{.nuclide = "Cs-137",
                       .p_W = {1, 2, 3},
                       .activity_Bq = 2e9,
                       .position_sigma_m = {0.1, 0.2, 0.3},
                       .position_cov_xy_m2 = -0.01,
                       .activity_sigma_Bq = 1e7,
                       .significance = 123.5};
  SourceEstimate unknown{.nuclide = "Co-60", .p_W = {4, 5, 6}, .activity_Bq = 1e8};
  return {.mission = 7,
          .utime = kSampleUtime,
          .estimator = "mlem",
          .certificate = -0.5,
          .coverage = 0.25,
          .sources = {known, unknown}};
}

template <>
inline MapTile sample() {
  return {.mission = 7,
          .utime = kSampleUtime,
          .nuclide = "Cs-137",
          .cell_m = 0.5,
          .tile = 3,
          .tiles = 9,
          .cells = {{.key = {100, -200, 4}, .lambda_Bq = 1e6, .sensitivity_s = 1e-8},
                    {.key = {227, -327, 5}, .lambda_Bq = 2e6, .sensitivity_s = 2e-8}}};
}

template <>
inline ClearanceTile sample() {
  return {.mission = 7,
          .utime = kSampleUtime,
          .nuclide = "Cs-137",
          .chance = 0.05,
          .cell_m = 1.5,
          .tile = 3,
          .tiles = 9,
          .cells = {{.key = {100, -200, 4}, .limit_Bq = 1e6}, {.key = {227, -327, 5}, .limit_Bq = 2e6}}};
}

template <>
inline PatchReport sample() {
  return {.mission = 7,
          .utime = kSampleUtime,
          .patches = {
              {.nuclide = "Cs-137", .p_W = {1, 2, 3}, .area_m2 = 78.5, .activity_Bq = 4e9, .gain = -12.5},
              {.nuclide = "Co-60", .p_W = {4, 5, 6}, .area_m2 = 20.5, .activity_Bq = 1e9, .gain = 8.0},
          }};
}

template <>
inline CoordinatorState sample() {
  return {.mission = 7,
          .utime = kSampleUtime,
          .sender = 1,
          .term = 3,
          .lease_us = 2'000'000,
          .terrain_hash = 0xfedcba9876543210,
          .basis = sample_basis(),
          .lambda_hash = 0x123456789abcdef0,
          .cones = 78,
          .viewpoints = 4'000};
}

template <>
inline DaemonStatus sample() {
  return {.utime = kSampleUtime,
          .sender = 2,
          .daemon = "mapper",
          .version = "0.1.0",
          .state = "running",
          .counters = {{"batches", 12}, {"late_us", -5}}};
}

template <>
inline Truth sample() {
  return {.utime = kSampleUtime,
          .start_utime = kSampleUtime - 60,
          .scenario = "werner2024-sim",
          .time_scale = 2.5,
          .area = {.x_min_m = -1, .x_max_m = 50, .y_min_m = -2, .y_max_m = 70},
          .sources = {{.nuclide = "Cs-137", .p_W = {1, 2, 3}, .activity_Bq = 2e9}},
          .mavs = {{.mav = 1, .p_WB = {4, 5, 6}, .yaw_rad = 0.5, .photons = 99}}};
}

}  // namespace comptonaut
