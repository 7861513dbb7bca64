// SPDX-License-Identifier: BSD-3-Clause
#include "search/channels.h"

#include <gtest/gtest.h>

#include "search/outlook.h"
#include "search/posterior.h"

namespace comptonaut {
namespace {

/// Cs-137 and Co-60, which leaves so many singles in the channel of Cs-137, per decay at 1 m.
SearchFacts two_nuclides(double left, double cobalt = 1e-6) {
  SearchFacts facts;
  facts.channels = {{.nuclide = "Cs-137", .lines = {{}, {.single_response = left}}},
                    {.nuclide = "Co-60", .lines = {{.single_response = cobalt}}}};
  return facts;
}

/// A field's questions after `live_s` above each square; none is left out as answered.
struct Asked {
  explicit Asked(const SearchFacts& facts, const std::vector<SourceEstimate>& sources = {}, float live_s = 1e-4F,
                 const std::vector<std::vector<Look>>& looks = {})
      : field({0, 50, 0, 50}), ground(field.cells, 2.5, 1600) {
    SearchState state = field.state();
    state.facts = facts;
    state.sources = sources;
    state.looks = looks;
    squares = static_cast<Eigen::Index>(ground.size());
    prospect = make_prospect(ground, singles_kernels(ground, state, 2.0), state, information_config(),
                             Eigen::ArrayXf::Constant(squares, live_s), hover_places(ground, state.world, {}, 2.0));
  }
  [[nodiscard]] Eigen::Index at(double x_m, double y_m) const {
    return static_cast<Eigen::Index>(ground.at({x_m, y_m, 0.0}));
  }

