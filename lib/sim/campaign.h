// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/mission.h"

namespace comptonaut {

/// Seeds of a campaign, both ends included.
struct SeedRange {
  std::uint64_t first = 1;
  std::uint64_t last = 1;

  [[nodiscard]] std::size_t size() const { return last - first + 1; }
};

/// "3:7", or "3" for one seed. Throws std::invalid_argument that says what is wrong: not that, the end before the
/// beginning, more than a million seeds.
[[nodiscard]] SeedRange parse_seeds(const std::string& text);

/// Flies one mission per seed on `jobs` threads. The results stand in the order of the seeds and do not depend on
/// jobs. `progress` gets the share done in 0..1, some times a second, on the calling thread.
/// Throws what the first failing mission throws.
[[nodiscard]] std::vector<MissionResult> run_campaign(const MissionSetup& setup, SeedRange seeds, int jobs,
                                                      const std::function<void(double)>& progress);

}  // namespace comptonaut
