// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "report/json_parts.h"

namespace comptonaut {

using nlohmann::json;

/// Of each place [x index, y index, kBq]; what is not known at all is left out.
json clearance_to_json(const MissionRecord& record) {
  if (record.clearance.limit_Bq.empty()) return nullptr;
  json cells = json::array();
  for (const auto& [key, limit_Bq] : record.clearance.limit_Bq) {
    if (limit_Bq < 0.99 * kNothingKnown_Bq) cells.push_back({key.x, key.y, std::round(1e-3 * limit_Bq)});
  }
  return {{"cell_m", record.clearance.cell_m}, {"cells", cells}};
}

json patches_to_json(const MissionRecord& record) {
  if (!record.patches) return nullptr;
  json list = json::array();
  for (const PatchEstimate& patch : record.patches->patches) {
    list.push_back({{"x_m", rounded(patch.p_W.x(), 2)},
                    {"y_m", rounded(patch.p_W.y(), 2)},
                    {"radius_m", rounded(std::sqrt(patch.area_m2 / std::numbers::pi), 2)},
                    {"activity_Bq", std::round(patch.activity_Bq)}});
  }
  return list;
}

}  // namespace comptonaut
