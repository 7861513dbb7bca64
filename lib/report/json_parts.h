// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/mission_record.h"

namespace comptonaut {

/// Parts of the page's data. Private to lib/report.
[[nodiscard]] nlohmann::json drones_to_json(const MissionRecord& record);
[[nodiscard]] nlohmann::json daemons_to_json(const MissionRecord& record);
[[nodiscard]] nlohmann::json map_to_json(const MissionRecord& record);
/// null where the recording does not tell.
[[nodiscard]] nlohmann::json clearance_to_json(const MissionRecord& record);
[[nodiscard]] nlohmann::json patches_to_json(const MissionRecord& record);

/// To so many digits after the point; fewer bytes in the page.
[[nodiscard]] inline double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

}  // namespace comptonaut
