// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mission_watch.h"

#include <fmt/format.h>

#include <algorithm>

#include "nodes/compare_with_truth.h"

namespace comptonaut {

void MissionWatch::see(Utime utime) {
  start_ = std::min(start_.value_or(utime), utime);
  now_ = std::max(now_, utime);
}

void MissionWatch::on_measurements(const MeasurementBatch& batch) {
  see(batch.utime);
  for (const ChannelCounts& channel : batch.channels) {
    singles_ += channel.singles;
    pairs_ += channel.pairs;
  }
  others_ += batch.others;
}

void MissionWatch::on_sources(const SourceReport& report) {
  see(report.utime);
  report_ = report;
}

void MissionWatch::on_truth(const Truth& truth) { truth_ = truth; }

std::int64_t MissionWatch::elapsed_s() const { return start_ ? (now_ - *start_) / kSecond_us : 0; }

std::string MissionWatch::line() const {
  std::string sources = report_ ? fmt::format("{} reported", report_->sources.size()) : "none yet";
  if (report_ && truth_) {
    const Localisation found = compare_with_truth(*report_, truth_->sources, truth_->area);
    sources = fmt::format("found {} of {}", found.found_2m, truth_->sources.size());
  }
  std::string line =
      fmt::format("{:4} s   coverage {:3.0f} %   sources {}   events {} ({} pairs)", elapsed_s(),
                  report_ ? 100.0 * report_->coverage : 0.0, sources, singles_ + pairs_ + others_, pairs_);
  if (truth_) line += fmt::format("   {:.1f} x real time", truth_->time_scale);
  return line;
}

}  // namespace comptonaut
