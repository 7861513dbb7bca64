// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/time.h"
#include "detector/hit.h"

namespace comptonaut {

/// UTC of a chip's time 0 from when its rows arrived, for streams that do not tell it.
///
/// No row arrives before it was measured, and of many rows the quickest take hardly any time. So over the last minute
/// the arrivals are bounded from below by a straight line (its slope is the drift of the chip's clock, 100 ppm at
/// most): the edge of their lower convex hull that carries their middle, which lies below all of them and as close as
/// a line can [Moon, Skelly, Towsley, INFOCOM 1999]. What the quickest rows take cannot be seen in arrivals.
/// Where arrivals go beyond the line by half a second for three seconds on end, or fall so far below it, the clock
/// that stamps them was set: what was before counts no more.
class ArrivalFit {
 public:
  /// Rows up to this chip time, which never falls, had come when the clock showed `arrival`.
  void add(ChipTime newest, Utime arrival);

  struct Fit {
    Utime start_utime = 0;  ///< of chip time 0, as the chip's clock runs now
    std::int32_t sigma_us = 0;
  };
  /// As of the newest arrival. nullopt before the first.
  [[nodiscard]] std::optional<Fit> fit() const;

 private:
  /// The quickest arrival of a second of chip time.
  struct Quickest {
    std::int64_t second = 0;
    double t_us = 0.0;       ///< chip time
    double offset_us = 0.0;  ///< arrival - chip time - origin_
  };
  struct Line {
    double at_us = 0.0, offset_us = 0.0, slope = 0.0;
    [[nodiscard]] double offset(double t_us) const { return offset_us + slope * (t_us - at_us); }
  };
  void drop_old();
  void refit();

  std::deque<Quickest> seconds_;
  Utime origin_ = 0;       ///< arrival - chip time of the first, so that doubles keep their digits
  std::int64_t rows_ = 0;  ///< in seconds_
  double newest_us_ = 0.0;
  Line line_;
  double excess_us_ = 0.0;  ///< of the quickest arrivals over the line, in the mean
};

}  // namespace comptonaut
