// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/mission_record.h"

namespace comptonaut {

/// The answer at the end as a table of text, a line per source. With the truth: each true source with the estimate that
/// found it within 2 m, then the estimates that found none. Without: what is reported.
[[nodiscard]] std::string source_list(const MissionRecord& record);

}  // namespace comptonaut
