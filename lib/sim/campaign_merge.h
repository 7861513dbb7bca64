// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/campaign.h"

namespace comptonaut {

/// A shard's runs, each number as it is, for merge_shards. The first line says of which campaign, the last one whether
/// all runs are there.
[[nodiscard]] std::string shard_text(const CampaignFacts& facts, Shard shard, const CampaignResult& result);

struct ShardText {
  std::string name;  ///< the file
  std::string text;
};

struct MergedCampaign {
  CampaignFacts facts;
  std::vector<CampaignPart> parts;
};

/// The campaign as it would have been flown in one go, from the files of its shards in any order.
/// Throws std::runtime_error that names the file: not a shard's runs, of another campaign, cut off or changed, runs
/// missing, there twice; or that says which shards are missing.
[[nodiscard]] MergedCampaign merge_shards(std::span<const ShardText> shards);

}  // namespace comptonaut
