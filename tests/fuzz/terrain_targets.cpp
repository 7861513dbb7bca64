// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "bus/codec.h"
#include "fuzz/targets.h"

namespace comptonaut {
namespace {

/// What was understood can be sent on.
template <class T>
std::optional<T> check_message(std::span<const char> bytes) {
  auto message = decode<T>({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  if (message) require_law(decode<T>(encode(*message)).has_value(), "what was decoded can be sent on");
  return message;
}

}  // namespace

void fuzz_points(std::span<const char> bytes) {
  const auto points = check_message<RangePoints>(bytes);
  if (points) require_law(points->points_B.size() <= kMaxRangePoints, "no scan is larger than a scan");
}

void fuzz_terrain(std::span<const char> bytes) {
  const auto tile = check_message<TerrainTile>(bytes);
  if (!tile) return;
  require_law(tile->voxels.size() <= kMaxVoxelsPerTile, "no tile is larger than a tile");
  for (const VoxelChange& change : tile->voxels) {
    require_law(fits_tile(change.voxel, tile->voxels.front().voxel), "all voxels are near the first one");
  }
}

}  // namespace comptonaut
