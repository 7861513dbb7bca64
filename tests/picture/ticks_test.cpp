// SPDX-License-Identifier: BSD-3-Clause
#include "picture/ticks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace comptonaut {
namespace {

std::vector<std::string> labels(const Axis& axis, int wanted) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks(axis, wanted)) texts.push_back(tick.label);
  return texts;
}

using Labels = std::vector<std::string>;

TEST(Ticks, AreRoundNumbersWithinTheAxis) {
  EXPECT_EQ(labels({.min = 0, .max = 256}, 8), (Labels{"0", "50", "100", "150", "200", "250"}));
  EXPECT_EQ(labels({.min = -0.3, .max = 0.3}, 6), (Labels{"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"}));
  EXPECT_EQ(labels({.min = 1, .max = 300, .logarithmic = true}, 8),
            (Labels{"1", "2", "5", "10", "20", "50", "100", "200"}));
  EXPECT_EQ(labels({.min = 1e-5, .max = 1, .logarithmic = true}, 8),
            (Labels{"10⁻⁵", "10⁻⁴", "0.001", "0.01", "0.1", "1"}));
}

TEST(Ticks, AreNeitherNoneNorACrowdOnAnyAxis) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double size = std::pow(10.0, random.uniform(-9.0, 9.0));
    const Axis linear{.min = size * random.uniform(-1.0, 0.9), .max = size};
    const Axis logarithmic{.min = size, .max = size * std::pow(10.0, random.uniform(0.5, 12.0)), .logarithmic = true};
    for (const Axis& axis : {linear, logarithmic}) {
      const auto all = ticks(axis, 6);
      EXPECT_GE(all.size(), 1u) << axis.min << " to " << axis.max;
      EXPECT_LE(all.size(), 9u) << axis.min << " to " << axis.max;
      for (const Tick& tick : all) {
        EXPECT_GE(share(axis, tick.value), -1e-6) << tick.label;
        EXPECT_LE(share(axis, tick.value), 1.0 + 1e-6) << tick.label;
      }
    }
  }
}

TEST(Ticks, ZeroIsInfinitelyFarDownALogarithmicAxis) {
  const Axis axis{.min = 1, .max = 100, .logarithmic = true};
  EXPECT_EQ(share(axis, 0.0), -INFINITY);
  EXPECT_DOUBLE_EQ(share(axis, 10.0), 0.5);
}

}  // namespace
}  // namespace comptonaut
