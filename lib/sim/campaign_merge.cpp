// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/hash.h"
#include "sim/campaign_members.h"
#include "sim/number_text.h"

namespace comptonaut {
namespace {

constexpr std::string_view kMark = "# runs of shard ";
constexpr std::string_view kWhole = "# end of shard, whole, ";
constexpr std::string_view kPartial = "# end of shard, runs are missing, ";

/// A shard's file as it was read.
struct Piece {
  const ShardText* file = nullptr;
  Shard shard;
  CampaignFacts facts;
  std::vector<CampaignPart> parts;
};

std::runtime_error refused(const ShardText& file, const std::string& why) {
  return std::runtime_error(fmt::format("--merge: {}: {}", file.name, why));
}

/// The last line, of what stands before it.
std::string end_line(std::string_view begin, std::string_view before) {
  Fnv1a check;
  check.add(before);
  return fmt::format("{}{:016x}\n", begin, check.value());
}

/// What stands between the first and the last line.
std::string_view body(const ShardText& file) {
  const std::string_view text = file.text;
  if (!text.starts_with(kMark)) throw refused(file, "is no file of --runs");
  const std::size_t last = std::min(text.rfind("\n#"), text.size() - 1) + 1;
  const std::string_view before = text.substr(0, last), end = text.substr(last);
  if (end == end_line(kPartial, before)) throw refused(file, "runs are missing, this shard must be flown again");
  if (end != end_line(kWhole, before)) throw refused(file, "is cut off, or has been changed");
  return before.substr(before.find('\n') + 1);
}

Piece read(const ShardText& file) {
  NumberReader reader(body(file));
  Piece piece{.file = &file, .shard = {}, .facts = {}, .parts = {}};
  try {
    piece.shard = parse_shard(file.text.substr(kMark.size(), file.text.find('\n') - kMark.size()));
    reader.get(piece.facts);
    reader.get(piece.parts);
  } catch (const std::invalid_argument&) {
    throw refused(file, "is of another version of this program");
  }
  if (!reader.done()) throw refused(file, "is of another version of this program");
  return piece;
}

/// Throws unless they are all shards of one campaign, each one once.
void require_whole(std::span<const Piece> pieces) {
  const Piece& first = pieces.front();
  std::vector<const Piece*> found(first.shard.of, nullptr);
  for (const Piece& piece : pieces) {
    if (piece.shard.of != first.shard.of || piece.facts.line != first.facts.line) {
      throw refused(*piece.file, fmt::format("is shard {}/{} of another campaign ({}) than {}, {}/{} ({})",
                                             piece.shard.index, piece.shard.of, piece.facts.line, first.file->name,
                                             first.shard.index, first.shard.of, first.facts.line));
    }
    const Piece*& place = found[piece.shard.index - 1];
    if (place != nullptr) {
      throw refused(*piece.file, fmt::format("is shard {}, as {} is", piece.shard.index, place->file->name));
    }
    place = &piece;
  }
  std::string missing;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] == nullptr) missing += fmt::format(" {}/{}", i + 1, found.size());
  }
  if (!missing.empty()) throw std::runtime_error("--merge: missing shards:" + missing);
}

}  // namespace

std::string shard_text(const CampaignFacts& facts, Shard shard, const CampaignResult& result) {
  NumberWriter writer;
  writer.put(facts);
  writer.put(result.parts);
  const std::string text = fmt::format("{}{}/{}\n{}", kMark, shard.index, shard.of, writer.take());
  return text + end_line(result.missing.empty() ? kWhole : kPartial, text);
}

MergedCampaign merge_shards(std::span<const ShardText> shards) {
  std::vector<Piece> pieces;
  for (const ShardText& file : shards) pieces.push_back(read(file));
  require_whole(pieces);
  MergedCampaign merged{.facts = pieces.front().facts, .parts = std::move(pieces.front().parts)};
  for (Piece& piece : std::span(pieces).subspan(1)) {
    for (std::size_t i = 0; i < merged.parts.size(); ++i) {
      std::ranges::move(piece.parts[i].missions, std::back_inserter(merged.parts[i].missions));
    }
  }
  for (CampaignPart& part : merged.parts) std::ranges::sort(part.missions, {}, &MissionResult::seed);
  return merged;
}

}  // namespace comptonaut
