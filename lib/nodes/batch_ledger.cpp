// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/batch_ledger.h"

#include <algorithm>
#include <tuple>

namespace comptonaut {
namespace {

// What a basis may take in the coordinator's datagram, and what its parts take: a boot epoch that it names, a run that
// it names as given up. More epochs and runs wait for the next tick.
constexpr std::int64_t kBasis_bytes = 1040, kEpoch_bytes = 24, kRun_bytes = 16;
constexpr std::int64_t kMaxEpochs = 30;
// A clock that is so far ahead of the team's is wrong, and not the network slow.
constexpr Utime kWrongClock_us = kSecond_us;
// A faulty sender must not fill the memory.
constexpr std::size_t kMaxWaiting = 50'000;
constexpr std::size_t kMaxStreams = 1'000;
constexpr std::int64_t kMaxNumber = 1'000'000'000'000;

template <class Batch>
bool comes_before(const Batch& a, const Batch& b) {
  return std::tie(a.utime, a.key.sender, a.key.boot_epoch, a.key.number) <
         std::tie(b.utime, b.key.sender, b.key.boot_epoch, b.key.number);
}

}  // namespace

BatchLedger::BatchLedger(Utime gap_give_up_us, int senders)
    : gap_give_up_us_(gap_give_up_us),
      max_epochs_(std::max<std::int64_t>(2, kMaxEpochs / senders)),
      clock_(gap_give_up_us) {}

BatchLedger::Entry BatchLedger::enter(const TeamBatch& batch) {
  const auto& [mission, sender, boot_epoch, number] = key_of(batch);
  const Name name{sender, boot_epoch};
  if (streams_.size() >= kMaxStreams && !streams_.contains(name)) return Entry::kTooMany;
  const auto [found, appeared] = streams_.try_emplace(name);
  if (appeared) present_epoch_[sender] = boot_epoch;
  Stream& stream = found->second;
  if (number <= stream.folded) {
    const bool given_up =
        std::any_of(stream.given_up.begin(), stream.given_up.end(),
                    [number = number](const Run& run) { return number >= run.first && number <= run.second; });
    return given_up ? Entry::kGivenUp : Entry::kDuplicate;
  }
  if (stream.retired) return Entry::kGivenUp;
  if (stream.waiting.size() >= kMaxWaiting) return Entry::kTooMany;
  if (!stream.waiting.try_emplace(number, batch).second) return Entry::kDuplicate;
  note_time(name, stream, batch);
  return Entry::kNew;
}

void BatchLedger::note_time(const Name& name, Stream& stream, const TeamBatch& batch) {
  const std::int64_t number = key_of(batch).number;
  if (number > stream.newest) {
    stream.newest = number;
    stream.newest_end = end_utime_of(batch);
    const bool is_present = present_epoch_.at(name.first) == name.second;
    if (is_present) clock_.on_newest(name.first, stream.newest_end, stream.newest_end - utime_of(batch));
  }
  stream.heard_at = clock_.progress_us();
}

/// To be taken from its times to have the team's.
Utime BatchLedger::ahead_us(const Stream& stream) const {
  const Utime ahead_us = stream.newest_end - clock_.now().value_or(0);
  return ahead_us > kWrongClock_us ? ahead_us : 0;
}

bool BatchLedger::is_given_up_before(Utime end) const { return end + gap_give_up_us_ <= clock_.now().value_or(0); }

std::optional<Utime> BatchLedger::first_utime(std::int32_t sender) const {
  for (const auto& [name, stream] : streams_) {
    if (name.first == sender && !stream.waiting.empty()) return utime_of(stream.waiting.begin()->second);
  }
  return std::nullopt;
}

std::optional<Utime> BatchLedger::reach(std::int32_t sender) const {
  std::optional<Utime> reach;
  for (const auto& [name, stream] : streams_) {
    if (name.first != sender || stream.retired) continue;
    const Utime ahead = ahead_us(stream);
    if (stream.folded_end) reach = std::max(reach.value_or(*stream.folded_end - ahead), *stream.folded_end - ahead);
    std::int64_t next = stream.folded + 1;
    for (const auto& [number, batch] : stream.waiting) {
      const Utime end = end_utime_of(batch) - ahead;
      if (number != next && !is_given_up_before(end)) break;
      reach = std::max(reach.value_or(end), end);
      next = number + 1;
    }
  }
  return reach;
}

std::optional<Utime> BatchLedger::earliest_end() const {
  std::optional<Utime> earliest;
  for (const auto& [name, stream] : streams_) {
    if (stream.waiting.empty()) continue;
    const Utime end = end_utime_of(stream.waiting.begin()->second) - ahead_us(stream);
    earliest = std::min(earliest.value_or(end), end);
  }
  return earliest;
}

std::int64_t BatchLedger::waiting() const {
  std::int64_t n = 0;
  for (const auto& [name, stream] : streams_) n += std::ssize(stream.waiting);
  return n;
}

void BatchLedger::take(Stream& stream, std::int64_t number, Fold& fold) {
  auto node = stream.waiting.extract(number);
  if (stream.folded < 0) stream.begun = streams_begun_++;
  stream.folded = number;
  const Utime end = end_utime_of(node.mapped());
  stream.folded_end = std::max(stream.folded_end.value_or(end), end);
  if (auto* tile = std::get_if<TerrainTile>(&node.mapped())) {
    fold.tiles.push_back(std::move(*tile));
  } else {
    fold.batches.push_back(std::get<MeasurementBatch>(std::move(node.mapped())));
  }
}

void BatchLedger::give_up(Stream& stream, Run run, Fold& fold) {
  stream.given_up.push_back(run);
  fold.given_up += run.second - run.first + 1;
}

BatchLedger::Fold BatchLedger::fold_until(Utime tick) {
  retire_left_epochs();
  Fold fold;
  std::int64_t runs_left = room_for_runs();
  for (auto& [name, stream] : streams_) {
    if (stream.folded < 0 && !may_begin(name)) continue;
    while (!stream.waiting.empty()) {
      const auto& [number, batch] = *stream.waiting.begin();
      const Utime end = end_utime_of(batch) - ahead_us(stream);
      if (end > tick) break;
      if (number != stream.folded + 1) {
        if (!is_given_up_before(end) || runs_left == 0) break;
        give_up(stream, {stream.folded + 1, number - 1}, fold);
        --runs_left;
      }
      take(stream, number, fold);
    }
  }
  close(tick, fold);
  return fold;
}

bool BatchLedger::may_begin(const Name& name) const {
  const auto named = std::count_if(streams_.begin(), streams_.end(), [&name](const auto& other) {
    return other.first.first == name.first && other.second.is_named();
  });
  return named < max_epochs_;
}

std::int64_t BatchLedger::room_for_runs() const {
  const std::int64_t alive =
      std::count_if(streams_.begin(), streams_.end(), [](const auto& s) { return !s.second.retired; });
  return (kBasis_bytes - kEpoch_bytes * std::min(alive, kMaxEpochs)) / kRun_bytes;
}

/// One epoch of each sender stays named.
void BatchLedger::retire_left_epochs() {
  for (auto& [name, stream] : streams_) {
    const bool left = present_epoch_.at(name.first) != name.second;
    const bool silent = clock_.progress_us() - stream.heard_at >= gap_give_up_us_;
    const auto is_another_named = [&name = name](const auto& other) {
      return other.first.first == name.first && other.first != name && other.second.is_named();
    };
    if (!left || !silent || !stream.waiting.empty()) continue;
    stream.retired = std::any_of(streams_.begin(), streams_.end(), is_another_named);
  }
}

bool BatchLedger::has_all(const Stream& stream, const BasisEntry& entry) {
  if (entry.number > kMaxNumber) return false;
  std::int64_t missing = entry.number - stream.folded;
  const auto end = stream.waiting.upper_bound(entry.number);
  auto it = stream.waiting.begin();
  for (std::size_t i = 0; i + 1 < entry.skipped.size(); i += 2) {
    const std::int64_t first = entry.skipped[i], last = entry.skipped[i + 1];
    if (first <= stream.folded || last < first || last >= entry.number) return false;
    while (it != end && it->first < first) ++it, --missing;
    while (it != end && it->first <= last) ++it;  // it came here, but is not part of the basis
    missing -= last - first + 1;
  }
  return missing == std::distance(it, end);
}

bool BatchLedger::leads_to(const Basis& basis) const {
  for (const BasisEntry& entry : basis) {
    const auto it = streams_.find({entry.sender, entry.boot_epoch});
    if (it == streams_.end() || it->second.retired || entry.number < it->second.folded || !has_all(it->second, entry)) {
      return false;
    }
  }
  return std::all_of(streams_.begin(), streams_.end(), [&](const auto& known) {
    return !known.second.is_named() || std::any_of(basis.begin(), basis.end(), [&](const BasisEntry& entry) {
      return entry.sender == known.first.first;
    });
  });
}

void BatchLedger::retire_unnamed_epochs(const Basis& basis) {
  for (auto& [name, stream] : streams_) {
    const bool named = std::any_of(basis.begin(), basis.end(), [&name = name](const BasisEntry& entry) {
      return Name{entry.sender, entry.boot_epoch} == name;
    });
    if (named || !stream.is_named()) continue;
    stream.retired = true;
    stream.waiting.clear();
  }
}

std::optional<BatchLedger::Fold> BatchLedger::fold_to(Utime tick, const Basis& basis) {
  if (!leads_to(basis)) return std::nullopt;
  retire_unnamed_epochs(basis);
  Fold fold;
  for (const BasisEntry& entry : basis) {
    Stream& stream = streams_.at({entry.sender, entry.boot_epoch});
    for (std::size_t i = 0; i + 1 < entry.skipped.size(); i += 2) {
      const Run run{entry.skipped[i], entry.skipped[i + 1]};
      stream.waiting.erase(stream.waiting.lower_bound(run.first), stream.waiting.upper_bound(run.second));
      give_up(stream, run, fold);
    }
    while (!stream.waiting.empty() && stream.waiting.begin()->first <= entry.number) {
      take(stream, stream.waiting.begin()->first, fold);
    }
  }
  close(tick, fold);
  return fold;
}

/// Puts the batches in order and writes the basis.
void BatchLedger::close(Utime tick, Fold& fold) {
  clock_.on_tick(tick);
  std::sort(fold.batches.begin(), fold.batches.end(), comes_before<MeasurementBatch>);
  std::sort(fold.tiles.begin(), fold.tiles.end(), comes_before<TerrainTile>);
  std::map<std::int32_t, std::pair<std::int64_t, BasisEntry>> newest;  // by sender, with what tells which is
  for (auto& [name, stream] : streams_) {
    if (!stream.is_named()) continue;
    BasisEntry entry{.sender = name.first, .boot_epoch = name.second, .number = stream.folded};
    const auto [known, first] = newest.try_emplace(name.first, stream.begun, entry);
    if (!first && known->second.first < stream.begun) known->second = {stream.begun, entry};
    for (; stream.given_up_before < stream.given_up.size(); ++stream.given_up_before) {
      const Run& run = stream.given_up[stream.given_up_before];
      entry.skipped.insert(entry.skipped.end(), {run.first, run.second});
    }
    fold.basis.push_back(std::move(entry));
  }
  for (auto& [sender, entry] : newest) fold.newest.push_back(std::move(entry.second));
}

}  // namespace comptonaut
