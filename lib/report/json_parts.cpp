// SPDX-License-Identifier: BSD-3-Clause
#include "report/json_parts.h"

namespace comptonaut {

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
