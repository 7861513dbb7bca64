// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/mission_record.h"

namespace comptonaut {

/// The record as the page's script reads it (lib/report/page.js): times in s from the start of the mission, rounded to
/// what a screen can show; numbers that are not finite are null. Bytes that are not UTF-8 are replaced. Holds no "<",
/// so that it can stand inside a script element.
[[nodiscard]] std::string mission_to_json(const MissionRecord& record);

}  // namespace comptonaut
