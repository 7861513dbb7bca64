// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/saturation.h"

namespace comptonaut {
namespace {

constexpr double kBegins = 0.8;
constexpr double kEnds = 0.6;

}  // namespace

void Saturation::add(std::int64_t hits, Utime live_us, Utime duration_us) {
  if (10 * live_us < duration_us) return;
  hits_s_ = static_cast<double>(hits) / seconds(live_us);
  const double share = hits_s_ / limit_hits_s_;
  if (!keep_out_ && share >= kBegins) ++times_;
  keep_out_ = share >= (keep_out_ ? kEnds : kBegins);
}

}  // namespace comptonaut
