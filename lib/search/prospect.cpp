// SPDX-License-Identifier: BSD-3-Clause
#include "search/prospect.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiation/sight_lines.h"
#include "search/courses.h"
#include "search/posterior.h"
#include "world/world.h"

namespace comptonaut {
namespace {

double singles_per_Bq_s(const SearchState& state, double square_m2) {
  return state.facts.single_response * std::exp(-state.facts.attenuation_per_m * std::sqrt(square_m2)) / square_m2;
}

/// Share of the photons from a place that obstacles let through.
double let_through(const SearchState& state, const Eigen::Vector3d& eye_W, const Eigen::Vector3d& p_W) {
  if (state.world.is_flat()) return 1.0;
  return static_cast<double>(let_through(state.world, state.facts.obstacles_per_m, p_W, eye_W));
}

Eigen::Vector3d eye_W(const CoarseGround& ground, std::size_t i, double set_height_m) {
  return ground.p_W(i) + set_height_m * Eigen::Vector3d::UnitZ();
}

/// Squared distance to a place somewhere in a square: its mean over both squares is a bit more.
double softened_m2(const CoarseGround& ground, const Eigen::Vector3d& eye_W, const Eigen::Vector3d& p_W) {
  return (p_W - eye_W).squaredNorm() + ground.edge_m() * ground.edge_m() / 6.0;
}

std::vector<double> activities_Bq(const SearchState& state, int n) {
  std::vector<double> result;
  for (int k = 0; k < n; ++k) {
    const double share = n > 1 ? static_cast<double>(k) / (n - 1) : 0.0;
    result.push_back(state.facts.activity_min_Bq *
                     std::pow(state.facts.activity_max_Bq / state.facts.activity_min_Bq, share));
  }
  return result;
}

/// Mean variance along x and y, m^2; of a source without: as if it were known to some metres.
double variance_m2(const SourceEstimate& source) {
  constexpr double kUnknown_m2 = 4.0;
  const double sum = source.position_sigma_m.head<2>().squaredNorm();
  return std::isfinite(sum) ? std::clamp(0.5 * sum, 1e-6, 1e6) : kUnknown_m2;
}

bool beside_source(const SearchState& state, const Eigen::Vector3d& p_W, double reach_m) {
  return std::any_of(state.sources.begin(), state.sources.end(),
                     [&](const SourceEstimate& source) { return (source.p_W - p_W).head<2>().norm() < reach_m; });
}

/// Where the questions stand: of each activity all squares, then each source's position, then a visit to each.
struct Layout {
  Eigen::Index squares = 0, levels = 0, sources = 0;

  [[nodiscard]] Eigen::Index positions() const { return squares * levels; }
  [[nodiscard]] Eigen::Index visits() const { return positions() + sources; }
  [[nodiscard]] Eigen::Index questions() const { return visits() + sources; }
};

std::vector<bool> flyable_squares(const CoarseGround& ground, const SearchState& state, const SearchConfig& config) {
  const Fence fence = with_keep_out(state, config).route.fence;
  std::vector<bool> flyable;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const Eigen::Vector3d p_W = eye_W(ground, i, config.set_height_m);
    flyable.push_back(fence.contains(p_W) && !state.world.closed(p_W));
  }
  return flyable;
}

/// A second at this distance from above a source, as a share of a visit.
double visit_per_s(const InformationConfig& information, double away_m) {
  const double share = away_m / information.visit_distance_m;
  return std::exp(-0.5 * share * share) / information.visit_s;
}

/// Fills in what a second at from_W tells of the sources; the rate of singles there.
double look_at_sources(Eigen::Ref<Eigen::ArrayXf> per_s, const Layout& layout, const SearchState& state,
                       const InformationConfig& information, const Eigen::Vector3d& from_W,
                       const CoarseGround& ground) {
  const auto square_m2 = [&](const SourceEstimate& source) { return softened_m2(ground, from_W, source.p_W); };
  std::vector<double> counts;
  double rate = information.background_singles_per_s;
  for (const SourceEstimate& source : state.sources) {
    counts.push_back(source.activity_Bq * singles_per_Bq_s(state, square_m2(source)) *
                     let_through(state, from_W, source.p_W));
    rate += counts.back();
  }
  const double asked_m2 = information.source_sigma_m * information.source_sigma_m;
  for (Eigen::Index k = 0; k < layout.sources; ++k) {
    const SourceEstimate& source = state.sources[static_cast<std::size_t>(k)];
    const double count = counts[static_cast<std::size_t>(k)];
    per_s(layout.positions() + k) = static_cast<float>(count * count / rate / square_m2(source) * asked_m2);
    per_s(layout.visits() + k) = static_cast<float>(visit_per_s(information, (from_W - source.p_W).head<2>().norm()));
  }
  return rate;
}

/// Shares out the weights: to the squares by the chance that something hides there, of what the counts say.
void weigh(Prospect& prospect, const Layout& layout, const InformationConfig& information,
           const Eigen::ArrayXXf& chances) {
  prospect.weight.head(layout.positions()) = chances.reshaped() / static_cast<float>(information.sources_expected);
  prospect.weight.segment(layout.positions(), layout.sources)
      .setConstant(static_cast<float>(information.source_weight));
  prospect.weight.tail(layout.sources).setConstant(static_cast<float>(information.visit_weight));
}

/// Of a square where part of the proof is there, the rest is soon brought.
void count_what_is_proven(Prospect& prospect, const Layout& layout, const Eigen::ArrayXXf& odds, double gain_to_add) {
  constexpr float kLeastLeft = 0.2F;
  const Eigen::ArrayXf left = (1.0F - odds.reshaped() / static_cast<float>(gain_to_add)).max(kLeastLeft).min(1.0F);
  prospect.per_s.topRows(layout.positions()).colwise() /= left;
}

void judge_sources(Prospect& prospect, const Layout& layout, const SearchState& state,
                   const InformationConfig& information) {
  prospect.all_precise = true;
  for (Eigen::Index k = 0; k < layout.sources; ++k) {
    const SourceEstimate& source = state.sources[static_cast<std::size_t>(k)];
    const double ratio = information.source_sigma_m * information.source_sigma_m / variance_m2(source);
    prospect.known(layout.positions() + k) = static_cast<float>(ratio);
    prospect.all_precise = prospect.all_precise && ratio >= 1.0;
  }
}

/// Beside a source nothing more is asked for; what nobody may fly over is looked at from beside, but not waited for.
/// What would have been seen for certain is no question any more.
void judge_ground(Prospect& prospect, const Layout& layout, const SearchState& state, const CoarseGround& ground,
                  const Eigen::ArrayXf& seen) {
  constexpr float kCertain = 7.0F;
  prospect.all_clear = true;
  for (Eigen::Index j = 0; j < layout.squares; ++j) {
    const auto square = static_cast<std::size_t>(j);
    const bool beside = beside_source(state, ground.p_W(square), ground.edge_m());
    for (Eigen::Index at = j; at < layout.positions(); at += layout.squares) {
      if (beside || seen(at) >= kCertain) prospect.weight(at) = 0.0F;
    }
    const bool answered = beside || !prospect.flyable[square] || seen(j) >= 1.0F;
    prospect.all_clear = prospect.all_clear && answered;
  }
}

/// What is answered for certain is worth nothing more.
void leave_out_answered(Prospect& prospect) {
  constexpr float kAnswered = 7.0F;
  std::vector<Eigen::Index> open;
  for (Eigen::Index k = 0; k < prospect.known.size(); ++k) {
    if (prospect.known(k) < kAnswered && prospect.weight(k) > 0.0F) open.push_back(k);
  }
  prospect = {.known = prospect.known(open).eval(),
              .weight = prospect.weight(open).eval(),
              .per_s = prospect.per_s(open, Eigen::all).eval(),
              .flyable = std::move(prospect.flyable),
              .all_clear = prospect.all_clear,
              .all_precise = prospect.all_precise};
}

}  // namespace

