// SPDX-License-Identifier: BSD-3-Clause
#include "detector/epoch_repair.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace comptonaut {
namespace {

constexpr std::size_t kBlock = 96;      ///< rows looked at together
constexpr std::size_t kLookahead = 32;  ///< of them, rows that wait for what follows
constexpr ChipTime kTick = 16;
constexpr ChipTime kSlack = 100 * kTick;    ///< 2.5 us: rows may be that much out of order
constexpr ChipTime kSeldom = 400 * kTick;   ///< 10 us: a few in a hundred thousand are that much out of order
constexpr ChipTime kTolerance = 8 * kTick;  ///< 200 ns: neighbours of one cluster
constexpr int kReach_px = 15;               ///< fluorescence is beside its cluster
constexpr std::size_t kBesideRows = 8;

constexpr std::size_t kShifts = 3;
constexpr std::array<ChipTime, kShifts> kShift = {0, -kEpochFault, kEpochFault};
// Costs, as -log of how often things happen, up to scale.
constexpr std::array<double, kShifts> kBegin = {0.0, 1.0, 3.0};  ///< a run of shifted rows
constexpr std::array<double, kShifts> kRow = {0.0, 0.1, 0.3};    ///< each row of it
constexpr double kSmallStepBack = 0.9;                           ///< beyond kSlack
constexpr double kStepBack = 10.0;                               ///< beyond kSeldom
constexpr double kTornApart = 5.0;                               ///< neighbours one fault apart

bool near_px(const Hit& a, const Hit& b) {
  return std::abs(pixel_x(a.pixel) - pixel_x(b.pixel)) <= kReach_px &&
         std::abs(pixel_y(a.pixel) - pixel_y(b.pixel)) <= kReach_px;
}

bool one_fault_apart(ChipTime dt) { return std::abs(std::abs(dt) - kEpochFault) <= kTolerance; }

double step_cost(ChipTime dt, bool beside, std::size_t from, std::size_t to) {
  double cost = kRow[to] + (from == to ? 0.0 : kBegin[to]);
  if (dt < -kSlack) cost += dt < -kSeldom ? kStepBack : kSmallStepBack;
  if (beside && one_fault_apart(dt)) cost += kTornApart;
  return cost;
}

/// A shift may mend such a step: one back, or of one fault. Without branches.
bool is_odd_step(ChipTime dt) {
  static_assert(kSlack < kEpochFault - kTolerance);
  const bool one_fault_on = static_cast<std::uint64_t>(dt - (kEpochFault - kTolerance)) <= 2 * kTolerance;
  return (dt < -kSlack) | one_fault_on;
}

/// Several rows: whether no step to one of them is odd or long, and the newest of them and what came before.
struct Rows {
  bool calm;
  ChipTime newest;
};
inline Rows look_at(const Hit* rows, std::size_t count, ChipTime before, ChipTime newest) {
  constexpr ChipTime kCalm = kEpochFault - kTolerance - 1;
  ChipTime outside = 0;  // negative where a step is
  for (std::size_t i = 0; i < count; ++i) {
    const ChipTime t = rows[i].t, dt = t - before;
    outside |= (dt + kSlack) | (kCalm - dt);
    newest = std::max(newest, t);
    before = t;
  }
  return {.calm = outside >= 0, .newest = newest};
}

/// Is row i within reach of the row before it, or of those that came together with that one?
bool beside_row_before(std::span<const Hit> rows, std::size_t i) {
  const ChipTime t_before = rows[i - 1].t;
  for (std::size_t back = 1; back <= std::min(i, kBesideRows); ++back) {
    const Hit& other = rows[i - back];
    if (std::abs(other.t - t_before) > kSlack) return false;
    if (near_px(rows[i], other)) return true;
  }
  return false;
}

using Shifts = std::array<std::uint8_t, kBlock>;

/// The likeliest shift of each row, at most kBlock; of the first as given, if it is.
Shifts find_shifts(std::span<const Hit> rows, std::optional<std::uint8_t> first_shift) {
  std::array<double, kShifts> cost = kBegin;
  if (rows.front().t < kEpochFault) cost[1] = 1e9;  // chip time is not negative
  if (first_shift) {
    cost.fill(1e9);
    cost[*first_shift] = 0.0;
  }
  std::array<std::array<std::uint8_t, kShifts>, kBlock> best_from;
  best_from[0] = {};
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const bool beside = beside_row_before(rows, i);
    const ChipTime dt = rows[i].t - rows[i - 1].t;
    std::array<double, kShifts> next;
    for (std::size_t to = 0; to < kShifts; ++to) {
      next[to] = 1e12;
      for (std::size_t from = 0; from < kShifts; ++from) {
        const double via = cost[from] + step_cost(dt + kShift[to] - kShift[from], beside, from, to);
        if (via >= next[to]) continue;
        next[to] = via;
        best_from[i][to] = static_cast<std::uint8_t>(from);
      }
    }
    cost = next;
  }
  Shifts shifts;
  auto shift = static_cast<std::uint8_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  for (std::size_t i = rows.size(); i-- > 0;) {
    shifts[i] = shift;
    shift = best_from[i][shift];
  }
  return shifts;
}

}  // namespace

