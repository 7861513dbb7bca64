// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "detector/events.h"
#include "detector/hit.h"

namespace comptonaut {

/// Hits that a MiniPIX TPX3 can hand over in a second. Beyond it data are lost.
inline constexpr double kHitsMax_per_s = 2.35e6;
/// A share of that from which on the rate counts as near saturation.
inline constexpr double kNearSaturation = 0.7;
/// A pixel is blind while it is over threshold and for so long after it, while it is read out         [Poikela 2014].
inline constexpr double kPixelReadout_ns = 475.0;

/// What was counted over some live time, say of one batch: the sum of its events.
struct RateTotals {
  std::int64_t events = 0;  ///< coincidence groups
  std::int64_t hits = 0;
  std::int64_t tot_ticks = 0;

  void add(const DetectorEvent& event);
  void add(const Hit& hit);  ///< of no event, but handed over all the same
};

/// What a detector that is alive misses because of the rate itself.
struct RateLoss {
  double saturation = 0.0;        ///< hits per live second as a share of kHitsMax_per_s
  double pixel_dead_share = 0.0;  ///< of the pixels, on average blind because they had just fired
  double pile_up_share = 0.0;     ///< of the photons, those within one coincidence window of another
  bool near_saturation = false;   ///< saturation is kNearSaturation or more

  /// Of the photons, those that are seen, each as its own event. Live time times this is what sensitivity counts on:
  /// whatever made one event of two photons made a single or a pair of none.
  [[nodiscard]] double seen_share() const { return (1.0 - pixel_dead_share) * (1.0 - pile_up_share); }
};

/// Photons come at random with true rate r. An event begins with a photon after the window of the one before and holds
/// all that follow within the window w, so events are counted at the rate m = r / (1 + r w), and a photon stands alone
/// in its event with chance exp(-r w) / (1 + r w). The window is the drift time, max_drift_ns(sensor).
/// All zero where `live` is not positive; at rates that no true rate explains (m w >= 1) everything is piled up.
[[nodiscard]] RateLoss rate_loss(const RateTotals& totals, ChipTime live, double window_ns);

}  // namespace comptonaut
