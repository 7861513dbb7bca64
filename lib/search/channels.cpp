// SPDX-License-Identifier: BSD-3-Clause
#include "search/channels.h"

#include <algorithm>
#include <cmath>

#include "radiation/sight_lines.h"
#include "search/posterior.h"
#include "world/world.h"

namespace comptonaut {
namespace {

double singles_per_Bq_s(const LineFacts& line, double square_m2) {
  return line.single_response * std::exp(-line.attenuation_per_m * std::sqrt(square_m2)) / square_m2;
}

/// Share of the photons from a place that obstacles let through.
double let_through(const SearchState& state, const LineFacts& line, const Eigen::Vector3d& eye_W,
                   const Eigen::Vector3d& p_W) {
  if (state.world.is_flat()) return 1.0;
  return static_cast<double>(let_through(state.world, line.obstacles_per_m, p_W, eye_W));
}

Eigen::ArrayXXf singles_kernel(const CoarseGround& ground, const SearchState& state, const LineFacts& line,
                               double set_height_m) {
  const auto n = static_cast<Eigen::Index>(ground.size());
  Eigen::ArrayXXf kernel(n, n);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const Eigen::Vector3d from_W = ground.p_W(i) + set_height_m * Eigen::Vector3d::UnitZ();
    for (std::size_t j = 0; j < ground.size(); ++j) {
      const Eigen::Vector3d& p_W = ground.low_W(j);
      kernel(j, i) = static_cast<float>(singles_per_Bq_s(line, softened_m2(ground, from_W, p_W)) *
                                        let_through(state, line, from_W, p_W));
    }
  }
  return kernel;
}

/// Within kShared_m of a source of a channel's own nuclide its counts speak of no other: it may be one of the others,
/// taken for its own.
Eigen::ArrayXf speaks_of_others(const CoarseGround& ground, const SearchState& state, std::size_t channel) {
  Eigen::ArrayXf speaks = Eigen::ArrayXf::Ones(static_cast<Eigen::Index>(ground.size()));
  for (const SourceEstimate& source : state.sources) {
    if (channel_of(state.facts, source) != channel) continue;
    for (std::size_t j = 0; j < ground.size(); ++j) {
      const bool near = (source.p_W - ground.p_W(j)).head<2>().norm() < kShared_m;
      if (near) speaks(static_cast<Eigen::Index>(j)) = 0.0F;
    }
  }
  return speaks;
}

}  // namespace

double softened_m2(const CoarseGround& ground, const Eigen::Vector3d& eye_W, const Eigen::Vector3d& p_W) {
  return (p_W - eye_W).squaredNorm() + ground.edge_m() * ground.edge_m() / 6.0;
}

Kernels singles_kernels(const CoarseGround& ground, const SearchState& state, double set_height_m) {
  Kernels kernels;
  for (const ChannelFacts& channel : state.facts.channels) {
    std::vector<Eigen::ArrayXXf>& lines = kernels.emplace_back();
    for (const LineFacts& line : channel.lines) lines.push_back(singles_kernel(ground, state, line, set_height_m));
  }
  return kernels;
}

std::size_t channel_of(const SearchFacts& facts, const SourceEstimate& source) {
  const auto at = std::ranges::find(facts.channels, source.nuclide, &ChannelFacts::nuclide);
  return at == facts.channels.end() ? 0 : static_cast<std::size_t>(at - facts.channels.begin());
}

SourceRates source_rates(const CoarseGround& ground, const SearchState& state, std::size_t channel,
                         const Eigen::Vector3d& from_W, double background_per_s) {
  SourceRates rates{.of_source_per_s = {}, .all_per_s = background_per_s};
  for (const SourceEstimate& source : state.sources) {
    const std::size_t own = channel_of(state.facts, source);
    double per_s = 0.0;
    if (own >= channel) {
      const LineFacts& line = state.facts.channels[channel].lines[own - channel];
      per_s = source.activity_Bq * singles_per_Bq_s(line, softened_m2(ground, from_W, source.p_W)) *
              let_through(state, line, from_W, source.p_W);
    }
    rates.of_source_per_s.push_back(per_s);
    rates.all_per_s += per_s;
  }
  return rates;
}

double background_per_s(const SearchState& state, std::size_t channel, double configured_per_s) {
  constexpr double kLeast_per_s = 0.01;
  if (channel == 0 || channel >= state.looks.size() || state.looks[channel].empty()) return configured_per_s;
  double singles = 0.0, live_s = 0.0;
  for (const Look& look : state.looks[channel]) singles += look.background, live_s += look.live_s;
  return std::max(kLeast_per_s, singles / live_s);
}

std::vector<Evidence> evidence_of(const CoarseGround& ground, const Kernels& kernels, const SearchState& state,
                                  std::size_t nuclide) {
  const auto squares = static_cast<Eigen::Index>(ground.size());
  std::vector<Evidence> all = {
      {.channel = nuclide, .kernel = kernels[nuclide][0], .speaks = Eigen::ArrayXf::Ones(squares)}};
  for (std::size_t below = 0; below < nuclide; ++below) {
    all.push_back({.channel = below,
                   .kernel = kernels[below][nuclide - below],
                   .speaks = speaks_of_others(ground, state, below)});
  }
  return all;
}

}  // namespace comptonaut
