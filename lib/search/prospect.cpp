// SPDX-License-Identifier: BSD-3-Clause
#include "search/prospect.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "search/courses.h"
#include "search/posterior.h"
#include "world/world.h"

namespace comptonaut {
namespace {

/// From then on an answer is certain: exp(-7) is 0.001.
constexpr float kCertain = 7.0F;

Eigen::Vector3d eye_W(const CoarseGround& ground, std::size_t i, double set_height_m) {
  return ground.p_W(i) + set_height_m * Eigen::Vector3d::UnitZ();
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

/// The larger of the variances along x and y, m^2; of a source without: as if it were known to some metres.
double variance_m2(const SourceEstimate& source) {
  constexpr double kUnknown_m2 = 4.0;
  const Eigen::Vector2d sigma_m = source.position_sigma_m.head<2>();
  return sigma_m.allFinite() ? std::clamp(sigma_m.cwiseAbs2().maxCoeff(), 1e-6, 1e6) : kUnknown_m2;
}

/// Beside a source of the channel's own nuclide.
bool beside_source(const SearchState& state, std::size_t channel, const Eigen::Vector3d& p_W, double reach_m) {
  return std::any_of(state.sources.begin(), state.sources.end(), [&](const SourceEstimate& source) {
    return channel_of(state.facts, source) == channel && (source.p_W - p_W).head<2>().norm() < reach_m;
  });
}

/// Where the questions stand: of each channel and each activity all squares, then each source's position, then a visit
/// to each.
struct Layout {
  Eigen::Index squares = 0, levels = 0, channels = 0, sources = 0;

  [[nodiscard]] Eigen::Index of_channel(std::size_t channel) const {
    return static_cast<Eigen::Index>(channel) * squares * levels;
  }
  [[nodiscard]] Eigen::Index positions() const { return squares * levels * channels; }
  [[nodiscard]] Eigen::Index visits() const { return positions() + sources; }
  [[nodiscard]] Eigen::Index questions() const { return visits() + sources; }
};

std::vector<bool> flyable_squares(const SearchState& state, const SearchConfig& config, const HoverPlaces& hover_W) {
  const Fence fence = with_keep_out(state.sources, config).route.fence;
  std::vector<bool> flyable;
  for (const auto& p_W : hover_W) flyable.push_back(p_W && fence.contains(*p_W));
  return flyable;
}

/// A second at this distance from above a source, as a share of a visit.
double visit_per_s(const InformationConfig& information, double away_m) {
  const double share = away_m / information.visit_distance_m;
  return std::exp(-0.5 * share * share) / information.visit_s;
}

/// Fills in what a second at from_W tells of the sources, each in the channel of its own nuclide.
void look_at_sources(Eigen::Ref<Eigen::ArrayXf> per_s, const Layout& layout, const SearchState& state,
                     const InformationConfig& information, const Eigen::Vector3d& from_W, const CoarseGround& ground,
                     const std::vector<SourceRates>& rates) {
  const double asked_m2 = information.source_sigma_m * information.source_sigma_m;
  for (Eigen::Index k = 0; k < layout.sources; ++k) {
    const SourceEstimate& source = state.sources[static_cast<std::size_t>(k)];
    const SourceRates& own = rates[channel_of(state.facts, source)];
    const double count = own.of_source_per_s[static_cast<std::size_t>(k)];
    per_s(layout.positions() + k) =
        static_cast<float>(count * count / own.all_per_s / softened_m2(ground, from_W, source.p_W) * asked_m2);
    per_s(layout.visits() + k) = static_cast<float>(visit_per_s(information, (from_W - source.p_W).head<2>().norm()));
  }
}

/// Fills in what a second above square i tells of sources of one nuclide anywhere.
void look_at_ground(Eigen::Ref<Eigen::ArrayXf> per_s, Eigen::Index i, const std::vector<Evidence>& evidence,
                    const std::vector<double>& levels_Bq, const Eigen::ArrayXXf& rate_per_s, double counts_to_find) {
  const Eigen::Index squares = rate_per_s.rows();
  per_s.setZero();
  for (const Evidence& from : evidence) {
    const float rate = rate_per_s(i, static_cast<Eigen::Index>(from.channel));
    for (std::size_t k = 0; k < levels_Bq.size(); ++k) {
      const auto count = from.kernel.col(i) * static_cast<float>(levels_Bq[k]);
      per_s.segment(static_cast<Eigen::Index>(k) * squares, squares) +=
          from.speaks * (count.square() / (count + rate) / static_cast<float>(counts_to_find));
    }
  }
}

/// Fills in what a second above each square tells. Returns what is expected there [square, channel], counts per second.
Eigen::ArrayXXf look_from_each_square(Eigen::ArrayXXf& per_s, const Layout& layout, const CoarseGround& ground,
                                      const SearchState& state, const SearchConfig& config,
                                      const std::vector<std::vector<Evidence>>& evidence) {
  const InformationConfig& information = config.information;
  const std::vector<double> levels_Bq = activities_Bq(state, information.activities);
  std::vector<double> backgrounds_per_s;
  for (std::size_t c = 0; c < evidence.size(); ++c) {
    backgrounds_per_s.push_back(background_per_s(state, c, information.background_singles_per_s));
  }
  Eigen::ArrayXXf rate_per_s(layout.squares, layout.channels);
  for (Eigen::Index i = 0; i < layout.squares; ++i) {
    const Eigen::Vector3d from_W = eye_W(ground, static_cast<std::size_t>(i), config.set_height_m);
    std::vector<SourceRates> rates;
    for (std::size_t c = 0; c < evidence.size(); ++c) {
      rates.push_back(source_rates(ground, state, c, from_W, backgrounds_per_s[c]));
      rate_per_s(i, static_cast<Eigen::Index>(c)) = static_cast<float>(rates.back().all_per_s);
    }
    look_at_sources(per_s.col(i), layout, state, information, from_W, ground, rates);
    for (std::size_t c = 0; c < evidence.size(); ++c) {
      look_at_ground(per_s.col(i).segment(layout.of_channel(c), layout.squares * layout.levels), i, evidence[c],
                     levels_Bq, rate_per_s, information.counts_to_find);
    }
  }
  return rate_per_s;
}

/// Of one nuclide [square, activity]: log_odds of all channels that speak of it.
Eigen::ArrayXXf odds_of(const std::vector<Evidence>& evidence, const std::vector<double>& levels_Bq,
                        const std::vector<CountsAbove>& counts, double expected_rel_sigma) {
  const auto odds = [&](const Evidence& from) {
    return log_odds(from.kernel, levels_Bq, counts[from.channel], expected_rel_sigma);
  };
  Eigen::ArrayXXf sum = odds(evidence[0]);
  for (std::size_t k = 1; k < evidence.size(); ++k) {
    sum += odds(evidence[k]).colwise() * evidence[k].speaks;
  }
  return sum.max(kDenied);
}

std::vector<CountsAbove> counts_of(const CoarseGround& ground, const SearchState& state, const Eigen::ArrayXf& live_s,
                                   const Eigen::ArrayXXf& rate_per_s) {
  std::vector<CountsAbove> counts;
  for (Eigen::Index c = 0; c < rate_per_s.cols(); ++c) {
    const auto channel = static_cast<std::size_t>(c);
    const bool told = channel < state.looks.size() && !state.looks[channel].empty();
    counts.push_back(told ? counts_above(ground, state.looks[channel]) : as_expected(live_s, rate_per_s.col(c)));
  }
  return counts;
}

void weigh_sources(Prospect& prospect, const Layout& layout, const InformationConfig& information) {
  prospect.weight.segment(layout.positions(), layout.sources)
      .setConstant(static_cast<float>(information.source_weight));
  prospect.weight.tail(layout.sources).setConstant(static_cast<float>(information.visit_weight));
}

/// Of one nuclide's squares: each weighs the chance that something hides there. Where part of the proof is there, the
/// rest is soon brought.
void weigh_ground(Prospect& prospect, const Layout& layout, std::size_t nuclide, const CoarseGround& ground,
                  const Eigen::ArrayXXf& odds, double expected, double gain_to_add) {
  constexpr float kLeastLeft = 0.2F;
  const Eigen::Index first = layout.of_channel(nuclide), n = odds.size();
  const double expected_each = expected / static_cast<double>(layout.channels);
  const Eigen::ArrayXXf chances = hidden_chances(ground, odds, expected_each);
  prospect.weight.segment(first, n) = chances.reshaped() / static_cast<float>(expected);
  const Eigen::ArrayXf left = (1.0F - odds.reshaped() / static_cast<float>(gain_to_add)).max(kLeastLeft).min(1.0F);
  prospect.per_s.middleRows(first, n).colwise() /= left;
}

/// Ground that nobody may fly over weighs less: MAVs would hang about beside what they will never see well.
void weigh_down_out_of_reach(Prospect& prospect, const Layout& layout) {
  if (std::ranges::count(prospect.flyable, false) == 0) return;
  const Eigen::Index n = layout.positions();
  Eigen::ArrayXf from_beside = Eigen::ArrayXf::Zero(n);
  for (Eigen::Index i = 0; i < layout.squares; ++i) {
    if (prospect.flyable[static_cast<std::size_t>(i)]) from_beside = from_beside.max(prospect.per_s.col(i).head(n));
  }
  for (Eigen::Index at = 0; at < n; ++at) {
    const Eigen::Index j = at % layout.squares;
    const float from_above = prospect.per_s(at, j);
    const bool out_of_reach = !prospect.flyable[static_cast<std::size_t>(j)] && from_beside(at) < from_above;
    if (out_of_reach) prospect.weight(at) *= from_beside(at) / from_above;
  }
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

/// Beside a source nothing more is asked of its nuclide; what nobody may fly over is looked at from beside, but not
/// waited for. What would have been seen for certain is no question any more.
void judge_ground(Prospect& prospect, const Layout& layout, std::size_t nuclide, const SearchState& state,
                  const CoarseGround& ground, const Eigen::ArrayXf& seen) {
  const Eigen::Index first = layout.of_channel(nuclide), end = first + layout.squares * layout.levels;
  for (Eigen::Index j = 0; j < layout.squares; ++j) {
    const auto square = static_cast<std::size_t>(j);
    const bool beside = beside_source(state, nuclide, ground.p_W(square), ground.edge_m());
    for (Eigen::Index at = first + j; at < end; at += layout.squares) {
      if (beside || seen(at) >= kCertain) prospect.weight(at) = 0.0F;
    }
    if (beside || seen(first + j) >= 1.0F) continue;
    if (prospect.flyable[square])
      prospect.all_clear = false;
    else
      prospect.unseen[square] = true;
  }
}

/// What is answered for certain is worth nothing more.
void leave_out_answered(Prospect& prospect) {
  std::vector<Eigen::Index> open;
  for (Eigen::Index k = 0; k < prospect.known.size(); ++k) {
    if (prospect.known(k) < kCertain && prospect.weight(k) > 0.0F) open.push_back(k);
  }
  prospect = {.known = prospect.known(open).eval(),
              .weight = prospect.weight(open).eval(),
              .per_s = prospect.per_s(open, Eigen::all).eval(),
              .views = {},
              .flyable = std::move(prospect.flyable),
              .unseen = std::move(prospect.unseen),
              .all_clear = prospect.all_clear,
              .all_precise = prospect.all_precise};
}

}  // namespace

Prospect make_prospect(const CoarseGround& ground, const Kernels& kernels, const SearchState& state,
                       const SearchConfig& config, const Eigen::ArrayXf& live_s, const HoverPlaces& hover_W) {
  const InformationConfig& information = config.information;
  const std::vector<double> levels_Bq = activities_Bq(state, information.activities);
  const Layout layout{.squares = live_s.size(),
                      .levels = std::ssize(levels_Bq),
                      .channels = std::ssize(kernels),
                      .sources = std::ssize(state.sources)};
  Prospect prospect{.known = {},
                    .weight = Eigen::ArrayXf(layout.questions()),
                    .per_s = Eigen::ArrayXXf(layout.questions(), layout.squares),
                    .views = {},
                    .flyable = flyable_squares(state, config, hover_W)};
  std::vector<std::vector<Evidence>> evidence;
  for (std::size_t c = 0; c < kernels.size(); ++c) evidence.push_back(evidence_of(ground, kernels, state, c));
  const Eigen::ArrayXXf rate_per_s = look_from_each_square(prospect.per_s, layout, ground, state, config, evidence);
  const Eigen::ArrayXf seen = (prospect.per_s.matrix() * live_s.matrix()).array();
  prospect.known = seen;
  prospect.known.head(layout.positions()).setZero();
  weigh_sources(prospect, layout, information);
  judge_sources(prospect, layout, state, information);
  const std::vector<CountsAbove> counts = counts_of(ground, state, live_s, rate_per_s);
  prospect.unseen.assign(ground.size(), false);
  prospect.all_clear = true;
  for (std::size_t c = 0; c < kernels.size(); ++c) {
    weigh_ground(prospect, layout, c, ground, odds_of(evidence[c], levels_Bq, counts, information.expected_rel_sigma),
                 information.sources_expected, state.facts.gain_to_add);
    judge_ground(prospect, layout, c, state, ground, seen);
  }
  weigh_down_out_of_reach(prospect, layout);
  leave_out_answered(prospect);
  prospect.views = views_of(prospect.per_s);
  return prospect;
}

}  // namespace comptonaut
