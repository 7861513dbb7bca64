// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/campaign_part.h"
#include "sim/campaign_progress.h"
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

/// One team as it is configured, and what it is called in tables.
struct CampaignTeam {
  CampaignNames names;
  MissionSetup setup;
};

/// What all runs of a campaign have in common; the same for all of its shards.
struct CampaignFacts {
  std::string line;  ///< for people: all that is flown, and the setup's fingerprint
  SeedRange seeds;
  std::string scenario;
  Area area;
  double horizon_s = 0.0;
  int mavs = 0;
  std::vector<Area> buildings;  ///< and whatever else stands in the area: footprint
};

[[nodiscard]] CampaignFacts facts_of(std::span<const CampaignTeam> teams, SeedRange seeds);

/// Every `of`-th run of a campaign, from the `index`-th on (counted from 1): what one machine of several flies. Runs
/// are counted team by team, each in the order of the seeds.
struct Shard {
  std::size_t index = 1;
  std::size_t of = 1;

  [[nodiscard]] bool holds(std::size_t run) const { return run % of == index - 1; }
};

/// "2/5". Throws std::invalid_argument that says what is wrong.
[[nodiscard]] Shard parse_shard(const std::string& text);

struct CampaignResult {
  std::vector<CampaignPart> parts;   ///< one per team, in order; missions in the order of the seeds
  std::vector<std::string> missing;  ///< the shard's runs that did not come to their end, each with the reason
};

/// Flies one mission per team and seed of the shard, on `jobs` threads. What comes out does not depend on jobs.
/// `progress` is told some times a second and at the end, on the calling thread; if it says false, all missions in the
/// air are given up. A mission that fails is missing; the others go on.
[[nodiscard]] CampaignResult run_campaign(std::span<const CampaignTeam> teams, SeedRange seeds, Shard shard, int jobs,
                                          const std::function<bool(const CampaignProgress&)>& progress);

}  // namespace comptonaut
