// SPDX-License-Identifier: BSD-3-Clause
#include "keep_out.h"

#include <fmt/format.h>

#include "bus/daemon.h"
#include "detector/rate_loss.h"

namespace comptonaut {

void KeepOutLine::tell(const Saturation& saturation) {
  const double mega_hits_s = 1e-6 * kHitsMax_per_s * saturation.share();
  if (saturation.times() > told_) {
    print_warning("comptonaut-detector-reader",
                  fmt::format("keep out: {:.2f} million hits/s, close to the limit of {:.2f}; beyond it data are lost",
                              mega_hits_s, 1e-6 * kHitsMax_per_s));
  }
  if ((keep_out_ || saturation.times() > told_) && !saturation.keep_out()) {
    print_warning("comptonaut-detector-reader",
                  fmt::format("no longer close to the limit: {:.2f} million hits/s", mega_hits_s));
  }
  told_ = saturation.times();
  keep_out_ = saturation.keep_out();
}

}  // namespace comptonaut
