// SPDX-License-Identifier: BSD-3-Clause
// The bound of several nuclides; of one, see joint_estimator_test.cpp.
#include "radiation/cramer_rao.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiation/joint_world.h"

namespace comptonaut {
namespace {

JointPhysics times(double factor) {
  std::vector<ResponseEntry> entries = toy_table().entries();
  for (ResponseEntry& entry : entries) entry.single *= factor, entry.pair *= factor;
  JointPhysics physics = toy_physics();
  physics.response = SmoothResponse(ResponseTable(std::move(entries)));
  return physics;
}

/// Singles alone, whose information does not depend on what is counted.
const JointConfig kSingles{.use_pairs = false};

/// Cs-137 and Co-60, which leaves `left` times as much in the channel of Cs-137.
std::vector<JointChannel> two_channels(double left, double known_rel_sigma = 0.1) {
  std::vector<JointChannel> channels = {{"Cs-137", kSingles, toy_physics()}, {"Co-60", kSingles, toy_physics()}};
  channels[0].config.known_rel_sigma = known_rel_sigma;
  channels[0].physics.of_others = {times(left)};
  return channels;
}

double bound_m(const std::vector<JointChannel>& channels, const std::vector<PointSource>& truth) {
  CramerRao bound(channels, truth, {1, 2});
  for (MeasurementBatch batch : ToyField{}.sweep(toy_physics(), 20.0, 2.0, 5)) {
    batch.channels.push_back({.nuclide = "Co-60"});
    bound.add(batch);
  }
  return bound.rmse_m();
}

const PointSource kCaesium{.p_W = {6, 7, 0}, .activity_Bq = 1e9, .nuclide = "Cs-137"};

PointSource cobalt(double x_m, double y_m) { return {.p_W = {x_m, y_m, 0}, .activity_Bq = 1e9, .nuclide = "Co-60"}; }

TEST(CramerRaoOfTwo, IsThatOfEachAloneWhereNeitherCountsInTheOthersChannel) {
  const PointSource other = cobalt(6.5, 7);
  const auto channels = two_channels(1e-12);
  const double alone_m = bound_m({{"Cs-137", kSingles, toy_physics()}}, {kCaesium});
  const double other_m = bound_m({{"Co-60", kSingles, toy_physics()}}, {other});
  EXPECT_NEAR(bound_m(channels, {kCaesium, other}), std::sqrt(0.5 * (alone_m * alone_m + other_m * other_m)), 1e-6);
  EXPECT_NEAR(bound_m(channels, {other, kCaesium}), bound_m(channels, {kCaesium, other}), 1e-9);
}

TEST(CramerRaoOfTwo, WhatIsLeftInTheLowerChannelHelpsTheUpperNuclideAndHarmsTheLower) {
  const PointSource other = cobalt(7.0, 7);
  const double one_m = bound_m(two_channels(1e-12), {other});
  EXPECT_LT(bound_m(two_channels(1.0), {other}), 0.9 * one_m) << "it is seen twice";
  // Of the lower one: the mean of squares without the upper one's part is at least what it is alone.
  double before_m2 = std::pow(bound_m(two_channels(1e-12), {kCaesium}), 2);
  for (const double x_m : {14.0, 9.0, 7.0}) {
    const double both_m2 = 2.0 * std::pow(bound_m(two_channels(1.0), {kCaesium, cobalt(x_m, 7)}), 2);
    const double lower_m2 = both_m2 - std::pow(bound_m(two_channels(1.0), {cobalt(x_m, 7)}), 2);
    EXPECT_GT(lower_m2, before_m2) << x_m;
    before_m2 = lower_m2;
  }
}

TEST(CramerRaoOfTwo, FarApartIsThatOfEachAlone) {
  const auto channels = two_channels(1.0);
  const double alone_m = bound_m(channels, {kCaesium}), other_m = bound_m(channels, {cobalt(18, 15)});
  const double both_m = bound_m(channels, {kCaesium, cobalt(18, 15)});
  const double apart_m = std::sqrt(0.5 * (alone_m * alone_m + other_m * other_m));
  EXPECT_GT(both_m, apart_m) << "each is some background of the other";
  EXPECT_LT(both_m, 1.1 * apart_m);
}

TEST(CramerRaoOfTwo, TheBetterItIsKnownWhatIsLeftTheLowerTheBound) {
  double before_m = 1e9;
  for (const double rel_sigma : {1.0, 0.1, 0.01}) {
    const double m = bound_m(two_channels(1.0, rel_sigma), {kCaesium, cobalt(7, 7)});
    EXPECT_LT(m, before_m) << rel_sigma;
    before_m = m;
  }
}

}  // namespace
}  // namespace comptonaut
