// SPDX-License-Identifier: BSD-3-Clause
#include "flight/envelope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace comptonaut {
namespace {

Eigen::Vector3d draw(Random& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

Eigen::Vector3d axes(const Envelope& e) { return {e.radius_m, e.radius_m, e.half_height_m}; }

/// Distance of a box from a point in units of the envelope: the nearest point of the box stays the nearest one when
/// the axes are scaled.
double in_envelopes(const Envelope& envelope, const Eigen::Vector3d& p_W, const Box& box) {
  const Eigen::Vector3d nearest = p_W.cwiseMax(box.min_W).cwiseMin(box.max_W);
  return (nearest - p_W).cwiseQuotient(axes(envelope)).norm();
}

/// The smallest of a function over the leg, by dense sampling.
template <class F>
double smallest_along(const Leg& leg, F&& f) {
  double smallest = 1e300;
  for (int i = 0; i <= 2000; ++i) smallest = std::min(smallest, f(leg.from_W + i / 2000.0 * (leg.to_W - leg.from_W)));
  return smallest;
}

// The two answers may differ only this near to a touch.
constexpr double kTouch = 0.01;

TEST(SweepMeetsBox, WhereverDenseSamplingSaysSo) {
  Random random(1);
  int hits = 0, misses = 0;
  for (int i = 0; i < 3000; ++i) {
    const Envelope envelope{random.uniform(0.2, 1.5), random.uniform(0.2, 3.0)};
    const Leg leg{draw(random, 4), i % 5 == 0 ? draw(random, 0.1) : draw(random, 4)};
    const Eigen::Vector3d corner = draw(random, 4);
    const Box box{corner, corner + (draw(random, 1.5).array() + 1.5).matrix()};
    const double nearest = smallest_along(leg, [&](const auto& p_W) { return in_envelopes(envelope, p_W, box); });
    if (std::abs(nearest - 1.0) < kTouch) continue;
    EXPECT_EQ(sweep_meets(envelope, leg, box), nearest < 1.0) << "case " << i << ", nearest " << nearest;
    ++(nearest < 1.0 ? hits : misses);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 300);
}

TEST(SweepMeetsBox, SeesVastGroundExactly) {
  const Box ground{{-1e6, -1e6, -1e6}, {1e6, 1e6, 0}};
  const Envelope envelope{0.5, 1.0};
  for (const double z : {0.5, 0.999, 1.0, 1.0005}) {
    EXPECT_TRUE(sweep_meets(envelope, {{-20, 3, z}, {30, 40, z}}, ground)) << z;
  }
  for (const double z : {1.002, 1.5, 9.0}) {
    EXPECT_FALSE(sweep_meets(envelope, {{-20, 3, z}, {30, 40, z}}, ground)) << z;
  }
  EXPECT_TRUE(sweep_meets(envelope, {{0, 0, 5}, {10, 0, 0.9}}, ground));
}

TEST(SweepMeetsLeg, WhereverDenseSamplingSaysSo) {
  Random random(2);
  int hits = 0, misses = 0;
  for (int i = 0; i < 1000; ++i) {
    const Envelope envelope{random.uniform(0.2, 1.5), random.uniform(0.2, 3.0)};
    const Leg a{draw(random, 4), draw(random, 4)};
    const Eigen::Vector3d start = draw(random, 4);
    const Leg b{start, i % 3 == 0 ? start : draw(random, 4)};
    const double nearest = smallest_along(a, [&](const Eigen::Vector3d& p_W) {
      const Eigen::Vector3d along = (b.to_W - b.from_W).cwiseQuotient(axes(envelope));
      const Eigen::Vector3d to_p = (p_W - b.from_W).cwiseQuotient(axes(envelope));
      const double f = along.norm() > 0 ? std::clamp(to_p.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
      return (to_p - f * along).norm();
    });
    if (std::abs(nearest - 1.0) < kTouch) continue;
    EXPECT_EQ(sweep_meets(envelope, a, b), nearest < 1.0) << "case " << i << ", nearest " << nearest;
    ++(nearest < 1.0 ? hits : misses);
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 100);
}

TEST(SweepBounds, HoldTheWholeSweepAndTouchIt) {
  const Envelope envelope{0.5, 1.0};
  const Box box = bounds(envelope, {{0, 0, 5}, {3, -4, 7}});
  EXPECT_TRUE(box.min_W.isApprox(Eigen::Vector3d(-0.5, -4.5, 4.0), kCollisionTolerance_m));
  EXPECT_TRUE(box.max_W.isApprox(Eigen::Vector3d(3.5, 0.5, 8.0), kCollisionTolerance_m));
}

}  // namespace
}  // namespace comptonaut
