// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "detector/event_batch.h"
#include "flight/plan.h"
#include "nodes/map_tile.h"
#include "nodes/range_points.h"
#include "nodes/status.h"
#include "nodes/terrain_tile.h"
#include "nodes/truth.h"
#include "nodes/vehicle_state.h"
#include "radiation/measurement_batch.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

using Bytes = std::vector<std::uint8_t>;

/// Domain types as LCM messages, the same bytes on the bus, in a log and in a campaign. Texts are cut to 256 bytes and
/// freed of control characters; of a hypothesis with probability 0 nothing else is kept. Throws std::invalid_argument
/// where a tile's cells or voxels lie further apart than it says.
[[nodiscard]] Bytes encode(const EventBatch& batch);
[[nodiscard]] Bytes encode(const MeasurementBatch& batch);
[[nodiscard]] Bytes encode(const RangePoints& points);
[[nodiscard]] Bytes encode(const TerrainTile& tile);
[[nodiscard]] Bytes encode(const StampedPose& pose);
[[nodiscard]] Bytes encode(const PoseQuality& quality);
[[nodiscard]] Bytes encode(const VehicleState& vehicle);
[[nodiscard]] Bytes encode(const Plan& plan);
[[nodiscard]] Bytes encode(const SourceReport& report);
[[nodiscard]] Bytes encode(const MapTile& tile);
[[nodiscard]] Bytes encode(const ClearanceTile& tile);
[[nodiscard]] Bytes encode(const PatchReport& report);
[[nodiscard]] Bytes encode(const CoordinatorState& state);
[[nodiscard]] Bytes encode(const DaemonStatus& status);
[[nodiscard]] Bytes encode(const Truth& truth);

/// The message back as a domain type. nullopt where it is not one: wrong fingerprint, cut short, counts that do not
/// fit its size, a number that is not finite or out of range, a direction or quaternion that is not unit. Trailing
/// bytes are ignored, as LCM decoders do. Never throws on what the bytes hold, never allocates more than they could.
template <class T>
[[nodiscard]] std::optional<T> decode(std::span<const std::uint8_t> bytes) = delete;
template <>
std::optional<EventBatch> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<MeasurementBatch> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<RangePoints> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<TerrainTile> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<StampedPose> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<PoseQuality> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<VehicleState> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<Plan> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<SourceReport> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<MapTile> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<ClearanceTile> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<PatchReport> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<CoordinatorState> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<DaemonStatus> decode(std::span<const std::uint8_t> bytes);
template <>
std::optional<Truth> decode(std::span<const std::uint8_t> bytes);

}  // namespace comptonaut
