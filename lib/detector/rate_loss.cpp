// SPDX-License-Identifier: BSD-3-Clause
#include "detector/rate_loss.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

constexpr double kTick_ns = 25.0;

double pile_up(double counted_per_window) {
  if (counted_per_window >= 1.0) return 1.0;
  const double true_per_window = counted_per_window / (1.0 - counted_per_window);
  return 1.0 - std::exp(-true_per_window) / (1.0 + true_per_window);
}

}  // namespace

void RateTotals::add(const DetectorEvent& event) {
  ++events;
  hits += event.hits;
  tot_ticks += event.tot_ticks;
}

void RateTotals::add(const Hit& hit) {
  ++hits;
  tot_ticks += hit.tot;
}

RateLoss rate_loss(const RateTotals& totals, ChipTime live, double window_ns) {
  if (live <= 0) return {};
  const double live_ns = static_cast<double>(live) * kChipTime_ns;
  const auto hits = static_cast<double>(totals.hits);
  const double blind_ns = kTick_ns * static_cast<double>(totals.tot_ticks) + kPixelReadout_ns * hits;
  const double saturation = hits / (1e-9 * live_ns) / kHitsMax_per_s;
  return {.saturation = saturation,
          .pixel_dead_share = std::min(1.0, blind_ns / (live_ns * kChipPixels * kChipPixels)),
          .pile_up_share = pile_up(static_cast<double>(totals.events) * window_ns / live_ns),
          .near_saturation = saturation >= kNearSaturation};
}

}  // namespace comptonaut