  Field field;
  CoarseGround ground;
  Eigen::Index squares = 0;
  Prospect prospect;
};

constexpr Eigen::Index kLevels = 3;

TEST(Channels, NuclidesThatLeaveNothingInEachOthersChannelsAreAskedForAlike) {
  const Asked one{SearchFacts{}}, two(two_nuclides(0.0));
  const Eigen::Index n = kLevels * one.squares;
  ASSERT_EQ(one.prospect.weight.size(), n);
  ASSERT_EQ(two.prospect.weight.size(), 2 * n);
  for (const Eigen::Index first : {Eigen::Index{0}, n}) {
    EXPECT_TRUE(two.prospect.per_s.middleRows(first, n).isApprox(one.prospect.per_s, 1e-5F)) << first;
  }
  EXPECT_NEAR(two.prospect.weight.sum() / one.prospect.weight.sum(), 1.0F, 0.15F) << "all ground together weighs 1";
  EXPECT_TRUE((two.prospect.weight.head(n) == two.prospect.weight.tail(n)).all());
}

TEST(Channels, AKnownSourceHidesNoneOfAnotherNuclideBesideIt) {
  const SourceEstimate caesium = source_at(25.5, 25, 2e9, 0.01);
  const Asked without(two_nuclides(0.0)), with(two_nuclides(0.0), {caesium});
  const Eigen::Index upper = kLevels * without.squares, j = without.at(25, 25);
  // Of Cs-137 nothing is asked any more in some squares beside it.
  const Eigen::Index left_out = without.prospect.weight.size() + 1 - with.prospect.weight.size();  // and a visit is
  ASSERT_GT(left_out, 0);
  EXPECT_EQ(left_out % kLevels, 0);
  const Eigen::Index moved = upper - left_out + j;
  EXPECT_EQ(with.prospect.weight(moved), without.prospect.weight(upper + j));
  EXPECT_EQ(with.prospect.per_s(moved, j), without.prospect.per_s(upper + j, j));
}

TEST(Channels, ASourceOfTheUpperLineIsBackgroundInTheLowerChannelAndNotTheOtherWayRound) {
  Field field({0, 50, 0, 50});
  const CoarseGround ground(field.cells, 2.5, 1600);
  SourceEstimate cobalt = source_at(25, 25, 1e9, 0.1), caesium = source_at(25, 25, 1e9, 0.1);
  cobalt.nuclide = "Co-60";
  const std::vector<SourceEstimate> sources = {caesium, cobalt};
  SearchState state = field.state();
  state.facts = two_nuclides(3e-6, 2e-7);
  state.sources = sources;
  const SourceRates low = source_rates(ground, state, 0, {25, 25, 2}, 3.0);
  const SourceRates high = source_rates(ground, state, 1, {25, 25, 2}, 0.1);
  EXPECT_NEAR(low.of_source_per_s[1], 3.0 * low.of_source_per_s[0], 1e-9);
  EXPECT_NEAR(low.all_per_s, 3.0 + low.of_source_per_s[0] + low.of_source_per_s[1], 1e-9);
  EXPECT_EQ(high.of_source_per_s[0], 0.0);
  EXPECT_NEAR(high.of_source_per_s[1], 0.2 * low.of_source_per_s[0], 1e-9);
  EXPECT_NEAR(high.all_per_s, 0.1 + high.of_source_per_s[1], 1e-9);
}

/// Nothing but what was expected, above every square.
std::vector<std::vector<Look>> quiet(const Asked& asked) {
  std::vector<std::vector<Look>> looks(2);
  for (std::size_t i = 0; i < asked.ground.size(); ++i) {
    const Eigen::Vector3d p_WD = asked.ground.p_W(i) + 2.0 * Eigen::Vector3d::UnitZ();
    looks[0].push_back({.p_WD = p_WD, .live_s = 0.1, .singles = 0.3, .expected = 0.3, .background = 0.3});
    looks[1].push_back({.p_WD = p_WD, .live_s = 0.1, .singles = 0.01, .expected = 0.01, .background = 0.01});
  }
  return looks;
}

TEST(Channels, WhatTheLowerChannelDoesNotSeeIsNotThere) {
  const SearchFacts deaf = two_nuclides(0.0, 1e-8), hears = two_nuclides(1e-6, 1e-8);
  const Asked fresh(deaf);
  const auto looks = quiet(fresh);
  const Asked own(deaf, {}, 1e-4F, looks), both(hears, {}, 1e-4F, looks);
  const Eigen::Index upper = kLevels * own.squares, j = own.at(25, 25);
  EXPECT_LT(both.prospect.weight(upper + j), 0.5F * own.prospect.weight(upper + j));
  EXPECT_GT(both.prospect.per_s(upper + j, j), 5.0F * own.prospect.per_s(upper + j, j));
}

TEST(Channels, BesideASourceOfItsOwnTheLowerChannelSaysNothingOfTheUpperNuclide) {
  Field field({0, 50, 0, 50});
  const CoarseGround ground(field.cells, 2.5, 1600);
  const std::vector<SourceEstimate> sources = {source_at(25, 25, 1e9, 0.1)};
  SearchState state = field.state();
  state.facts = two_nuclides(1e-6);
  state.sources = sources;
  const Kernels kernels = singles_kernels(ground, state, 2.0);
  EXPECT_EQ(evidence_of(ground, kernels, state, 0).size(), 1U);
  const auto evidence = evidence_of(ground, kernels, state, 1);
  ASSERT_EQ(evidence.size(), 2U);
  EXPECT_TRUE((evidence[0].speaks == 1.0F).all());
  for (std::size_t j = 0; j < ground.size(); ++j) {
    const bool near = (ground.p_W(j) - sources[0].p_W).head<2>().norm() < kShared_m;
    EXPECT_EQ(evidence[1].speaks(static_cast<Eigen::Index>(j)), near ? 0.0F : 1.0F) << ground.p_W(j).transpose();
  }
}

TEST(Channels, BackgroundIsAsConfiguredInTheFirstAndAsFoundInTheOthers) {
  const Asked asked(two_nuclides(0.0));
  const auto looks = quiet(asked);
  SearchState state = asked.field.state();
  EXPECT_EQ(background_per_s(state, 1, 2.0), 2.0) << "nobody tells";
  state.looks = looks;
  EXPECT_EQ(background_per_s(state, 0, 2.0), 2.0);
  EXPECT_NEAR(background_per_s(state, 1, 2.0), 0.1, 1e-9);
}

TEST(Channels, TheGroundIsClearOnlyWhereItIsClearOfEachNuclide) {
  for (const double cobalt : {1e-6, 1e-10}) {
    EXPECT_TRUE(Asked(SearchFacts{}, {}, 3.0F).prospect.all_clear);
    EXPECT_EQ(Asked(two_nuclides(0.0, cobalt), {}, 3.0F).prospect.all_clear, cobalt == 1e-6) << cobalt;
  }
}

}  // namespace
}  // namespace comptonaut
