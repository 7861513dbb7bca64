// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

/// "1:02:03"
std::string clock_text(double time_s) {
  const auto whole_s = static_cast<long long>(std::round(time_s));
  return fmt::format("{}:{:02}:{:02}", whole_s / 3600, whole_s / 60 % 60, whole_s % 60);
}

}  // namespace

std::optional<std::string> ProgressLines::at(const CampaignProgress& progress, double elapsed_s) {
  const bool over = progress.missions_done == progress.missions;
  const int tenths = over ? 10 : std::min(9, static_cast<int>(10.0 * progress.share));
  if (tenths <= tenths_) return std::nullopt;
  tenths_ = tenths;
  const double remaining_s = over ? 0.0 : elapsed_s * (1.0 / progress.share - 1.0);
  return fmt::format("{} of {} missions done, {:.0f} % of the work; {} elapsed, about {} remaining\n",
                     progress.missions_done, progress.missions, 100.0 * progress.share, clock_text(elapsed_s),
                     clock_text(remaining_s));
}

}  // namespace comptonaut
