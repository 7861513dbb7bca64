// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "picture/picture.h"

namespace comptonaut {

struct Tick {
  double value = 0.0;
  std::string label;
};

/// Round values within the axis, some `wanted` of them: multiples of 1, 2 or 5 times a power of ten, on a logarithmic
/// axis decades, with their 2 and 5 where there are few, every so many where there are too many.
[[nodiscard]] std::vector<Tick> ticks(const Axis& axis, int wanted);

/// Where a value lies on the axis: 0 at min, 1 at max. On a logarithmic one, -infinity for 0.
[[nodiscard]] double share(const Axis& axis, double value);

}  // namespace comptonaut
