// SPDX-License-Identifier: BSD-3-Clause
#include "sim/arrivals.h"

#include <algorithm>
#include <array>

#include "detector/epoch_repair.h"
#include "sim/streams.h"

namespace comptonaut {
namespace {

/// Mean delay of a row, exponentially distributed: 0.1 % of rows are more than 1.5 us late.
constexpr double kDelay_ns = 215.0;
constexpr ChipTime kTick = 16;
constexpr double kChipSecond = 1e9 / kChipTime_ns;
constexpr std::uint16_t kHotPixelTot = 12;

}  // namespace

Arrivals::Arrivals(const Traps& traps, std::uint64_t seed, int mav)
    : traps_(traps),
      order_random_(random_stream(seed, Purpose::kArrival, mav)),
      trap_random_(random_stream(seed, Purpose::kTraps, mav)) {
  for (int i = 0; i < traps.hot_pixels; ++i) {
    hot_pixels_.push_back(static_cast<std::uint16_t>(trap_random_() % (kChipPixels * kChipPixels)));
  }
}

std::string Arrivals::start(Utime start_utime) {
  writer_.start(start_utime);
  return writer_.take();
}

void Arrivals::add_row(const Hit& hit, ChipTime t) {
  const auto delay = static_cast<ChipTime>(order_random_.exponential() * kDelay_ns / kChipTime_ns);
  rows_.push_back({.t = t, .arrival = t + delay, .hit = hit});
}

void Arrivals::add(std::span<const Hit> hits) {
  const bool fault = traps_.epoch_fault_share > 0.0 && trap_random_.uniform() < traps_.epoch_fault_share;
  const bool whole = fault && trap_random_.uniform() < 0.5;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    Hit hit = hits[i];
    const ChipTime t = hit.t;
    if (fault && (whole || i == 0)) hit.t += kEpochFault;
    if (traps_.tot_zero_share > 0.0 && trap_random_.uniform() < traps_.tot_zero_share) hit.tot = 0;
    add_row(hit, t);
    if (traps_.repeated_pixel_share > 0.0 && trap_random_.uniform() < traps_.repeated_pixel_share) add_row(hit, t);
  }
}

void Arrivals::add_hot_pixels(ChipTime until) {
  const double duration_s = static_cast<double>(until - sent_until_) / kChipSecond;
  for (const std::uint16_t pixel : hot_pixels_) {
    const std::int64_t hits = trap_random_.poisson(traps_.hot_pixel_hits_per_s * duration_s);
    for (std::int64_t i = 0; i < hits; ++i) {
      const ChipTime t = sent_until_ + static_cast<ChipTime>(trap_random_.uniform() * (until - sent_until_));
      add_row({.t = t, .pixel = pixel, .tot = kHotPixelTot}, t);
    }
  }
}

void Arrivals::write_gaps(ChipTime until) {
  const double duration_s = static_cast<double>(until - sent_until_) / kChipSecond;
  if (trap_random_.poisson(traps_.lost_data_per_s * duration_s) == 0) return;
  const auto gap_ticks = static_cast<std::int64_t>(traps_.lost_data_s * kChipSecond / kTick);
  gap_until_ = sent_until_ + gap_ticks * kTick;
  writer_.lost_data(sent_until_ / kTick, gap_ticks);
}

void Arrivals::write_broken_rows(ChipTime until) {
  static const std::array<std::string, 3> broken = {"17\t4711\t99\n", "\xff\xfe no row\t1\n", "1\t99999\t1\t1\t1\t0\n"};
  const double duration_s = static_cast<double>(until - sent_until_) / kChipSecond;
  const std::int64_t rows = trap_random_.poisson(traps_.broken_rows_per_s * duration_s);
  for (std::int64_t i = 0; i < rows; ++i) writer_.raw(broken[trap_random_() % broken.size()]);
}

std::string Arrivals::send(ChipTime until) {
  add_hot_pixels(until);
  if (traps_.lost_data_per_s > 0.0) write_gaps(until);
  const auto by_arrival = [](const Row& a, const Row& b) { return a.arrival < b.arrival; };
  const auto later = std::stable_partition(rows_.begin(), rows_.end(), [&](const Row& row) { return row.t < until; });
  std::stable_sort(rows_.begin(), later, by_arrival);
  for (auto row = rows_.begin(); row != later; ++row) {
    if (row->t >= gap_until_) writer_.hit(row->hit);
  }
  rows_.erase(rows_.begin(), later);
  if (traps_.broken_rows_per_s > 0.0) write_broken_rows(until);
  writer_.alive(until / kTick);
  sent_until_ = until;
  return writer_.take();
}

}  // namespace comptonaut
