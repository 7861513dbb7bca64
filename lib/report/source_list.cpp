// SPDX-License-Identifier: BSD-3-Clause
#include "report/source_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "report/scores.h"

namespace comptonaut {
namespace {

std::string text_of(const PointSource& source) {
  return fmt::format("({:6.2f}, {:6.2f}) m  {:>8}", source.p_W.x(), source.p_W.y(), activity_text(source.activity_Bq));
}

std::string compared_list(const Truth& truth, const std::vector<PointSource>& estimates, const Localisation& score) {
  std::string list = fmt::format("{:<30}  {:<30}  off by\n", "true source", "found");
  for (std::size_t i = 0; i < truth.sources.size(); ++i) {
    const PointSource source{truth.sources[i].p_W, truth.sources[i].activity_Bq};
    const int found = score.found_by[i];
    if (found < 0) {
      list += fmt::format("{}  not found\n", text_of(source));
      continue;
    }
    const PointSource& estimate = estimates[static_cast<std::size_t>(found)];
    list += fmt::format("{}  {}  {:.2f} m\n", text_of(source), text_of(estimate),
                        (estimate.p_W - source.p_W).head<2>().norm());
  }
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    const bool found =
        std::find(score.found_by.begin(), score.found_by.end(), static_cast<int>(k)) != score.found_by.end();
    if (!found) list += fmt::format("{:<30}  {}  false\n", "", text_of(estimates[k]));
  }
  return list;
}

}  // namespace

std::string source_list(const MissionRecord& record) {
  if (record.reports.empty()) return "";
  const std::vector<PointSource> estimates = shown_estimates(record, record.reports.back());
  if (record.truth) return compared_list(*record.truth, estimates, score(record).ticks.back());
  std::string list = "reported source\n";
  for (const PointSource& estimate : estimates) list += text_of(estimate) + "\n";
  return list;
}

}  // namespace comptonaut
