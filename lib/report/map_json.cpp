// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <string>

#include "report/json_parts.h"
#include "report/map_text.h"

namespace comptonaut {
namespace {

using nlohmann::json;

/// Frames may take so much of the page; beyond, only each k-th is kept, and always the last.
constexpr std::size_t kFramesBudget_bytes = 4'000'000;

/// Three decades up to the largest lambda of the last frame, which is the sharpest, or the largest source of the last
/// report: where the estimator keeps its sources out of the map, what is left of it stays pale beside them.
LevelScale scale_of(const MissionRecord& record, const MapRecord& map) {
  std::uint8_t top = 1;
  for (const std::uint8_t level : map.frames.back().lambda_level) {
    if (level != kNoCell) top = std::max(top, level);
  }
  if (!record.reports.empty()) {
    for (const SourceEstimate& source : record.reports.back().sources) {
      top = std::max(top, lambda_level(source.activity_Bq));
    }
  }
  return {.top = top, .levels = std::min<int>(top, 3 * kLevelsPerDecade)};
}

json frame_to_json(const MissionRecord& record, const MapGrid& grid, const MapFrame& frame, const LevelScale& scale) {
  return {{"t_s", rounded(record.t_s(frame.utime), 2)},
          {"lambda", lambda_text(regrid(frame.lambda_level, frame.grid, grid, kNoCell), scale)},
          {"searched", run_lengths(regrid(frame.searched, frame.grid, grid, false))}};
}

json every_kth_frame(const MissionRecord& record, const MapRecord& map, const LevelScale& scale) {
  const std::vector<MapFrame>& frames = map.frames;
  for (std::size_t k = 1;; k *= 2) {
    json kept = json::array();
    std::size_t bytes = 0;
    for (std::size_t i = (frames.size() - 1) % k; i < frames.size() && bytes <= kFramesBudget_bytes; i += k) {
      kept.push_back(frame_to_json(record, map.grid, frames[i], scale));
      bytes += kept.back()["lambda"].get_ref<const std::string&>().size();
      bytes += kept.back()["searched"].get_ref<const std::string&>().size();
    }
    if (bytes <= kFramesBudget_bytes || k >= frames.size()) return kept;
  }
}

}  // namespace

json map_to_json(const MissionRecord& record, const MapRecord& map) {
  if (map.frames.empty() || map.grid.size() == 0) return nullptr;
  static_assert(std::endian::native == std::endian::little, "the page reads little-endian floats");
  const LevelScale scale = scale_of(record, map);
  return {{"nuclide", map.nuclide},
          {"cell_m", map.grid.cell_m},
          {"origin", {map.grid.x0, map.grid.y0}},
          {"size", {map.grid.nx, map.grid.ny}},
          {"top_Bq", level_lambda_Bq(scale.top)},
          {"bottom_Bq", level_lambda_Bq(scale.top - scale.levels)},
          {"letters", kLetters},
          {"recorded", map.frames.size()},
          {"frames", every_kth_frame(record, map, scale)},
          {"lambda_Bq", base64(map.lambda_Bq)},
          {"sensitivity_s", base64(map.sensitivity_s)}};
}

}  // namespace comptonaut
