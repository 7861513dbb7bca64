// SPDX-License-Identifier: BSD-3-Clause
#include "report/scores.h"

#include <fmt/format.h>

#include <cmath>

#include "nodes/compare_with_truth.h"

namespace comptonaut {
namespace {

std::string found_text(const MissionRecord& record, const MissionScores& scores) {
  const Localisation& last = scores.ticks.back();
  const std::string found = fmt::format("{} of {} sources found within 2 m, {} false", last.found_2m,
                                        record.truth->sources.size(), last.false_reports);
  if (scores.success_s) return fmt::format("{}, after {:.0f} s", found, *scores.success_s);
  return fmt::format("{}, at the end of {:.0f} s", found, record.duration_s());
}

std::string reported_text(const MissionRecord& record, const SourceReport& last) {
  const std::string after = fmt::format("after {:.0f} s", record.duration_s());
  if (last.sources.empty()) return "No source reported " + after;
  const SourceEstimate& strongest = last.sources.front();
  const std::size_t n = last.sources.size();
  return fmt::format("{} source{} reported {}, the strongest {} at ({:.1f}, {:.1f}) m", n, n == 1 ? "" : "s", after,
                     activity_text(strongest.activity_Bq), strongest.p_W.x(), strongest.p_W.y());
}

std::string list_of(const std::map<std::string, std::int64_t>& counts) {
  std::string list;
  for (const auto& [name, count] : counts) list += fmt::format("{}{} x {}", list.empty() ? "" : ", ", name, count);
  return list;
}

}  // namespace

MissionScores score(const MissionRecord& record) {
  MissionScores scores;
  if (!record.truth) return scores;
  for (const SourceReport& report : record.reports) {
    scores.ticks.push_back(compare_with_truth(report, record.truth->sources, record.truth->area));
    if (!all_found_none_false(scores.ticks.back())) {
      scores.success_s.reset();
    } else if (!scores.success_s) {
      scores.success_s = record.t_s(report.utime);
    }
  }
  return scores;
}

std::vector<PointSource> shown_estimates(const MissionRecord& record, const SourceReport& report) {
  return compared_estimates(report, record.truth ? record.truth->sources.size() : report.sources.size());
}

std::string headline(const MissionRecord& record, const MissionScores& scores) {
  if (record.reports.empty()) return "No estimate was recorded";
  return scores.ticks.empty() ? reported_text(record, record.reports.back()) : found_text(record, scores);
}

std::vector<std::string> remarks(const MissionRecord& record) {
  std::vector<std::string> list;
  if (!record.damage.empty()) list.push_back("Not read to its end: " + record.damage + ".");
  if (record.reports.empty())
    list.push_back("No SOURCES message: there is no estimate to show. They are on the bus of the machine that leads.");
  if (record.map.frames.empty()) list.push_back("No RADIATION_MAP message: there is no map to show.");
  if (record.drones.empty()) list.push_back("No drone's messages: there are no tracks and no events to show.");
  if (!record.refused.empty()) list.push_back("Messages that did not decode: " + list_of(record.refused) + ".");
  if (record.out_of_time > 0) {
    list.push_back(
        fmt::format("{} messages are dated more than a day from the first and left out.", record.out_of_time));
  }
  if (record.map.late_tiles + record.map.cells_left_out > 0) {
    list.push_back(fmt::format("Left out of the map: {} late tiles, {} cells that do not fit it.",
                               record.map.late_tiles, record.map.cells_left_out));
  }
  return list;
}

std::string activity_text(double activity_Bq) {
  const double size_Bq = std::abs(activity_Bq);
  if (!(size_Bq >= 1e3)) return fmt::format("{:.3g} Bq", activity_Bq);
  if (size_Bq < 1e6) return fmt::format("{:.3g} kBq", activity_Bq / 1e3);
  return size_Bq < 1e9 ? fmt::format("{:.3g} MBq", activity_Bq / 1e6) : fmt::format("{:.3g} GBq", activity_Bq / 1e9);
}

}  // namespace comptonaut
