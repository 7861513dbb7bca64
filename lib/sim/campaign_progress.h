// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace comptonaut {

/// How far a campaign is.
struct CampaignProgress {
  double share = 0.0;             ///< of the simulated time, 0..1
  std::size_t missions_done = 0;  ///< failed ones too
  std::size_t missions = 0;
};

/// A campaign's progress in lines for a log, where nobody watches a terminal: one whenever another tenth of the work is
/// done, so ten at most however long it takes. The last one comes when all missions are done, though some failed.
class ProgressLines {
 public:
  /// A whole line, or nullopt: nothing new.
  [[nodiscard]] std::optional<std::string> at(const CampaignProgress& progress, double elapsed_s);

 private:
  int tenths_ = 0;
};

}  // namespace comptonaut
