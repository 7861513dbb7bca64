// SPDX-License-Identifier: BSD-3-Clause
#include "sim/box_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace comptonaut {
namespace {

const Eigen::Vector3d kHalf_mm(7.04, 7.04, 1.0);

const std::vector<Eigen::Vector3d> kEyes_mm = {{0, 0, 3}, {20, 5, -2}, {9, 0, 0.5}, {-30, 40, 25}, {0, -8, 0}};

bool hits_box(const Eigen::Vector3d& eye, const Eigen::Vector3d& u) {
  double enter = 0.0, leave = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (-kHalf_mm[i] - eye[i]) / u[i], b = (kHalf_mm[i] - eye[i]) / u[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

TEST(BoxView, SolidAngleIsTheShareOfIsotropicLinesThatHit) {
  Random random(1);
  constexpr int kLines = 400'000;
  for (const Eigen::Vector3d& eye : kEyes_mm) {
    int hits = 0;
    for (int i = 0; i < kLines; ++i) hits += hits_box(eye, random.unit_vector());
    const double share = BoxView(kHalf_mm, eye).solid_angle() / (4.0 * std::numbers::pi);
    EXPECT_NEAR(hits, share * kLines, 4.0 * std::sqrt(share * kLines)) << eye.transpose();
  }
}

TEST(BoxView, FarAwaySolidAngleIsProjectedAreaOverDistanceSquared) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d u = random.unit_vector();
    const double r_mm = 20'000.0;
    const double area_mm2 =
        4.0 * (std::abs(u.x()) * kHalf_mm.y() * kHalf_mm.z() + std::abs(u.y()) * kHalf_mm.x() * kHalf_mm.z() +
               std::abs(u.z()) * kHalf_mm.x() * kHalf_mm.y());
    EXPECT_NEAR(BoxView(kHalf_mm, r_mm * u).solid_angle() * r_mm * r_mm / area_mm2, 1.0, 2e-3) << u.transpose();
  }
}

TEST(BoxView, SamplesLieOnFacesTurnedToTheEyeAndFlyAwayFromIt) {
  Random random(3);
  for (const Eigen::Vector3d& eye : kEyes_mm) {
    const BoxView view(kHalf_mm, eye);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = view.sample(random);
      EXPECT_NEAR(((ray.p - eye).normalized() - ray.direction).norm(), 0.0, 1e-12);
      EXPECT_NEAR((ray.p.cwiseAbs() - kHalf_mm).maxCoeff(), 0.0, 1e-12) << ray.p.transpose();
      EXPECT_TRUE(hits_box(eye, ray.direction)) << eye.transpose();
    }
  }
}

TEST(BoxView, SamplesAreIsotropicWithinTheSolidAngle) {
  // The mean direction of isotropic lines that hit is the same as that of the samples.
  Random random(4);
  for (const Eigen::Vector3d& eye : kEyes_mm) {
    const BoxView view(kHalf_mm, eye);
    Eigen::Vector3d wanted = Eigen::Vector3d::Zero(), sampled = Eigen::Vector3d::Zero();
    int n = 0;
    for (int i = 0; i < 400'000; ++i) {
      const Eigen::Vector3d u = random.unit_vector();
      if (!hits_box(eye, u)) continue;
      wanted += u;
      ++n;
    }
    for (int i = 0; i < n; ++i) sampled += view.sample(random).direction;
    EXPECT_LT((wanted - sampled).norm() / n, 5.0 / std::sqrt(n)) << eye.transpose();
  }
}

TEST(BoxView, AnEyeInsideSeesNothing) { EXPECT_EQ(BoxView(kHalf_mm, {1, 2, 0.5}).solid_angle(), 0.0); }

}  // namespace
}  // namespace comptonaut
