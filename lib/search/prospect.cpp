// SPDX-License-Identifier: BSD-3-Clause
#include "search/prospect.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

double singles_per_Bq_s(const SearchState& state, double square_m2) {
  return state.facts.single_response * std::exp(-state.facts.attenuation_per_m * std::sqrt(square_m2)) / square_m2;
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
      kernel(j, i) = static_cast<float>(singles_per_Bq_s(state, softened_m2(ground, from_W, ground.p_W(j))));
    }
  }
  return kernel;
}

Prospect make_prospect(const CoarseGround& ground, const Eigen::ArrayXXf& kernel, const SearchState& state,
                       const SearchConfig& config, const Eigen::ArrayXf& live_s) {
  const InformationConfig& information = config.information;
  const std::vector<double> levels_Bq = activities_Bq(state, information.activities);
  const Eigen::Index squares = kernel.rows(), levels = std::ssize(levels_Bq), sources = std::ssize(state.sources);
  const Eigen::Index questions = squares * levels + sources;
  Prospect prospect{.known = {}, .weight = Eigen::ArrayXf(questions), .per_s = Eigen::ArrayXXf(questions, squares)};
  for (Eigen::Index i = 0; i < squares; ++i) {
    const Eigen::Vector3d from_W = eye_W(ground, static_cast<std::size_t>(i), config.set_height_m);
    double rate = information.background_singles_per_s;
    for (const SourceEstimate& source : state.sources) {
      rate += source.activity_Bq * singles_per_Bq_s(state, softened_m2(ground, from_W, source.p_W));
    }
    auto column = prospect.per_s.col(i);
    for (Eigen::Index k = 0; k < levels; ++k) {
      const auto count = kernel.col(i) * static_cast<float>(levels_Bq[static_cast<std::size_t>(k)]);
      column.segment(k * squares, squares) =
          count.square() / (count + static_cast<float>(rate)) / static_cast<float>(information.counts_to_find);
    }
    for (Eigen::Index k = 0; k < sources; ++k) {
      const SourceEstimate& source = state.sources[static_cast<std::size_t>(k)];
      const double square_m2 = softened_m2(ground, from_W, source.p_W);
      const double count = source.activity_Bq * singles_per_Bq_s(state, square_m2);
      const double asked_m2 = information.source_sigma_m * information.source_sigma_m;
      column(squares * levels + k) = static_cast<float>(count * count / rate / square_m2 * asked_m2);
    }
  }
  prospect.known = (prospect.per_s.matrix() * live_s.matrix()).array();
  prospect.weight.setConstant(1.0F / static_cast<float>(squares * levels));
  prospect.weight.tail(sources).setConstant(static_cast<float>(information.source_weight));
  prospect.all_precise = prospect.all_clear = true;
  for (Eigen::Index k = 0; k < sources; ++k) {
    const SourceEstimate& source = state.sources[static_cast<std::size_t>(k)];
    const double ratio = information.source_sigma_m * information.source_sigma_m / variance_m2(source);
    prospect.known(squares * levels + k) = static_cast<float>(ratio);
    prospect.all_precise = prospect.all_precise && ratio >= 1.0;
  }
  for (Eigen::Index j = 0; j < squares; ++j) {
    const bool beside = beside_source(state, ground.p_W(static_cast<std::size_t>(j)), ground.edge_m());
    for (Eigen::Index k = 0; beside && k < levels; ++k) prospect.weight(k * squares + j) = 0.0F;
    prospect.all_clear = prospect.all_clear && (beside || prospect.known(j) >= 1.0F);
  }
  leave_out_answered(prospect);
  return prospect;
}

double worth(const Prospect& prospect, const Eigen::ArrayXf& known) {
  return static_cast<double>((prospect.weight * (1.0F - (-known).exp())).sum());
}

}  // namespace comptonaut
