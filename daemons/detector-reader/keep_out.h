// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "nodes/saturation.h"

namespace comptonaut {

/// Says in the journal, once each time, that the detector is about to go blind, and that it is no longer.
class KeepOutLine {
 public:
  void tell(const Saturation& saturation);

 private:
  std::int64_t told_ = 0;
  bool keep_out_ = false;
};

}  // namespace comptonaut
