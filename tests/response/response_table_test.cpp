// SPDX-License-Identifier: BSD-3-Clause
#include "response/response_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/random.h"
#include "response/response_grid.h"

namespace comptonaut {
namespace {

/// Slow and obvious.
std::size_t nearest_entry(const std::vector<ResponseEntry>& entries, const Eigen::Vector3d& u_D) {
  std::size_t best = 0;
  double best_cosine = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double cosine = direction_D(entries[i].phi_rad, entries[i].theta_rad).dot(u_D);
    if (cosine > best_cosine) best = i;
    best_cosine = std::max(cosine, best_cosine);
  }
  return best;
}

TEST(ResponseTable, FindsTheNearestEntryEverywhere) {
  Random random(1);
  for (const int step_deg : {5, 10, 45, 90}) {
    const ResponseTable table(response_grid(step_deg));
    for (int i = 0; i < 20'000; ++i) {
      const Eigen::Vector3d u_D = random.unit_vector();
      const std::size_t expected = nearest_entry(table.entries(), u_D);
      ASSERT_EQ(table.nearest(u_D), expected) << "step " << step_deg << ", u " << u_D.transpose();
      ASSERT_EQ(table.nearest(7.5 * u_D), expected) << "length does not matter";
      ASSERT_EQ(table.single(u_D), table.entries()[expected].single);
      ASSERT_EQ(table.pair(u_D), table.entries()[expected].pair);
    }
  }
}

// Corners, edges and folds of the octahedron: whatever is found is as near as the nearest.
TEST(ResponseTable, FindsTheNearestEntryAtCornersAndFolds) {
  const ResponseTable table(response_grid(10));
  Random random(2);
  for (int code = 0; code < 27; ++code) {
    const Eigen::Vector3d corner(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    if (corner.isZero()) continue;
    for (const double scale : {0.0, 1e-9, 1e-3, 1e-2}) {
      const Eigen::Vector3d u_D = corner.normalized() + scale * random.unit_vector();
      const auto cosine_of = [&](std::size_t i) {
        return direction_D(table.entries()[i].phi_rad, table.entries()[i].theta_rad).dot(u_D);
      };
      EXPECT_NEAR(cosine_of(table.nearest(u_D)), cosine_of(nearest_entry(table.entries(), u_D)), 1e-12)
          << u_D.transpose();
    }
  }
}

TEST(ResponseTable, OfOneEntryIsThatEntry) {
  const ResponseTable table({{.single = 3e-6, .pair = 2e-8}});
  EXPECT_EQ(table.single(-Eigen::Vector3d::UnitZ()), 3e-6);
  EXPECT_EQ(table.pair(Eigen::Vector3d::UnitX()), 2e-8);
}

TEST(ResponseTable, RefusesWhatIsNoTable) {
  EXPECT_THROW(ResponseTable(std::vector<ResponseEntry>{}), std::invalid_argument);
  EXPECT_THROW(ResponseTable(std::vector<ResponseEntry>(20'001)), std::invalid_argument);
  EXPECT_THROW(ResponseTable(std::vector<ResponseEntry>(1000)), std::invalid_argument) << "all in one place";
  const auto refused = [](const ResponseEntry& entry) { EXPECT_THROW(ResponseTable({entry}), std::invalid_argument); };
  for (const double wrong : {-1e-9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    refused({.single = wrong});
    refused({.pair = wrong});
    refused({.theta_rad = wrong});
  }
  refused({.phi_rad = 7.0});
  refused({.theta_rad = 3.2});
}

}  // namespace
}  // namespace comptonaut
