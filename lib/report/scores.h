// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiation/metrics.h"
#include "report/mission_record.h"

namespace comptonaut {

/// How the reports compare with the truth. Empty where there is none.
struct MissionScores {
  std::vector<Localisation> ticks;  ///< one per report
  /// From when on, until the end, all sources are found within 2 m and none is false. nullopt: never.
  std::optional<double> success_s;
};

[[nodiscard]] MissionScores score(const MissionRecord& record);

/// The sources of a report that the page shows: those compared with the truth where there is one, else all.
[[nodiscard]] std::vector<PointSource> shown_estimates(const MissionRecord& record, const SourceReport& report);

/// The result in one sentence: "5 of 5 sources found within 2 m, 0 false, after 182 s".
[[nodiscard]] std::string headline(const MissionRecord& record, const MissionScores& scores);

/// What a reader should know about the recording before believing the rest: parts that are missing, messages that were
/// refused or left out. One sentence each.
[[nodiscard]] std::vector<std::string> remarks(const MissionRecord& record);

/// "1.83 GBq": three significant digits and a prefix from Bq to GBq.
[[nodiscard]] std::string activity_text(double activity_Bq);

}  // namespace comptonaut
