// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace comptonaut {

/// Is the detector so close to a source that it is going blind? Begins at kNearSaturation of the hits that it can hand
/// over and ends a quarter below that, so that it is said once.
class Saturation {
 public:
  /// Hits of the latest batch per live second as a share of kHitsMax_per_s.
  void add(double share);

  [[nodiscard]] bool keep_out() const { return keep_out_; }
  [[nodiscard]] double share() const { return share_; }        ///< the latest
  [[nodiscard]] std::int64_t times() const { return times_; }  ///< that it began

 private:
  double share_ = 0.0;
  bool keep_out_ = false;
  std::int64_t times_ = 0;
};

}  // namespace comptonaut
