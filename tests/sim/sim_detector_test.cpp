// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/sim_world.h"
#include "test_camera.h"

namespace comptonaut {
namespace {

constexpr double kStep_s = 0.01;

const SimCamera& camera() {
  static const SimCamera shared = test_camera();
  return shared;
}

Scenario ideal() {
  Scenario scenario = idealised({});
  scenario.background_singles_per_s = 0.0;
  scenario.mavs.start_W = {{1, 1}, {4, 1}, {7, 1}};
  return scenario;
}

Eigen::Isometry3d hovering(const Eigen::Vector3d& p_WB) { return Eigen::Isometry3d(Eigen::Translation3d(p_WB)); }

std::string run(SimDetector& detector, const Eigen::Isometry3d& X_WB, int steps) {
  std::string text;
  for (int i = 0; i < steps; ++i) text += detector.step(X_WB, i * kStep_s, kStep_s);
  return text;
}

std::size_t rows(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') - std::count(text.begin(), text.end(), '#');
}

TEST(SimDetector, PhotonsThatInteractAreThoseThatPassTheBlockTimesTheirChance) {
  // Straight below, the block covers 14.08^2 mm^2 and is 2 mm thick.
  constexpr double kDistance_m = 3.0, kActivity_Bq = 2e9, kDuration_s = 2.0;
  const Scenario scenario = ideal();
  SimDetector detector(camera(), scenario, {{.p_W = {0, 0, 0}, .photons_per_s = kActivity_Bq}}, 1, 1);
  (void)run(detector, hovering({0, 0, kDistance_m + 0.05}), static_cast<int>(kDuration_s / kStep_s));
  const double mu_per_m = load_cdte().attenuation_per_m(camera().channel.line_keV).total();
  const double solid_angle_sr = 14.08e-3 * 14.08e-3 / ((kDistance_m - 0.001) * (kDistance_m - 0.001));
  const double expected = kActivity_Bq * kDuration_s * solid_angle_sr / (4.0 * std::numbers::pi) *
                          std::exp(-scenario.air_attenuation_per_m * kDistance_m) * (1.0 - std::exp(-mu_per_m * 2e-3));
  // Coherent scattering (a few percent of the total) leaves no energy.
  EXPECT_LT(static_cast<double>(detector.photons()), expected + 4.0 * std::sqrt(expected));
  EXPECT_GT(static_cast<double>(detector.photons()), 0.92 * expected);
}

TEST(SimDetector, PhotonsFallWithTheSquareOfDistanceAndWithAir) {
  Scenario scenario = ideal();
  scenario.air_attenuation_per_m = 0.1;
  const std::vector<Emitter> near = {{.p_W = {0, 0, 0}, .photons_per_s = 1e9}};
  const std::vector<Emitter> far = {{.p_W = {0, 0, -6}, .photons_per_s = 1e9}};
  SimDetector close(camera(), scenario, near, 1, 1), distant(camera(), scenario, far, 1, 1);
  (void)run(close, hovering({0, 0, 2.05}), 300);
  (void)run(distant, hovering({0, 0, 2.05}), 300);
  const double ratio = 16.0 * std::exp(0.6), photons = static_cast<double>(distant.photons());
  EXPECT_NEAR(static_cast<double>(close.photons()) / photons / ratio, 1.0, 4.0 / std::sqrt(photons));
}

TEST(SimDetector, BackgroundComesAtItsRate) {
  Scenario scenario = ideal();
  scenario.background_singles_per_s = 800.0;
  SimDetector detector(camera(), scenario, {}, 1, 1);
  EXPECT_GT(rows(run(detector, hovering({0, 0, 2}), 100)), 800u);
  EXPECT_EQ(detector.photons(), 0);
}

TEST(SimDetector, DeadTimeLosesTheShareThatItShould) {
  // Rate r behind a dead time tau: r / (1 + r tau) events are left.
  Scenario scenario = ideal();
  scenario.background_singles_per_s = 2000.0;
  SimDetector open(camera(), scenario, {}, 1, 1);
  scenario.mismatch.dead_time_us = 400.0;
  SimDetector dead(camera(), scenario, {}, 1, 1);
  const auto all = static_cast<double>(rows(run(open, hovering({0, 0, 2}), 300)));
  const auto left = static_cast<double>(rows(run(dead, hovering({0, 0, 2}), 300)));
  EXPECT_NEAR(left / all, 1.0 / (1.0 + 2000.0 / 0.8 * 400e-6), 0.03);
}

TEST(SimDetector, ScatterAddsItsShareOfEventsWithoutChangingThePhotons) {
  Scenario scenario = ideal();
  const std::vector<Emitter> source = {{.p_W = {0, 0, 0}, .photons_per_s = 2e9}};
  SimDetector bare(camera(), scenario, source, 1, 1);
  scenario.mismatch.scatter_share = 0.5;
  SimDetector scattered(camera(), scenario, source, 1, 1);
  const std::size_t few = rows(run(bare, hovering({0, 0, 2}), 30));
  const std::size_t many = rows(run(scattered, hovering({0, 0, 2}), 30));
  EXPECT_EQ(bare.photons(), scattered.photons());
  EXPECT_GT(many, few + few / 10);
}

TEST(SimDetector, BackgroundGrowsSteadilyToItsDriftAtTheHorizon) {
  Scenario scenario = ideal();
  scenario.horizon_s = 8.0;
  scenario.background_singles_per_s = 2000.0;
  scenario.mismatch.background_drift = 4.0;
  SimDetector detector(camera(), scenario, {}, 1, 1);
  auto until = [&, i = 0](double t_s) mutable {
    std::size_t events = 0;
    for (; i * kStep_s < t_s - 1e-9; ++i) events += rows(detector.step(hovering({0, 0, 2}), i * kStep_s, kStep_s));
    return static_cast<double>(events);
  };
  const double first = until(2.0), second = until(4.0), third = until(6.0), fourth = until(8.0);
  for (const double ratio : {second / first, third / second, fourth / third}) EXPECT_NEAR(ratio, std::sqrt(2.0), 0.06);
}

TEST(SimDetector, StrayPhotonsStandInForDirectOnes) {
  Scenario scenario = ideal();
  const std::vector<Emitter> source = {{.p_W = {0, 0, 0}, .photons_per_s = 2e9}};
  SimDetector bare(camera(), scenario, source, 1, 1);
  scenario.mismatch.stray_share = 1.0;
  SimDetector stray(camera(), scenario, source, 1, 1);
  (void)run(bare, hovering({0, 0, 2.05}), 400);
  (void)run(stray, hovering({0, 0, 2.05}), 400);
  // A few percent less for what the block itself takes. From all directions the way through the thin block is longer:
  // its mean chord is 4 V / S [Cauchy], the thickness V / A.
  const double half_mm = 7.04, thick_mm = 2.0, face_mm2 = 4.0 * half_mm * half_mm;
  const double surface_mm2 = 2.0 * face_mm2 + 8.0 * half_mm * thick_mm;
  const double longer = 4.0 * face_mm2 / surface_mm2;
  EXPECT_NEAR(static_cast<double>(stray.photons()) / static_cast<double>(bare.photons()), longer, 0.12);
}

std::vector<std::string> world_text(std::uint64_t seed, int mavs) {
  Scenario scenario;
  scenario.mavs.count = mavs;
  scenario.mavs.start_W = {{1, 1}, {4, 1}, {7, 1}};
  scenario.draw.activities_Bq = {2e9, 2e9};
  SimWorld world(camera(), scenario, seed, 0);
  std::vector<std::string> text(mavs);
  for (int i = 0; i < 200; ++i) {
    const std::vector<std::string> hits = world.step();
    for (int mav = 0; mav < mavs; ++mav) text[mav] += hits[mav];
  }
  return text;
}

TEST(SimWorld, TheSameSeedGivesTheSameStreamsAndAnotherOneOthers) {
  const auto first = world_text(1, 3), again = world_text(1, 3), other = world_text(2, 3);
  EXPECT_EQ(first, again);
  for (int mav = 0; mav < 3; ++mav) {
    EXPECT_NE(first[mav], other[mav]);
    EXPECT_NE(first[mav], first[(mav + 1) % 3]);
  }
}

TEST(SimWorld, WhatAMavMeasuresDoesNotDependOnTheOthers) { EXPECT_EQ(world_text(1, 3)[0], world_text(1, 1)[0]); }

TEST(SimWorld, TellsItsTruth) {
  Scenario scenario = ideal();
  scenario.name = "a";
  scenario.sources = {{"Cs-137", {10, 20, 0}, 2e9}};
  SimWorld world(camera(), scenario, 1, 5 * kSecond_us);
  for (int i = 0; i < 100; ++i) (void)world.step();
  const Truth truth = world.truth();
  EXPECT_EQ(truth.scenario, "a");
  EXPECT_EQ(truth.start_utime, 5 * kSecond_us);
  EXPECT_EQ(truth.utime, 6 * kSecond_us);
  ASSERT_EQ(truth.sources.size(), 1u);
  ASSERT_EQ(truth.mavs.size(), 3u);
  EXPECT_LT((truth.mavs[1].p_WB - Eigen::Vector3d(4, 1, 2)).norm(), 1e-9);
  EXPECT_GT(truth.mavs[0].photons, 0);
  EXPECT_NEAR(world.distance_min_m(), 3.0, 1e-9);
}

}  // namespace
}  // namespace comptonaut
