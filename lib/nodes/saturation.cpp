// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/saturation.h"

#include "detector/rate_loss.h"

namespace comptonaut {

void Saturation::add(double share) {
  share_ = share;
  if (!keep_out_ && share >= kNearSaturation) ++times_;
  keep_out_ = share >= (keep_out_ ? 0.75 : 1.0) * kNearSaturation;
}

}  // namespace comptonaut
