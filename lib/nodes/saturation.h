// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/time.h"

namespace comptonaut {

/// Hits per second beyond which a Timepix3 (its MiniPIX readout) loses data.
inline constexpr double kChipLimit_hits_s = 2.35e6;

/// Is the detector so close to a source that it is going blind? Begins at 80 % of the limit and ends below 60 %, so
/// that it is said once.
class Saturation {
 public:
  explicit Saturation(double limit_hits_s) : limit_hits_s_(limit_hits_s) {}

  /// So many hits came while the detector could see for live_us of duration_us. Hits of a detector that saw less than
  /// a tenth of the time say nothing.
  void add(std::int64_t hits, Utime live_us, Utime duration_us);

  [[nodiscard]] bool keep_out() const { return keep_out_; }
  [[nodiscard]] double limit_hits_s() const { return limit_hits_s_; }
  [[nodiscard]] double hits_s() const { return hits_s_; }      ///< of what was added last
  [[nodiscard]] std::int64_t times() const { return times_; }  ///< that it began

 private:
  double limit_hits_s_;
  double hits_s_ = 0.0;
  bool keep_out_ = false;
  std::int64_t times_ = 0;
};

}  // namespace comptonaut
