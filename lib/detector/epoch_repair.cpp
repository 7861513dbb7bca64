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

}  // namespace

std::span<const Hit> EpochRepair::add(std::span<const Hit> hits) {
  settled_.clear();
  rows_.resize(end_ + hits.size());
  for (const Hit& hit : hits) {
    Row& row = rows_[end_];
    row = {.hit = hit};
    if (first_ < end_) {
      const ChipTime dt = hit.t - rows_[end_ - 1].hit.t;
      row.odd = dt < -kSlack || one_fault_apart(dt);
      odd_ += row.odd ? 1 : 0;
      newest_ = std::max(newest_, hit.t);
    } else {
      newest_ = hit.t;
    }
    ++end_;
    if (end_ - first_ >= kBlock) {
      settle(kBlock - kLookahead);
    } else {
      settle_old(newest_);
    }
  }
  forget_settled();
  return settled_;
}

std::span<const Hit> EpochRepair::advance(ChipTime t) {
  settled_.clear();
  settle_old(t);
  forget_settled();
  return settled_;
}

/// Nothing that comes tells more about rows that lie two faults back; at four it is time to let them go.
inline void EpochRepair::settle_old(ChipTime now) {
  std::size_t old = has_settled_ ? 1 : 0;
  if (first_ + old == end_ || rows_[first_ + old].hit.t + kEpochRepairDelay >= now) return;
  const std::span<const Row> rows = pending();
  while (old < rows.size() && rows[old].hit.t + kEpochRepairDelay / 2 < now) ++old;
  settle(old);
}

std::span<const Hit> EpochRepair::flush() {
  settled_.clear();
  settle(pending().size());
  rows_.clear();
  first_ = end_ = odd_ = 0;
  has_settled_ = false;
  return settled_;
}

/// Settles pending rows before index `end`; the last of them stays for the others to follow on.
void EpochRepair::settle(std::size_t end) {
  const std::span<Row> rows = pending();
  const bool shifted = has_settled_ && rows.front().shift != 0;
  if (shifted || odd_ > 0) find_shifts(rows, has_settled_);
  for (std::size_t i = has_settled_ ? 1 : 0; i < end; ++i) {
    Hit hit = rows[i].hit;
    hit.t += kShift[rows[i].shift];
    repaired_ += rows[i].shift != 0 ? 1 : 0;
    settled_.push_back(hit);
  }
  if (end == 0) return;
  for (std::size_t i = 1; i < end; ++i) odd_ -= rows[i].odd ? 1 : 0;
  first_ += end - 1;
  has_settled_ = true;
  newest_ = rows[end - 1].hit.t;
  for (const Row& row : rows.subspan(end)) newest_ = std::max(newest_, row.hit.t);
}

void EpochRepair::forget_settled() {
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(first_));
  end_ -= std::exchange(first_, 0);
}

/// Is row i within reach of the row before it, or of those that came together with that one?
bool EpochRepair::beside_row_before(std::span<const Row> rows, std::size_t i) {
  const ChipTime t_before = rows[i - 1].hit.t;
  for (std::size_t back = 1; back <= std::min(i, kBesideRows); ++back) {
    const Hit& other = rows[i - back].hit;
    if (std::abs(other.t - t_before) > kSlack) return false;
    if (near_px(rows[i].hit, other)) return true;
  }
  return false;
}

void EpochRepair::find_shifts(std::span<Row> rows, bool first_is_settled) {
  std::array<double, kShifts> cost = kBegin;
  if (rows.front().hit.t < kEpochFault) cost[1] = 1e9;  // chip time is not negative
  if (first_is_settled) {
    cost.fill(1e9);
    cost[rows.front().shift] = 0.0;
  }
  std::array<std::array<std::uint8_t, kShifts>, kBlock> best_from{};
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const bool beside = beside_row_before(rows, i);
    const ChipTime dt = rows[i].hit.t - rows[i - 1].hit.t;
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
  auto shift = static_cast<std::uint8_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  for (std::size_t i = rows.size(); i-- > (first_is_settled ? 1u : 0u);) {
    rows[i].shift = shift;
    shift = best_from[i][shift];
  }
}

}  // namespace comptonaut
