// SPDX-License-Identifier: BSD-3-Clause
#include "bus/codec_keys.h"

#include <algorithm>

#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

msg::basis_entry_t entry_to_msg(const BasisEntry& entry) {
  msg::basis_entry_t m{.sender = entry.sender,
                       .boot_epoch = entry.boot_epoch,
                       .number = entry.number,
                       .n_skipped = static_cast<std::int32_t>(entry.skipped.size()),
                       .skipped = entry.skipped};
  return m;
}

/// First and last number of each run, ascending, none beyond the last that was folded.
bool valid_skipped(const BasisEntry& entry) {
  std::int64_t before = -1;
  for (std::size_t i = 0; i + 1 < entry.skipped.size(); i += 2) {
    const std::int64_t first = entry.skipped[i], last = entry.skipped[i + 1];
    if (first <= before || last < first) return false;
    before = last;
  }
  return entry.skipped.size() % 2 == 0 && before <= entry.number;
}

std::optional<BasisEntry> entry_from_msg(const msg::basis_entry_t& m) {
  const BasisEntry entry{.sender = m.sender, .boot_epoch = m.boot_epoch, .number = m.number, .skipped = m.skipped};
  const bool valid =
      valid_mav(entry.sender) && valid_utime(entry.boot_epoch) && entry.number >= -1 && valid_skipped(entry);
  return valid ? std::optional(entry) : std::nullopt;
}

bool in_order(const BasisEntry& a, const BasisEntry& b) {
  return std::pair(a.sender, a.boot_epoch) < std::pair(b.sender, b.boot_epoch);
}

}  // namespace

msg::batch_key_t to_msg(const BatchKey& key) {
  return {.mission = key.mission, .sender = key.sender, .boot_epoch = key.boot_epoch, .number = key.number};
}

std::optional<BatchKey> from_msg(const msg::batch_key_t& m) {
  const BatchKey key{.mission = m.mission, .sender = m.sender, .boot_epoch = m.boot_epoch, .number = m.number};
  return valid_key(key) ? std::optional(key) : std::nullopt;
}

msg::basis_t to_msg(const Basis& basis) {
  msg::basis_t m;
  pack_all(basis, m.n, m.entries, entry_to_msg);
  return m;
}

std::optional<Basis> from_msg(const msg::basis_t& m) {
  Basis basis;
  if (!unpack_all(m.entries, basis, entry_from_msg)) return {};
  const auto disorder =
      std::adjacent_find(basis.begin(), basis.end(), [](const auto& a, const auto& b) { return !in_order(a, b); });
  return disorder == basis.end() ? std::optional(basis) : std::nullopt;
}

msg::channel_counts_t to_msg(const ChannelCounts& counts) {
  return {.nuclide = clean_text(counts.nuclide), .singles = counts.singles, .pairs = counts.pairs};
}

std::optional<ChannelCounts> from_msg(const msg::channel_counts_t& m) {
  const ChannelCounts counts{.nuclide = m.nuclide, .singles = m.singles, .pairs = m.pairs};
  const bool valid = valid_text(counts.nuclide) && counts.singles >= 0 && counts.pairs >= 0;
  return valid ? std::optional(counts) : std::nullopt;
}

}  // namespace comptonaut
