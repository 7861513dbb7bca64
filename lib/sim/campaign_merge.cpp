// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace comptonaut {
namespace {

constexpr std::string_view kMark = "# shard ";
constexpr std::string_view kOf = " of campaign ";
constexpr std::string_view kWhole = "# end of shard\n";
constexpr std::string_view kPartial = "# end of shard, runs are missing\n";

/// A shard's file, cut into its pieces; views of the text.
struct Pieces {
  const ShardText* file = nullptr;
  Shard shard;
  std::string_view campaign;           ///< what it was flown with
  std::string_view columns;            ///< the table's first line
  std::vector<std::string_view> runs;  ///< the rows of each run
};

std::runtime_error refused(const ShardText& file, const std::string& why) {
  return std::runtime_error(fmt::format("--merge: {}: {}", file.name, why));
}

std::string_view take_line(std::string_view& text) {
  const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(length);
  return line;
}

/// What stands before the time: which run the row belongs to.
std::string_view run_of(std::string_view row, std::size_t fields) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < fields; ++i) end = row.find(',', end) + 1;
  return row.substr(0, end);
}

Pieces cut(const ShardText& file) {
  std::string_view text = file.text;
  const std::size_t of = text.find(kOf);
  if (!text.starts_with(kMark) || of > text.find('\n')) throw refused(file, "is no CSV that --shard wrote");
  if (text.ends_with(kPartial)) throw refused(file, "runs are missing, this shard must be flown again");
  if (!text.ends_with(kWhole)) throw refused(file, "is cut off");
  text.remove_suffix(kWhole.size());
  Pieces pieces{.file = &file, .shard = {}, .campaign = {}, .columns = {}, .runs = {}};
  try {
    pieces.shard = parse_shard(std::string(text.substr(kMark.size(), of - kMark.size())));
  } catch (const std::invalid_argument& wrong) {
    throw refused(file, fmt::format("line 1: {}", wrong.what()));
  }
  pieces.campaign = take_line(text).substr(of + kOf.size());
  if (text.empty()) throw refused(file, "holds no table");
  pieces.columns = take_line(text);
  const std::string_view before_time = pieces.columns.substr(0, pieces.columns.find("t_s,"));
  const auto fields = static_cast<std::size_t>(std::count(before_time.begin(), before_time.end(), ','));
  const char* begin = text.data();
  std::string_view run;
  while (!text.empty()) {
    const std::string_view row = take_line(text);
    if (run_of(row, fields) != run) {
      run = run_of(row, fields);
      begin = row.data();
      pieces.runs.emplace_back();
    }
    pieces.runs.back() = {begin, static_cast<std::size_t>(row.data() + row.size() - begin)};
  }
  return pieces;
}

/// By shard, each one once.
std::vector<Pieces> sorted(std::span<const ShardText> shards) {
  std::vector<Pieces> all;
  for (const ShardText& file : shards) all.push_back(cut(file));
  std::sort(all.begin(), all.end(), [](const Pieces& a, const Pieces& b) { return a.shard.index < b.shard.index; });
  const Pieces& first = all.front();
  for (const Pieces& p : all) {
    if (p.shard.of != first.shard.of || p.campaign != first.campaign || p.columns != first.columns) {
      throw refused(*p.file, fmt::format("is of another campaign than {}", first.file->name));
    }
  }
  std::string missing;
  for (std::size_t i = 1, at = 0; i <= first.shard.of; ++i) {
    const std::size_t begin = at;
    while (at < all.size() && all[at].shard.index == i) ++at;
    if (at == begin) missing += fmt::format(" {}/{}", i, first.shard.of);
    if (at > begin + 1)
      throw refused(*all[begin + 1].file, fmt::format("is shard {}, as {} is", i, all[begin].file->name));
  }
  if (!missing.empty()) throw std::runtime_error("--merge: missing shards:" + missing);
  return all;
}

}  // namespace

std::string shard_mark(const std::string& campaign, Shard shard) {
  return fmt::format("{}{}/{}{}{}\n", kMark, shard.index, shard.of, kOf, campaign);
}

std::string shard_end(bool whole) { return std::string(whole ? kWhole : kPartial); }

std::string merge_shards(std::span<const ShardText> shards) {
  const std::vector<Pieces> all = sorted(shards);
  std::size_t runs = 0;
  for (const Pieces& p : all) runs += p.runs.size();
  std::string text(all.front().columns);
  for (std::size_t run = 0; run < runs; ++run) {
    const Pieces& p = all[run % all.size()];
    if (run / all.size() >= p.runs.size()) throw refused(*p.file, "holds fewer runs than its place asks for");
    text += p.runs[run / all.size()];
  }
  return text;
}

}  // namespace comptonaut
