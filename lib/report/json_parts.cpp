// SPDX-License-Identifier: BSD-3-Clause
#include "report/json_parts.h"

namespace comptonaut {

nlohmann::json area_to_json(const Area& area) {
  return {rounded(area.x_min_m, 2), rounded(area.x_max_m, 2), rounded(area.y_min_m, 2), rounded(area.y_max_m, 2)};
}

nlohmann::json areas_to_json(const std::vector<Area>& areas) {
  nlohmann::json list = nlohmann::json::array();
  for (const Area& area : areas) list.push_back(area_to_json(area));
  return list;
}

std::string script_text(const nlohmann::json& data) {
  std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string with_data(std::string page, const std::string& data) {
  const std::string mark = "{{data}}";
  return page.replace(page.find(mark), mark.size(), data);
}

}  // namespace comptonaut
