// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_projection.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "core/random.h"

namespace comptonaut {
namespace {

TEST(MapProjection, ForwardAndBackAreAdjoint) {
  Random random(37);
  std::vector<float> row(48);
  std::vector<double> x(48), u(48, 0.0);
  for (std::size_t k = 0; k < 48; ++k) {
    row[k] = static_cast<float>(random.uniform());
    x[k] = random.normal();
  }
  row_spread(row.data(), 0.7, u.data(), 48, row.data());
  EXPECT_NEAR(0.7 * row_dot(row.data(), x.data(), 48), std::inner_product(x.begin(), x.end(), u.begin(), 0.0), 1e-12);
}

}  // namespace
}  // namespace comptonaut
