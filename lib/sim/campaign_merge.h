// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "sim/campaign.h"

namespace comptonaut {

/// The first line of a shard's CSV file: which part of which campaign (see campaign_line) follows.
[[nodiscard]] std::string shard_mark(const std::string& campaign, Shard shard);

/// The last line: that the file was written to its end, and whether all of the shard's runs stand in it.
[[nodiscard]] std::string shard_end(bool whole);

struct ShardText {
  std::string name;  ///< the file
  std::string text;
};

/// The CSV that the campaign would have written in one go, byte for byte, from the files of its shards in any order.
/// Throws std::runtime_error that names the file: not a shard, of another campaign, cut off, runs missing, there twice;
/// or that says which shards are missing.
[[nodiscard]] std::string merge_shards(std::span<const ShardText> shards);

}  // namespace comptonaut
