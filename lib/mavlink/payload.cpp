// SPDX-License-Identifier: BSD-3-Clause
#include "mavlink/payload.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>
#include <utility>

namespace comptonaut {
namespace {

template <class Message>
constexpr MavlinkKind kKind{};
template <>
constexpr MavlinkKind kKind<Heartbeat>{.id = 0, .crc_extra = 50};
template <>
constexpr MavlinkKind kKind<SysStatus>{.id = 1, .crc_extra = 124};
template <>
constexpr MavlinkKind kKind<Odometry>{.id = 331, .crc_extra = 91};
template <>
constexpr MavlinkKind kKind<SetPositionTarget>{.id = 84, .crc_extra = 143};

// Each message's fields in the order of the wire, once for both directions: `wire` is a Writer or a Reader.
template <class Wire>
void fields(Wire& wire, Heartbeat& m) {
  wire(m.custom_mode, m.type, m.autopilot, m.base_mode, m.system_status, m.mavlink_version);
}

template <class Wire>
void fields(Wire& wire, SysStatus& m) {
  wire(m.sensors_present, m.sensors_enabled, m.sensors_health, m.load, m.voltage_battery_mV, m.current_battery_cA,
       m.drop_rate_comm, m.errors_comm, m.errors_count, m.battery_remaining_percent);
}

template <class Wire>
void fields(Wire& wire, Odometry& m) {
  wire(m.time_usec, m.position_m, m.q, m.velocity_m_s, m.rates_rad_s, m.pose_covariance, m.velocity_covariance,
       m.frame_id, m.child_frame_id, m.reset_counter, m.estimator_type, m.quality);
}

template <class Wire>
void fields(Wire& wire, SetPositionTarget& m) {
  wire(m.time_boot_ms, m.position_m, m.velocity_m_s, m.acceleration_m_s2, m.yaw_rad, m.yaw_rate_rad_s, m.type_mask,
       m.target_system, m.target_component, m.coordinate_frame);
}

template <class T>
void swap_to_little_endian(std::array<std::uint8_t, sizeof(T)>& bytes) {
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
}

struct Writer {
  std::vector<std::uint8_t> bytes;

  template <class... Fields>
  void operator()(const Fields&... values) {
    (put(values), ...);
  }
  template <class T>
  void put(const T& value) {
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    swap_to_little_endian<T>(raw);
    std::ranges::copy(raw, std::back_inserter(bytes));
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& values) {
    for (const T& value : values) put(value);
  }
};

struct Reader {
  std::span<const std::uint8_t> bytes;

  template <class... Fields>
  void operator()(Fields&... values) {
    (get(values), ...);
  }
  template <class T>
  void get(T& value) {
    std::array<std::uint8_t, sizeof(T)> raw{};
    const std::size_t there = std::min(sizeof(T), bytes.size());
    std::copy_n(bytes.begin(), there, raw.begin());
    bytes = bytes.subspan(there);
    swap_to_little_endian<T>(raw);
    std::memcpy(&value, raw.data(), sizeof(T));
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& values) {
    for (T& value : values) get(value);
  }
};

template <class Message>
Message decode_as(std::span<const std::uint8_t> payload) {
  Message message;
  Reader reader{payload};
  fields(reader, message);
  return message;
}

}  // namespace

MavlinkKind kind_of(const MavlinkMessage& message) {
  return std::visit([]<class Message>(const Message&) { return kKind<Message>; }, message);
}

std::optional<MavlinkKind> kind_with_id(std::uint32_t id) {
  for (const MavlinkKind kind : {kKind<Heartbeat>, kKind<SysStatus>, kKind<Odometry>, kKind<SetPositionTarget>}) {
    if (kind.id == id) return kind;
  }
  return std::nullopt;
}

std::vector<std::uint8_t> encode_payload(const MavlinkMessage& message) {
  Writer writer;
  std::visit([&](auto m) { fields(writer, m); }, message);
  while (writer.bytes.size() > 1 && writer.bytes.back() == 0) writer.bytes.pop_back();
  return std::move(writer.bytes);
}

std::optional<MavlinkMessage> decode_payload(std::uint32_t id, std::span<const std::uint8_t> payload) {
  switch (id) {
    case kKind<Heartbeat>.id:
      return decode_as<Heartbeat>(payload);
    case kKind<SysStatus>.id:
      return decode_as<SysStatus>(payload);
    case kKind<Odometry>.id:
      return decode_as<Odometry>(payload);
    case kKind<SetPositionTarget>.id:
      return decode_as<SetPositionTarget>(payload);
    default:
      return std::nullopt;
  }
}

}  // namespace comptonaut
