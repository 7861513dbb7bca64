// SPDX-License-Identifier: BSD-3-Clause
// What the coordinator says of the ground beside sources and map: where it is clear, where activity is spread.
#include <comptonaut/msg/clearance_map_t.hpp>
#include <comptonaut/msg/patches_t.hpp>

#include "bus/codec.h"
#include "bus/codec_keys.h"
#include "bus/codec_tiles.h"
#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

constexpr std::string_view kClearanceLayout = "88s88 44 444 n*1*1*1*4";
constexpr std::string_view kPatchesLayout = "88 n*{s 888 884}";
constexpr double kMaxArea_m2 = 1e12;
constexpr double kMaxGain = 1e30;

bool valid(const ClearanceTile& tile) {
  for (const ClearanceCell& cell : tile.cells) {
    if (!within(cell.limit_Bq, 0.0, kMaxActivity_Bq)) return false;
  }
  return valid_tile(tile) && within(tile.chance, 0.0, 1.0);
}

msg::patch_t patch_to_msg(const PatchEstimate& patch) {
  msg::patch_t m;
  m.nuclide = clean_text(patch.nuclide);
  pack_vector(patch.p_W, m.p_W_m);
  m.area_m2 = patch.area_m2;
  m.activity_Bq = patch.activity_Bq;
  m.gain = static_cast<float>(patch.gain);
  return m;
}

std::optional<PatchEstimate> patch_from_msg(const msg::patch_t& m) {
  PatchEstimate patch{.nuclide = m.nuclide,
                      .p_W = unpack_vector(m.p_W_m),
                      .area_m2 = m.area_m2,
                      .activity_Bq = m.activity_Bq,
                      .gain = m.gain};
  const bool ok = valid_text(patch.nuclide) && valid_vector(patch.p_W) && within(patch.area_m2, 0.0, kMaxArea_m2) &&
                  within(patch.activity_Bq, 0.0, kMaxActivity_Bq) && within(patch.gain, -kMaxGain, kMaxGain);
  return ok ? std::optional(std::move(patch)) : std::nullopt;
}

}  // namespace

Bytes encode(const ClearanceTile& tile) {
  auto m = tile_to_msg<msg::clearance_map_t>(tile);
  m.chance = tile.chance;
  for (const ClearanceCell& cell : tile.cells) m.limit_Bq.push_back(static_cast<float>(cell.limit_Bq));
  return pack(m);
}

template <>
std::optional<ClearanceTile> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::clearance_map_t>(bytes, kClearanceLayout);
  auto tile = m ? tile_from_msg<ClearanceTile>(*m) : std::nullopt;
  if (!tile) return {};
  tile->chance = m->chance;
  for (std::size_t i = 0; i < tile->cells.size(); ++i) tile->cells[i].limit_Bq = m->limit_Bq[i];
  return valid(*tile) ? tile : std::nullopt;
}

Bytes encode(const PatchReport& report) {
  msg::patches_t m;
  m.mission = report.mission;
  m.utime = report.utime;
  pack_all(report.patches, m.n, m.patches, patch_to_msg);
  return pack(m);
}

template <>
std::optional<PatchReport> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::patches_t>(bytes, kPatchesLayout);
  if (!m) return {};
  PatchReport report{.mission = m->mission, .utime = m->utime, .patches = {}};
  const bool ok =
      report.mission >= 0 && valid_utime(report.utime) && unpack_all(m->patches, report.patches, patch_from_msg);
  return ok ? std::optional(report) : std::nullopt;
}

}  // namespace comptonaut
