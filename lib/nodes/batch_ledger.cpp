// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/batch_ledger.h"

#include <algorithm>
#include <tuple>

namespace comptonaut {
namespace {

// Runs given up in one tick: what a plan's basis has room for in its datagram. More follow at the next tick.
constexpr std::int64_t kMaxRunsPerTick = 12;
// A faulty sender must not fill the memory.
constexpr std::size_t kMaxWaiting = 50'000;
constexpr std::size_t kMaxStreams = 1'000;
constexpr std::int64_t kMaxNumber = 1'000'000'000'000;

bool comes_before(const MeasurementBatch& a, const MeasurementBatch& b) {
  return std::tie(a.utime, a.key.sender, a.key.boot_epoch, a.key.number) <
         std::tie(b.utime, b.key.sender, b.key.boot_epoch, b.key.number);
}

}  // namespace

BatchLedger::BatchLedger(Utime gap_give_up_us) : gap_give_up_us_(gap_give_up_us) {}

BatchLedger::Entry BatchLedger::enter(const MeasurementBatch& batch) {
  const Name name{batch.key.sender, batch.key.boot_epoch};
  if (streams_.size() >= kMaxStreams && !streams_.contains(name)) return Entry::kTooMany;
  Stream& stream = streams_[name];
  const std::int64_t number = batch.key.number;
  if (number <= stream.folded) {
    const bool given_up = std::any_of(stream.given_up.begin(), stream.given_up.end(),
                                      [number](const Run& run) { return number >= run.first && number <= run.second; });
    return given_up ? Entry::kGivenUp : Entry::kDuplicate;
  }
  if (stream.waiting.size() >= kMaxWaiting) return Entry::kTooMany;
  if (!stream.waiting.try_emplace(number, batch).second) return Entry::kDuplicate;
  newest_ = std::max(newest_.value_or(batch.end_utime()), batch.end_utime());
  return Entry::kNew;
}

std::optional<Utime> BatchLedger::first_utime(std::int32_t sender) const {
  for (const auto& [name, stream] : streams_) {
    if (name.first == sender && !stream.waiting.empty()) return stream.waiting.begin()->second.utime;
  }
  return std::nullopt;
}

Utime BatchLedger::given_up_until() const { return newest_.value_or(0) - gap_give_up_us_; }

std::optional<Utime> BatchLedger::reach(std::int32_t sender) const {
  std::optional<Utime> reach;
  for (const auto& [name, stream] : streams_) {
    if (name.first != sender) continue;
    if (stream.folded_end) reach = std::max(reach.value_or(*stream.folded_end), *stream.folded_end);
    std::int64_t next = stream.folded + 1;
    for (const auto& [number, batch] : stream.waiting) {
      if (number != next && batch.end_utime() > given_up_until()) break;
      reach = std::max(reach.value_or(batch.end_utime()), batch.end_utime());
      next = number + 1;
    }
  }
  return reach;
}

std::int64_t BatchLedger::waiting() const {
  std::int64_t n = 0;
  for (const auto& [name, stream] : streams_) n += std::ssize(stream.waiting);
  return n;
}

void BatchLedger::take(Stream& stream, std::int64_t number, Fold& fold) {
  auto node = stream.waiting.extract(number);
  stream.folded = number;
  const Utime end = node.mapped().end_utime();
  stream.folded_end = std::max(stream.folded_end.value_or(end), end);
  fold.batches.push_back(std::move(node.mapped()));
}

void BatchLedger::give_up(Stream& stream, Run run, Fold& fold) {
  stream.given_up.push_back(run);
  fold.given_up += run.second - run.first + 1;
}

BatchLedger::Fold BatchLedger::fold_until(Utime tick) {
  Fold fold;
  std::int64_t runs_left = kMaxRunsPerTick;
  for (auto& [name, stream] : streams_) {
    while (!stream.waiting.empty()) {
      const auto& [number, batch] = *stream.waiting.begin();
      if (batch.end_utime() > tick) break;
      if (number != stream.folded + 1) {
        if (batch.end_utime() > given_up_until() || runs_left == 0) break;
        give_up(stream, {stream.folded + 1, number - 1}, fold);
        --runs_left;
      }
      take(stream, number, fold);
    }
  }
  close(fold);
  return fold;
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
    if (it == streams_.end() || entry.number < it->second.folded || !has_all(it->second, entry)) return false;
  }
  return std::all_of(streams_.begin(), streams_.end(), [&](const auto& known) {
    return known.second.folded < 0 || std::any_of(basis.begin(), basis.end(), [&](const BasisEntry& entry) {
             return Name{entry.sender, entry.boot_epoch} == known.first;
           });
  });
}

std::optional<BatchLedger::Fold> BatchLedger::fold_to(const Basis& basis) {
  if (!leads_to(basis)) return std::nullopt;
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
  close(fold);
  return fold;
}

/// Puts the batches in order and writes the basis.
void BatchLedger::close(Fold& fold) {
  std::sort(fold.batches.begin(), fold.batches.end(), comes_before);
  for (auto& [name, stream] : streams_) {
    if (stream.folded < 0) continue;
    BasisEntry entry{.sender = name.first, .boot_epoch = name.second, .number = stream.folded};
    for (; stream.given_up_before < stream.given_up.size(); ++stream.given_up_before) {
      const Run& run = stream.given_up[stream.given_up_before];
      entry.skipped.insert(entry.skipped.end(), {run.first, run.second});
    }
    fold.basis.push_back(std::move(entry));
  }
}

}  // namespace comptonaut
