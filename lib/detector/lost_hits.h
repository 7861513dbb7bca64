// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace comptonaut {

/// What hits that were lost one by one, refused or late, cost of the live time: each as much as a hit, lost or not,
/// took on average over the last ten seconds. That is taken from the batch in which they are known, at most half of it,
/// and the rest from those that follow, so that rates are right even where the lost ones' own batches have left.
class LostHits {
 public:
  /// Of the batch that ends: its hits, those that were lost, its live time and its length. Returns the live time that
  /// is left.
  [[nodiscard]] double pay(std::int64_t hits, std::int64_t lost, double live_us, double batch_us);

 private:
  double hits_ = 0.0, live_us_ = 0.0;  ///< of the last batches with the lost ones, the older the less
  double owed_us_ = 0.0;
};

}  // namespace comptonaut
