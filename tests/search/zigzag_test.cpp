// SPDX-License-Identifier: BSD-3-Clause
#include "search/zigzag.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "search/search_fixture.h"

namespace comptonaut {
namespace {

TEST(LaneCorners, NoPointOfTheStripIsFartherThanHalfALaneFromALane) {
  for (const double lane_m : {2.0, 4.0, 6.0, 7.3}) {
    for (const bool along_x : {false, true}) {
      const Area strip{10.0, 26.7, -5.0, 45.0};
      const auto corners = lane_corners(strip, lane_m, along_x);
      for (double x = strip.x_min_m; x <= strip.x_max_m; x += 0.5) {
        for (double y = strip.y_min_m + lane_m; y <= strip.y_max_m - lane_m; y += 0.5) {
          double nearest_m = 1e9;
          for (const auto& corner : corners) {
            nearest_m = std::min(nearest_m, std::abs(along_x ? corner.y() - y : corner.x() - x));
          }
          ASSERT_LE(nearest_m, 0.5 * lane_m + 1e-9) << x << ", " << y << " lane " << lane_m;
        }
      }
    }
  }
}

TEST(LaneCorners, LanesFollowOneAnotherWithoutDiagonals) {
  const auto corners = lane_corners({0, 17, 0, 50}, 2.0, false);
  EXPECT_EQ(corners.size(), 18u);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d leg = corners[i] - corners[i - 1];
    EXPECT_TRUE(std::abs(leg.x()) < 1e-9 || std::abs(leg.y()) < 1e-9) << "corner " << i;
    EXPECT_LE(std::abs(leg.x()), 2.0) << "corner " << i;
  }
}

TEST(Zigzag, FliesOverEveryCellWithinALaneAndThenBack) {
  Field field({0, 50, 0, 70});
  for (int mav = 1; mav <= 3; ++mav) field.add_mav(mav, 4.0 * mav, 0.0);
  Zigzag zigzag({.strategy = "zigzag"});
  std::vector<double> nearest_m(field.cells.size(), 1e9);
  const auto sweep = [&](int seconds) {
    std::fill(nearest_m.begin(), nearest_m.end(), 1e9);
    for (int t = 0; t < seconds; ++t) {
      field.fly(zigzag.plan(field.state()), 8.0, false);
      for (const Searcher& mav : field.mavs) {
        for (const Eigen::Vector3d& p_W : mav.track_W) {
          for (std::size_t j = 0; j < nearest_m.size(); ++j) {
            nearest_m[j] = std::min(nearest_m[j], (field.cells.p_W(j) - p_W).head<2>().norm());
          }
        }
      }
    }
    return *std::max_element(nearest_m.begin(), nearest_m.end());
  };
  EXPECT_LE(sweep(100), 1.5);  // 9 lanes of 70 m at 8 m/s, and the way to their beginning
  EXPECT_LE(sweep(170), 1.5);  // the rest of the way back, and forth again
}

TEST(Zigzag, EachMavKeepsToItsStripAndSetHeight) {
  Field field({0, 60, 0, 40});
  for (int mav = 1; mav <= 4; ++mav) field.add_mav(mav, 0.0, 10.0 * mav - 5.0);
  Zigzag zigzag({.strategy = "zigzag", .set_height_m = 3.0, .legs_ahead = 100});
  const auto courses = zigzag.plan(field.state());
  for (std::size_t i = 0; i < courses.size(); ++i) {
    ASSERT_FALSE(courses[i].points_W.empty());
    for (const Eigen::Vector3d& p_W : courses[i].points_W) {
      EXPECT_EQ(p_W.z(), 3.0);
      EXPECT_GE(p_W.y(), 10.0 * static_cast<double>(i)) << "MAV " << i + 1;
      EXPECT_LE(p_W.y(), 10.0 * static_cast<double>(i + 1)) << "MAV " << i + 1;
    }
  }
}

TEST(Zigzag, FollowsStepsOfTheGround) {
  std::vector<Cells::Cell> terrain;
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 30; ++y) {
      const double z_m = y >= 10 && y < 20 ? 4.0 : 0.0;
      terrain.push_back({.key = {x, y, static_cast<std::int32_t>(z_m) - 1}, .p_W = {x + 0.5, y + 0.5, z_m}});
    }
  }
  Field field({0, 10, 0, 30});
  field.cells = Cells(1.0, terrain);
  field.add_mav(1, 0, 0);
  Zigzag zigzag({.strategy = "zigzag", .set_height_m = 2.0, .legs_ahead = 100});
  const auto points_W = zigzag.plan(field.state()).front().points_W;
  bool low = false, high = false;
  for (const Eigen::Vector3d& p_W : points_W) {
    const bool over_step = p_W.y() >= 10.0 && p_W.y() < 20.0;
    EXPECT_EQ(p_W.z(), over_step ? 6.0 : 2.0) << p_W.transpose();
    (over_step ? high : low) = true;
  }
  EXPECT_TRUE(low && high);
}

}  // namespace
}  // namespace comptonaut
