// SPDX-License-Identifier: BSD-3-Clause
#include "report/page.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "report/json_parts.h"
#include "report/mission_json.h"
#include "report/page_text.h"

namespace comptonaut {

std::string page_html(const MissionRecord& record) { return with_data(kPageText, mission_to_json(record)); }

void write_page(const MissionRecord& record, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << page_html(record);
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace comptonaut
