// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <variant>

namespace comptonaut {

/// The MAVLink messages in use, field for field as in common.xml of the MAVLink 2 specification
/// (https://mavlink.io/en/messages/common.html). Frames are the autopilot's: local north-east-down (NED) and body
/// forward-right-down (FRD).

/// HEARTBEAT (0): sign of life.
struct Heartbeat {
  std::uint8_t type = 0;           ///< MAV_TYPE
  std::uint8_t autopilot = 0;      ///< MAV_AUTOPILOT
  std::uint8_t base_mode = 0;      ///< MAV_MODE_FLAG bits
  std::uint32_t custom_mode = 0;   ///< the autopilot's own
  std::uint8_t system_status = 0;  ///< MAV_STATE
  std::uint8_t mavlink_version = 3;

  bool operator==(const Heartbeat&) const = default;
};

inline constexpr std::uint8_t kTypeQuadrotor = 2;
inline constexpr std::uint8_t kTypeOnboardController = 18;
inline constexpr std::uint8_t kAutopilotInvalid = 8;
inline constexpr std::uint8_t kAutopilotPx4 = 12;
inline constexpr std::uint8_t kBaseModeCustom = 1;
inline constexpr std::uint8_t kBaseModeArmed = 128;
inline constexpr std::uint8_t kStateActive = 4;

/// SYS_STATUS (1): health of the vehicle. Of it the battery is used here.
struct SysStatus {
  std::uint32_t sensors_present = 0, sensors_enabled = 0, sensors_health = 0;  ///< MAV_SYS_STATUS_SENSOR bits
  std::uint16_t load = 0;                                                      ///< 0.1 % of the main loop's time
  std::uint16_t voltage_battery_mV = 0xFFFF;                                   ///< 0xFFFF: not known
  std::int16_t current_battery_cA = -1;                                        ///< -1: not known
  std::uint16_t drop_rate_comm = 0, errors_comm = 0;
  std::array<std::uint16_t, 4> errors_count{};
  std::int8_t battery_remaining_percent = -1;  ///< -1: not known

  bool operator==(const SysStatus&) const = default;
};

/// ODOMETRY (331): pose and velocity. Covariances are the upper right triangles of 6 x 6 matrices, row by row (states
/// x, y, z, roll, pitch, yaw); NaN in the first entry: unknown.
struct Odometry {
  std::uint64_t time_usec = 0;              ///< here always us since the Unix epoch
  std::uint8_t frame_id = 1;                ///< of the pose: kFrameLocalNed
  std::uint8_t child_frame_id = 12;         ///< of velocity and rates: kFrameBodyFrd
  std::array<float, 3> position_m{};        ///< x, y, z
  std::array<float, 4> q{1, 0, 0, 0};       ///< w, x, y, z: rotates body to local
  std::array<float, 3> velocity_m_s{};      ///< in the child frame
  std::array<float, 3> rates_rad_s{};       ///< roll, pitch, yaw speed
  std::array<float, 21> pose_covariance{};  ///< m^2, rad^2
  std::array<float, 21> velocity_covariance{};
  std::uint8_t reset_counter = 0;  ///< counts jumps of the estimator
  std::uint8_t estimator_type = 0;
  std::int8_t quality = 0;  ///< 1..100 percent; 0: unknown; -1: the odometry has failed

  bool operator==(const Odometry&) const = default;
};

inline constexpr std::uint8_t kFrameLocalNed = 1;
inline constexpr std::uint8_t kFrameBodyFrd = 12;

/// SET_POSITION_TARGET_LOCAL_NED (84): where the vehicle should be, and how it should move there.
struct SetPositionTarget {
  std::uint32_t time_boot_ms = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t coordinate_frame = kFrameLocalNed;
  std::uint16_t type_mask = 0;  ///< a bit per field that is to be ignored
  std::array<float, 3> position_m{};
  std::array<float, 3> velocity_m_s{};
  std::array<float, 3> acceleration_m_s2{};
  float yaw_rad = 0;  ///< from north towards east
  float yaw_rate_rad_s = 0;

  bool operator==(const SetPositionTarget&) const = default;
};

inline constexpr std::uint16_t kIgnorePosition = 0b111;
inline constexpr std::uint16_t kIgnoreVelocity = 0b111 << 3;
inline constexpr std::uint16_t kIgnoreAcceleration = 0b111 << 6;
inline constexpr std::uint16_t kIgnoreYaw = 1 << 10;
inline constexpr std::uint16_t kIgnoreYawRate = 1 << 11;

using MavlinkMessage = std::variant<Heartbeat, SysStatus, Odometry, SetPositionTarget>;

}  // namespace comptonaut