Eigen::ArrayXXf singles_kernel(const CoarseGround& ground, const SearchState& state, double set_height_m) {
  const auto n = static_cast<Eigen::Index>(ground.size());
  Eigen::ArrayXXf kernel(n, n);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const Eigen::Vector3d from_W = eye_W(ground, i, set_height_m);
    for (std::size_t j = 0; j < ground.size(); ++j) {
      const Eigen::Vector3d& p_W = ground.low_W(j);
      kernel(j, i) = static_cast<float>(singles_per_Bq_s(state, softened_m2(ground, from_W, p_W)) *
                                        let_through(state, from_W, p_W));
    }
  }
  return kernel;
}

Prospect make_prospect(const CoarseGround& ground, const Eigen::ArrayXXf& kernel, const SearchState& state,
                       const SearchConfig& config, const Eigen::ArrayXf& live_s) {
  const InformationConfig& information = config.information;
  const std::vector<double> levels_Bq = activities_Bq(state, information.activities);
  const Layout layout{.squares = kernel.rows(), .levels = std::ssize(levels_Bq), .sources = std::ssize(state.sources)};
  Prospect prospect{.known = {},
                    .weight = Eigen::ArrayXf(layout.questions()),
                    .per_s = Eigen::ArrayXXf(layout.questions(), layout.squares),
                    .flyable = flyable_squares(ground, state, config)};
  Eigen::ArrayXf rate_per_s(layout.squares);
  for (Eigen::Index i = 0; i < layout.squares; ++i) {
    const Eigen::Vector3d from_W = eye_W(ground, static_cast<std::size_t>(i), config.set_height_m);
    rate_per_s(i) =
        static_cast<float>(look_at_sources(prospect.per_s.col(i), layout, state, information, from_W, ground));
    for (Eigen::Index k = 0; k < layout.levels; ++k) {
      const auto count = kernel.col(i) * static_cast<float>(levels_Bq[static_cast<std::size_t>(k)]);
      prospect.per_s.col(i).segment(k * layout.squares, layout.squares) =
          count.square() / (count + rate_per_s(i)) / static_cast<float>(information.counts_to_find);
    }
  }
  const Eigen::ArrayXf seen = (prospect.per_s.matrix() * live_s.matrix()).array();
  prospect.known = seen;
  prospect.known.head(layout.positions()).setZero();
  const CountsAbove counts = state.looks.empty() ? as_expected(live_s, rate_per_s) : counts_above(ground, state.looks);
  const Eigen::ArrayXXf odds = log_odds(kernel, levels_Bq, counts);
  weigh(prospect, layout, information, hidden_chances(ground, odds, information.sources_expected));
  count_what_is_proven(prospect, layout, odds, state.facts.gain_to_add);
  judge_sources(prospect, layout, state, information);
  judge_ground(prospect, layout, state, ground, seen);
  leave_out_answered(prospect);
  return prospect;
}

double worth(const Prospect& prospect, const Eigen::ArrayXf& known) {
  return static_cast<double>((prospect.weight * (1.0F - (-known).exp())).sum());
}

}  // namespace comptonaut
