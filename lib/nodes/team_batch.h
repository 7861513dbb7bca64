// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "nodes/terrain_tile.h"
#include "radiation/measurement_batch.h"

namespace comptonaut {

/// What mappers number in one sequence, and coordinators fold.
using TeamBatch = std::variant<MeasurementBatch, TerrainTile>;

[[nodiscard]] inline const BatchKey& key_of(const TeamBatch& batch) {
  return std::visit([](const auto& b) -> const BatchKey& { return b.key; }, batch);
}
[[nodiscard]] inline Utime utime_of(const TeamBatch& batch) {
  return std::visit([](const auto& b) { return b.utime; }, batch);
}
[[nodiscard]] inline Utime end_utime_of(const TeamBatch& batch) {
  return std::visit([](const auto& b) { return b.end_utime(); }, batch);
}

}  // namespace comptonaut