std::span<const Hit> EpochRepair::add(std::span<const Hit> hits) {
  forget_settled();
  rows_.insert(rows_.end(), hits.begin(), hits.end());
  if (hits.empty()) return {};
  if (waiting() == 0 && !before_) newest_ = latest_ = hits.front().t;
  for (std::size_t calm = 0; end_ < rows_.size();) {
    if (rows_[end_].t > newest_ + kEpochRepairDelay) {
      settle(waiting());
      if (end_ >= calm) calm = pass_calm();
    }
    take_rows();
  }
  return settled();
}

/// Takes rows in up to one that settles others, or to a pause.
void EpochRepair::take_rows() {
  const std::size_t full = first_ + kBlock - (before_ ? 1 : 0), last = std::min(rows_.size(), full);
  const ChipTime wait_until = rows_[first_].t + kEpochRepairDelay;
  ChipTime newest = newest_, latest = latest_;
  std::size_t end = end_, odd = odd_;
  for (constexpr std::size_t kSeveral = 8; end + kSeveral < last; end += kSeveral) {
    const Rows several = look_at(rows_.data() + end, kSeveral, latest, newest);
    if (!several.calm || several.newest > wait_until) break;
    newest = several.newest;
    latest = rows_[end + kSeveral - 1].t;
  }
  do {
    const ChipTime t = rows_[end].t;
    odd += is_odd_step(t - latest) ? 1 : 0;
    newest = std::max(newest, t);
    latest = t;
    ++end;
  } while (end < last && newest <= wait_until && rows_[end].t <= newest + kEpochRepairDelay);
  newest_ = newest;
  latest_ = latest;
  end_ = end;
  odd_ = odd;
  if (end_ == full) {
    settle(full - first_ - kLookahead);
  } else {
    settle_old(newest_);
  }
}

/// After a pause with nothing waiting: as long as steps are not odd, each further pause settles what lies before it as
/// it came. Goes on to the last such pause, and returns up to where no other is.
std::size_t EpochRepair::pass_calm() {
  if (before_shift_ != 0) return end_;
  std::size_t row = end_ + 1, paused = end_;
  for (ChipTime newest = rows_[end_].t; row < rows_.size(); ++row) {
    const ChipTime t = rows_[row].t;
    if (is_odd_step(t - rows_[row - 1].t)) break;
    paused = t > newest + kEpochRepairDelay ? row : paused;
    newest = std::max(newest, t);
  }
  if (paused == end_) return row;
  first_ = end_ = paused;
  before_ = rows_[paused - 1];
  newest_ = latest_ = before_->t;
  return row;
}

std::span<const Hit> EpochRepair::advance(ChipTime t) {
  forget_settled();
  settle_old(t);
  return settled();
}

std::span<const Hit> EpochRepair::flush() {
  forget_settled();
  settle(waiting());
  before_.reset();
  before_shift_ = 0;
  odd_ = 0;
  return settled();
}

/// Nothing that comes tells more about rows that lie two faults back; at four it is time to let them go.
inline void EpochRepair::settle_old(ChipTime now) {
  if (waiting() == 0 || rows_[first_].t + kEpochRepairDelay >= now) return;
  std::size_t old = 0;
  while (old < waiting() && rows_[first_ + old].t + kEpochRepairDelay / 2 < now) ++old;
  settle(old);
}

/// Settles so many of the waiting rows, at least one where there are some.
void EpochRepair::settle(std::size_t count) {
  if (count == 0) return;
  const std::span<Hit> rows = std::span(rows_).subspan(first_, waiting());
  const Hit last = rows[count - 1];
  if (odd_ > 0 || before_shift_ != 0) shift_rows(rows, count);
  first_ += count;
  before_ = last;
  newest_ = last.t;
  for (const Hit& row : rows.subspan(count)) newest_ = std::max(newest_, row.t);
}

/// Repairs the first rows, so many, by what all of them tell.
void EpochRepair::shift_rows(std::span<Hit> rows, std::size_t count) {
  block_.clear();
  if (before_) block_.push_back(*before_);
  const std::size_t begin = block_.size();
  block_.insert(block_.end(), rows.begin(), rows.end());
  for (std::size_t i = 1; i < begin + count; ++i) odd_ -= is_odd_step(block_[i].t - block_[i - 1].t) ? 1 : 0;
  const Shifts shifts = find_shifts(block_, before_ ? std::optional(before_shift_) : std::nullopt);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t shift = shifts[begin + i];
    rows[i].t += kShift[shift];
    repaired_ += shift != 0 ? 1 : 0;
  }
  before_shift_ = shifts[begin + count - 1];
}

void EpochRepair::forget_settled() {
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(first_));
  end_ -= std::exchange(first_, 0);
}

}  // namespace comptonaut
