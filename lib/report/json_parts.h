// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "report/mission_record.h"

namespace comptonaut {

/// Parts of the page's data. Private to lib/report.
[[nodiscard]] nlohmann::json drones_to_json(const MissionRecord& record);
[[nodiscard]] nlohmann::json daemons_to_json(const MissionRecord& record);
[[nodiscard]] nlohmann::json map_to_json(const MissionRecord& record, const MapRecord& map);
/// null where the recording does not tell.
[[nodiscard]] nlohmann::json clearance_to_json(const MissionRecord& record);
[[nodiscard]] nlohmann::json patches_to_json(const MissionRecord& record);

/// [x_min, x_max, y_min, y_max], m.
[[nodiscard]] nlohmann::json area_to_json(const Area& area);
[[nodiscard]] nlohmann::json areas_to_json(const std::vector<Area>& areas);

/// As text that can stand inside a script element: no "<"; bytes that are not UTF-8 are replaced; numbers that are not
/// finite are null.
[[nodiscard]] std::string script_text(const nlohmann::json& data);

/// A page of page_text.h with its data.
[[nodiscard]] std::string with_data(std::string page, const std::string& data);

/// To so many digits after the point; fewer bytes in the page.
[[nodiscard]] inline double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

}  // namespace comptonaut
