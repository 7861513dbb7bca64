// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/sight_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/random.h"
#include "radiation/joint_data.h"
#include "radiation/response_column.h"
#include "radiation/sensitivity.h"
#include "toy_response.h"

namespace comptonaut {
namespace {

constexpr double kPer_m = 1.5;

/// Two houses and a thin wall.
World town() {
  const std::vector<Box> boxes = {{{4, 4, 0}, {8, 7, 3}}, {{-6, -3, 0}, {-2, 5, 5}}, {{0, -6, 0}, {0.5, 6, 2}}};
  return World::of_boxes(boxes, {{-15, -15, -1}, {15, 15, 10}}, 0.5);
}

/// The slow way: mu of what lies in the middle of each of many short steps.
double sampled(const World& world, const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W) {
  constexpr int kSteps = 2000;
  int occupied = 0;
  for (int i = 0; i < kSteps; ++i) {
    occupied += world.at(a_W + (i + 0.5) / kSteps * (b_W - a_W)) == Occupancy::kOccupied ? 1 : 0;
  }
  return std::exp(-kPer_m * occupied * (b_W - a_W).norm() / kSteps);
}

JointData random_views(std::uint64_t seed, std::size_t viewpoints, std::size_t pairs) {
  Random random(seed);
  JointData data;
  data.senders = {1};
  data.live_s = {1.0};
  data.R_ND = {Eigen::Matrix3d::Identity()};
  for (std::size_t i = 0; i < viewpoints; ++i) {
    data.viewpoints.x_m.push_back(random.uniform(-14, 14));
    data.viewpoints.y_m.push_back(random.uniform(-14, 14));
    data.viewpoints.z_m.push_back(random.uniform(5.5, 8));
    for (int k = 0; k < 9; ++k) data.viewpoints.R_DW[k].push_back(k % 4 == 0 ? 1.0 : 0.0);
    data.viewpoints.live_s.push_back(0.05);
    data.viewpoints.singles.push_back(0.0);
    data.viewpoints.drone.push_back(0);
    data.viewpoints.utime.push_back(0);
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    data.pairs.push_back({.p_WS = {random.uniform(-14, 14), random.uniform(-14, 14), 6.0},
                          .R_DW = Eigen::Matrix3d::Identity(),
                          .hypotheses = {{.axis_W = random.unit_vector(), .beta_rad = 1.0, .weight = 1.0}}});
  }
  return data;
}

void append(const JointData& more, JointData& data) {
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join(data.viewpoints.x_m, more.viewpoints.x_m), join(data.viewpoints.y_m, more.viewpoints.y_m);
  join(data.viewpoints.z_m, more.viewpoints.z_m), join(data.viewpoints.live_s, more.viewpoints.live_s);
  for (int k = 0; k < 9; ++k) join(data.viewpoints.R_DW[k], more.viewpoints.R_DW[k]);
  join(data.viewpoints.singles, more.viewpoints.singles), join(data.viewpoints.drone, more.viewpoints.drone);
  join(data.viewpoints.utime, more.viewpoints.utime), join(data.pairs, more.pairs);
}

TEST(LetThrough, IsWhatDenseSamplesAlongTheRaySay) {
  const World world = town();
  Random random(3);
  int shadowed = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d a_W(random.uniform(-14, 14), random.uniform(-14, 14), random.uniform(0, 9));
    const Eigen::Vector3d b_W(random.uniform(-14, 14), random.uniform(-14, 14), random.uniform(0, 9));
    const double expected = sampled(world, a_W, b_W);
    EXPECT_NEAR(let_through(world, kPer_m, a_W, b_W), expected, 0.06 * expected + 1e-8) << i;
    shadowed += expected < 0.9 ? 1 : 0;
  }
  EXPECT_GT(shadowed, 50);
  EXPECT_EQ(let_through(world, 0.0, {-10, 0, 1}, {10, 0, 1}), 1.0F);
}

TEST(SightLines, AtTheLatticesCornersAreTheRays) {
  const World world = town();
  const JointData data = random_views(1, 200, 20);
  SightLines sight(world);
  for (const Eigen::Vector3d& p_W :
       {Eigen::Vector3d(2, 2, 0), Eigen::Vector3d(-1.5, 0.5, 0), Eigen::Vector3d(6, 5.5, 3)}) {
    const SightLines::Shares shares = sight.shares(data, kPer_m, p_W);
    for (std::size_t i = 0; i < 200; ++i) {
      const Viewpoints& v = data.viewpoints;
      const double expected = sampled(world, p_W, {v.x_m[i], v.y_m[i], v.z_m[i]});
      EXPECT_NEAR(shares.viewpoints[i], expected, 0.05 * expected + 1e-8) << i;
    }
    for (std::size_t i = 0; i < 20; ++i) {
      const double expected = sampled(world, p_W, data.pairs[i].p_WS);
      EXPECT_NEAR(shares.pairs[i], expected, 0.05 * expected + 1e-8) << i;
    }
  }
}

TEST(SightLines, BetweenCornersChangeSteadilyAndStayNearTheRays) {
  const World world = town();
  const JointData data = random_views(2, 300, 0);
  SightLines sight(world);
  double away = 0.0;
  for (int step = 0; step < 25; ++step) {
    const Eigen::Vector3d p_W(1.01 + 0.08 * step, 1.7, 0);
    const auto here = sight.shares(data, kPer_m, p_W),
               beside = sight.shares(data, kPer_m, p_W + Eigen::Vector3d(1e-4, 0, 0));
    for (std::size_t i = 0; i < 300; ++i) {
      EXPECT_NEAR(here.viewpoints[i], beside.viewpoints[i], 2.1e-4);  // at most 1 over an edge of 0.5 m
      const Viewpoints& v = data.viewpoints;
      away += std::abs(here.viewpoints[i] - sampled(world, p_W, {v.x_m[i], v.y_m[i], v.z_m[i]})) / (25 * 300);
    }
  }
  EXPECT_LT(away, 0.02);
}

TEST(SightLines, DoNotDependOnWhatWasAskedBefore) {
  const World world = town();
  JointData data = random_views(3, 100, 10);
  SightLines asked(world);
  Random random(4);
  const auto place = [&] { return Eigen::Vector3d(random.uniform(-10, 10), random.uniform(-10, 10), 0.3); };
  for (int i = 0; i < 50; ++i) (void)asked.shares(data, kPer_m, place());
  append(random_views(5, 70, 7), data);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p_W = place();
    const auto now = asked.shares(data, kPer_m, p_W), fresh = SightLines(world).shares(data, kPer_m, p_W);
    EXPECT_EQ(now.viewpoints, fresh.viewpoints);
    EXPECT_EQ(now.pairs, fresh.pairs);
    EXPECT_NE(now.viewpoints, asked.shares(data, 2.0 * kPer_m, p_W).viewpoints);
  }
}

TEST(BlockSight, SeesFromTheMiddleOfTheEyesBlock) {
  const World world = town();
  const std::vector<Eigen::Vector3d> places_W = {{2, 2, 0}, {-9, 1, 0}, {6, 5, 3}};
  BlockSight sight(world, kPer_m);
  for (int x = -14; x < 14; ++x) {
    const Eigen::Vector3d eye_W(x + 0.2, 0.7, 2.9);
    const auto shares = sight.shares(eye_W, places_W);
    for (std::size_t j = 0; j < places_W.size(); ++j) {
      EXPECT_EQ(shares[j], let_through(world, kPer_m, places_W[j], {x + 0.5, 0.5, 2.5})) << x << ' ' << j;
    }
  }
}

}  // namespace
}  // namespace comptonaut
