// SPDX-License-Identifier: BSD-3-Clause
#include "detector/lost_hits.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

constexpr double kRemembered_us = 10e6;
constexpr double kOwedMax_us = 10e6;  ///< what bad data cost at most once they have ended
constexpr double kPaidAtOnce = 0.5;

}  // namespace

double LostHits::pay(std::int64_t hits, std::int64_t lost, double live_us, double batch_us) {
  const double keep = std::exp(-batch_us / kRemembered_us);
  hits_ = keep * hits_ + static_cast<double>(hits + lost);
  live_us_ = keep * live_us_ + live_us;
  if (hits_ > 0.0) owed_us_ = std::min(owed_us_ + static_cast<double>(lost) * live_us_ / hits_, kOwedMax_us);
  const double paid_us = std::min(owed_us_, kPaidAtOnce * live_us);
  owed_us_ -= paid_us;
  return live_us - paid_us;
}

}  // namespace comptonaut
