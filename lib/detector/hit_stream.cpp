// SPDX-License-Identifier: BSD-3-Clause
#include "detector/hit_stream.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "detector/calibration.h"

namespace comptonaut {
namespace {

constexpr std::size_t kSlice = 4096;      ///< bytes parsed at once: their items stay in the first cache
constexpr std::size_t kPart = 32768;      ///< bytes whose hits are ordered at once
constexpr std::size_t kAgree = 3;         ///< rows that make a jump in time believable
constexpr std::size_t kAgreeRestart = 2;  ///< the same where Index counts from 0 again
constexpr double kLearned_us = 60e6;      ///< so long rows are waited for that came late
constexpr double kTick_ms = 20.0;         ///< silences are told more often than that
constexpr double kFrameMax_us = 300e6;    ///< no frame of a recording vouches for a longer silence
using Kind = StreamItem::Kind;

ChipTime chip_time_of_us(double us) { return static_cast<ChipTime>(us * static_cast<double>(kChipTimePerUs)); }

}  // namespace

HitStream::HitStream(const HitStreamConfig& config, ChipTime quiet, bool recording, HitFormat format)
    : quiet_(quiet),
      reorder_(chip_time_of_us(config.reorder_us)),
      jump_max_(chip_time_of_us(1e6 * config.jump_max_s)),
      silence_max_(recording ? std::numeric_limits<ChipTime>::max() : chip_time_of_us(1e3 * config.silence_max_ms)),
      quiet_max_(chip_time_of_us(1e3 * config.quiet_max_ms)),
      delay_max_ms_(config.delay_max_ms),
      quiet_max_ms_(config.quiet_max_ms),
      recording_(recording),
      order_(quiet),
      life_(silence_max_) {
  if (format == HitFormat::kT3p) parser_.emplace<T3pParser>();
  if (format == HitFormat::kClog) parser_.emplace<ClogParser>();
}

void HitStream::feed(std::span<const char> bytes) { bytes_ = bytes; }

void HitStream::on_silence(double silent_ms) {
  if (!has_data_ || recording_ || tells_time_) return;
  silent_ms_ = silent_ms;
  const ChipTime t = newest_ + chip_time_of_us(1e3 * (std::min(silent_ms, quiet_max_ms_) - delay_ms()));
  if (t <= std::max(newest_, passed_)) return;
  silent_ = true;
  passed_ = t;
  life_.sign(t);
  if (lost_from_) life_.lost(*lost_from_, t);
  order(repair_.advance(t));
}

void HitStream::end() {
  items_ = std::visit([](auto& parser) { return parser.end(); }, parser_);
  at_ = 0;
  ending_ = true;
}

std::optional<StreamPart> HitStream::next() {
  if (epoch_over_) begin_epoch();
  if (at_ == items_.size() && bytes_.empty()) {
    if (!ending_) return std::exchange(silent_, false) ? std::optional(release()) : std::nullopt;
    ending_ = false;
    return end_epoch();
  }
  const std::size_t left = bytes_.size() - std::min(kPart, bytes_.size());
  do {
    if (at_ == items_.size()) parse();
    if (take_items()) return end_epoch();
  } while (bytes_.size() > left);
  return release();
}

void HitStream::parse() {
  const auto slice = bytes_.first(std::min(kSlice, bytes_.size()));
  bytes_ = bytes_.subspan(slice.size());
  items_ = std::visit([&](auto& parser) { return parser.parse(slice); }, parser_);
  at_ = 0;
}

/// Takes what was parsed. True: the epoch ends with it, or before what comes next.
bool HitStream::take_items() {
  for (; at_ < items_.size(); ++at_) {
    take_run();
    if (at_ == items_.size()) break;
    if (begins_epoch(items_[at_])) return true;
    take(items_[at_]);
    if (epoch_over_) {
      ++at_;
      return true;
    }
  }
  return false;
}

StreamPart HitStream::release() {
  flush_run();
  // A row may come so late that it just follows, wait for repair behind the newest one, and be put back by a fault.
  const auto hits = order_.release(std::max(newest_, passed_) - reorder_ - kEpochRepairDelay - 2 * kEpochFault);
  return {.hits = hits, .until = order_.until()};
}

bool HitStream::begins_epoch(const StreamItem& item) const {
  return has_data_ && (item.kind == Kind::kHeader || item.kind == Kind::kStart);
}

/// Rows that told that chip time starts again are the first ones of the new epoch.
void HitStream::begin_epoch() {
  const std::vector<StreamItem> first_rows = std::exchange(suspects_, {});
  epoch_over_ = has_data_ = false;
  newest_ = passed_ = learned_until_ = 0;
  last_index_ = 0;
  start_utime_.reset();
  lost_from_.reset();
  frame_to_ = 0;
  counts_.repaired += repair_.repaired();
  repair_ = EpochRepair();
  order_ = TimeOrder(quiet_);
  life_ = LiveTime(silence_max_);
  for (const StreamItem& item : first_rows) accept(item);
}

StreamPart HitStream::end_epoch() {
  if (!epoch_over_) refuse_suspects();
  epoch_over_ = true;
  ChipTime until = std::max(newest_, order_.until());
  if (lost_from_) life_.lost(*lost_from_, until);
  flush_run();
  order(repair_.flush());
  const auto hits = order_.release(newest_ + kEpochFault + quiet_ + 2);
  if (!hits.empty()) until = std::max(until, hits.back().t);  // one may be repaired to after the newest row
  return {.hits = hits, .until = until, .ends_epoch = true};
}

void HitStream::take(const StreamItem& item) {
  switch (item.kind) {
    case Kind::kHit:
    case Kind::kAlive:
      return take_timed(item);
    case Kind::kLostBegin:
    case Kind::kLostEnd:
      return take_lost(item);
    case Kind::kStart:
      start_utime_ = item.value;
      return;
    case Kind::kShutter:
      frame_to_ = item.value;
      return;
    case Kind::kLostHit:
      return life_.lost_hits(newest_, 1);
    case Kind::kHeader:
      return;
  }
}

/// Takes the hits from here on to which nothing happens but to be accepted: what take() would do, quicker.
void HitStream::take_run() {
  if (!has_data_ || lost_from_ || !suspects_.empty()) return;
  const ChipTime step_max = std::min({jump_max_, silence_max_, quiet_max_}), late_max = reorder_ + kEpochFault;
  const std::size_t begin = run_.size();
  run_.resize(begin + items_.size() - at_);
  Hit* out = run_.data() + begin;
  const StreamItem* item = items_.data() + at_;
  const StreamItem* const end = items_.data() + items_.size();
  ChipTime newest = newest_;
  std::uint32_t last_index = last_index_;
  std::int64_t saturated = 0;
  for (; item != end && item->kind == Kind::kHit; ++item) {
    const ChipTime step = item->value - newest;
    if (step > step_max || step < -late_max || (item->index == 0 && last_index > 0)) break;
    newest = std::max(newest, item->value);
    last_index = item->index;
    saturated += item->tot >= kSaturatedTot ? 1 : 0;
    *out++ = item->hit();
  }
  at_ = items_.size() - static_cast<std::size_t>(end - item);
  newest_ = newest;
  last_index_ = last_index;
  const std::int64_t taken = out - run_.data() - static_cast<std::ptrdiff_t>(begin);
  run_.resize(begin + static_cast<std::size_t>(taken));
  life_.lived_until(newest_);
  counts_.hits += taken;
  counts_.saturated += saturated;
}

/// A row that jumps in time is believed once the next ones agree with it, else refused when the others go on.
void HitStream::take_timed(const StreamItem& item) {
  const bool goes_on = follows(item, newest_) && !restarts(item);
  if (suspects_.empty()) [[likely]]
    return goes_on ? accept(item) : suspect(item);

  const StreamItem& latest = suspects_.back();
  const bool agrees = follows(item, latest.value) && (item.kind == Kind::kAlive || item.index >= latest.index);
  const bool restart = restarts(suspects_.front());
  if (goes_on && !(restart && agrees && item.index == latest.index + 1)) {
    refuse_suspects();
    return accept(item);
  }
  if (!agrees) refuse_suspects();
  suspect(item);
  if (suspects_.size() < (restart ? kAgreeRestart : kAgree)) return;
  epoch_over_ = restart || suspects_.front().value < newest_;
  if (epoch_over_) return;
  for (const StreamItem& believed : std::exchange(suspects_, {})) accept(believed);
}

void HitStream::accept(const StreamItem& item) {
  counts_.epochs += has_data_ ? 0 : 1;
  has_data_ = true;
  if (recording_) doubt_silence(item);
  newest_ = std::max(newest_, item.value);
  life_.sign(item.value);
  if (item.kind == Kind::kAlive) {
    tells_time_ = true;
    flush_run();
    return order(repair_.advance(item.value));
  }
  last_index_ = item.index;
  if (lost_from_) life_.lost(*std::exchange(lost_from_, std::nullopt), item.value);
  ++counts_.hits;
  counts_.saturated += item.tot >= kSaturatedTot ? 1 : 0;
  run_.push_back(item.hit());
}

/// What nothing tells of the time before the item is dead: a chip sees a few of the background's photons each second.
void HitStream::doubt_silence(const StreamItem& item) {
  const ChipTime believed = newest_ + (item.kind == Kind::kAlive ? jump_max_ : quiet_max_);
  const ChipTime in_frame = std::min(frame_to_, newest_ + chip_time_of_us(kFrameMax_us));
  life_.lost(std::max(believed, in_frame), item.value);
}

void HitStream::take_lost(const StreamItem& item) {
  if (item.kind == Kind::kLostBegin) {
    ++counts_.lost_gaps;
    lost_from_ = follows(item, newest_) ? item.value : newest_;
    return;
  }
  if (!lost_from_) ++counts_.lost_gaps;  // data were lost all the same
  const ChipTime from = lost_from_.value_or(newest_);
  if (item.value > std::max(jump_max_, frame_to_ - from))
    return counts_.faults.add(RowFault::kMarker, item.line);  // the gap ends with the next hit
  lost_from_.reset();
  life_.lost(from, from + item.value);
}

void HitStream::suspect(const StreamItem& item) { suspects_.push_back(item); }

void HitStream::refuse_suspects() {
  for (const StreamItem& item : suspects_) {
    counts_.faults.add(RowFault::kOutOfSequence, item.line);
    if (item.kind == Kind::kHit) life_.lost_hits(newest_, 1);
  }
  suspects_.clear();
}

/// Index is 0 again: a measurement was appended.
bool HitStream::restarts(const StreamItem& item) const {
  return item.kind == Kind::kHit && item.index == 0 && last_index_ > 0;
}

/// No farther back than rows can be out of order, no farther ahead than streams pause or a frame goes. Alive lines may
/// lag.
bool HitStream::follows(const StreamItem& item, ChipTime newest) const {
  const ChipTime late_max = reorder_ + kEpochFault;
  return item.value <= std::max(newest + jump_max_, frame_to_) &&
         (item.kind == Kind::kAlive || item.value >= newest - late_max);
}

void HitStream::flush_run() {
  order(repair_.add(run_));
  run_.clear();
}

void HitStream::order(std::span<const Hit> hits) {
  const std::int64_t late = order_.add(hits);
  if (late == 0) return;
  counts_.faults.count[static_cast<std::size_t>(RowFault::kLate)] += late;
  life_.lost_hits(order_.until(), late);
  learned_delay_ms_ = std::min(std::max(delay_ms(), silent_ms_ + kTick_ms), quiet_max_ms_);
  learned_until_ = newest_ + chip_time_of_us(kLearned_us);
}

/// How long rows are waited for. A source that hands over blocks shows it by rows that come late after a silence.
double HitStream::delay_ms() const {
  return newest_ < learned_until_ ? std::max(learned_delay_ms_, delay_max_ms_) : delay_max_ms_;
}

HitStreamCounts HitStream::counts() const {
  HitStreamCounts counts = counts_;
  counts.rows = std::visit([](const auto& parser) { return parser.rows(); }, parser_);
  counts.repaired += repair_.repaired();
  counts.faults += std::visit([](const auto& parser) { return parser.faults(); }, parser_);
  return counts;
}

}  // namespace comptonaut
