// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "report/mission_record.h"

namespace comptonaut {

/// The mission as one self-contained HTML page: no network, no other file.
[[nodiscard]] std::string page_html(const MissionRecord& record);

/// Writes the page. Throws std::runtime_error that names the file where it cannot be written.
void write_page(const MissionRecord& record, const std::filesystem::path& file);

}  // namespace comptonaut
