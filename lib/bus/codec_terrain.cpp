// SPDX-License-Identifier: BSD-3-Clause
// What range sensors see, and the voxels that are found to be otherwise.
#include <algorithm>
#include <comptonaut/msg/points_t.hpp>
#include <comptonaut/msg/terrain_t.hpp>
#include <iterator>
#include <stdexcept>

#include "bus/codec.h"
#include "bus/codec_keys.h"
#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

constexpr std::string_view kPointsLayout = "8 444 4 n*4*4*4";
constexpr std::string_view kTerrainLayout = "{8488} 88 444 n*1*1*1*1";
constexpr std::int32_t kMaxVoxel = 100'000'000;
constexpr double kMaxSensorRange_m = 10'000.0;

std::int8_t occupancy_to_msg(Occupancy occupancy) {
  return occupancy == Occupancy::kOccupied ? 1 : occupancy == Occupancy::kFree ? 0 : -1;
}

std::optional<Occupancy> occupancy_from_msg(std::int8_t occupancy) {
  if (occupancy < -1 || occupancy > 1) return {};
  return occupancy == 1 ? Occupancy::kOccupied : occupancy == 0 ? Occupancy::kFree : Occupancy::kUnknown;
}

}  // namespace

Bytes encode(const RangePoints& points) {
  msg::points_t m;
  m.utime = points.utime;
  pack_vector(points.p_BR, m.origin_B_m);
  m.range_max_m = static_cast<float>(points.range_max_m);
  m.n = static_cast<std::int32_t>(points.points_B.size());
  for (const Eigen::Vector3f& p_B : points.points_B) {
    m.x_m.push_back(p_B.x());
    m.y_m.push_back(p_B.y());
    m.z_m.push_back(p_B.z());
  }
  return pack(m);
}

template <>
std::optional<RangePoints> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::points_t>(bytes, kPointsLayout);
  if (!m) return {};
  RangePoints points{
      .utime = m->utime, .p_BR = unpack_vector(m->origin_B_m), .range_max_m = m->range_max_m, .points_B = {}};
  const bool valid = valid_utime(points.utime) && valid_vector(points.p_BR) && points.range_max_m > 0.0 &&
                     points.range_max_m <= kMaxSensorRange_m && m->x_m.size() <= kMaxRangePoints;
  if (!valid) return {};
  points.points_B.reserve(m->x_m.size());
  for (std::size_t i = 0; i < m->x_m.size(); ++i) points.points_B.emplace_back(m->x_m[i], m->y_m[i], m->z_m[i]);
  return points;
}

Bytes encode(const TerrainTile& tile) {
  const VoxelKey origin = tile.voxels.empty() ? VoxelKey{} : tile.voxels.front().voxel;
  msg::terrain_t m;
  m.key = to_msg(tile.key);
  m.utime = tile.utime;
  m.voxel_m = tile.voxel_m;
  m.origin[0] = origin.x;
  m.origin[1] = origin.y;
  m.origin[2] = origin.z;
  m.n = static_cast<std::int32_t>(tile.voxels.size());
  for (const auto& [voxel, occupancy] : tile.voxels) {
    if (!fits_tile(voxel, origin)) throw std::invalid_argument("terrain tile with a voxel over 127 from its first one");
    m.dx.push_back(static_cast<std::int8_t>(voxel.x - origin.x));
    m.dy.push_back(static_cast<std::int8_t>(voxel.y - origin.y));
    m.dz.push_back(static_cast<std::int8_t>(voxel.z - origin.z));
    m.occupancy.push_back(occupancy_to_msg(occupancy));
  }
  return pack(m);
}

template <>
std::optional<TerrainTile> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::terrain_t>(bytes, kTerrainLayout);
  if (!m) return {};
  const auto key = from_msg(m->key);
  TerrainTile tile{.key = key.value_or(BatchKey{}), .utime = m->utime, .voxel_m = m->voxel_m, .voxels = {}};
  const bool in_range = std::all_of(std::begin(m->origin), std::end(m->origin),
                                    [](std::int32_t i) { return i >= -kMaxVoxel && i <= kMaxVoxel; });
  if (!key || !valid_utime(tile.utime) || !within(tile.voxel_m, 0.01, 10.0) || !in_range) return {};
  if (m->dx.size() > kMaxVoxelsPerTile) return {};
  for (std::size_t i = 0; i < m->dx.size(); ++i) {
    const VoxelKey voxel{m->origin[0] + m->dx[i], m->origin[1] + m->dy[i], m->origin[2] + m->dz[i]};
    const auto occupancy = occupancy_from_msg(m->occupancy[i]);
    if (!occupancy || (i > 0 && !fits_tile(voxel, tile.voxels.front().voxel))) return {};
    tile.voxels.push_back({voxel, *occupancy});
  }
  return tile;
}

}  // namespace comptonaut
