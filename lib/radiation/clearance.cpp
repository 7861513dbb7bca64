// SPDX-License-Identifier: BSD-3-Clause
// The part of ScoreMap that says where the ground is clear.
#include <algorithm>
#include <array>
#include <utility>

#include "radiation/score_map.h"
#include "radiation/upper_limit.h"

namespace comptonaut {
namespace {

constexpr std::size_t kSideBySide = 16;    // nodes: floats of a cache line
constexpr double kSmall = 0.1;             // terms r A below are taken as one,
constexpr double kActivityOfCounts = 6.0;  // A being where so many counts are expected

/// Rows of one float per node that share a factor and were counted together.
struct Term {
  const std::vector<float>* row;
  double ratio;  ///< per unit of the row
  double counts;
};

}  // namespace

std::vector<double> ScoreMap::clear_above_Bq(const JointProblem& problem, const JointState& state,
                                             double chance) const {
  const Viewpoints& v = problem.data.viewpoints;
  const std::vector<DroneModel>& drones = state.model.drones;
  const Expected sums = expected(problem, state.model, state.columns);
  std::vector<double> live_s(blocks_.size(), 0.0), mu(blocks_.size(), 0.0), counts(blocks_.size(), 0.0);
  for (std::size_t i = 0; problem.config.use_singles && i < block_of_viewpoint_.size(); ++i) {
    const std::size_t b = block_of_viewpoint_[i];
    live_s[b] += drones[v.drone[i]].scale * state.model.scatter * v.live_s[i];
    mu[b] += sums.singles[i];
    counts[b] += v.singles[i];
  }
  std::vector<double> S(nodes_.size(), 0.0);
  std::vector<Term> terms;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (std::size_t j = 0; live_s[b] > 0.0 && j < S.size(); ++j) S[j] += live_s[b] * blocks_[b].kernel[j];
    if (counts[b] > 0.0) terms.push_back({&blocks_[b].kernel, live_s[b] / mu[b], counts[b]});
  }
  for (std::size_t d = 0; problem.config.use_pairs && d < exposure_s_.size(); ++d) {
    for (std::size_t j = 0; j < S.size(); ++j) S[j] += drones[d].scale * exposure_s_[d][j];
  }
  for (std::size_t i = 0; problem.config.use_pairs && i < pair_rows_.size(); ++i) {
    terms.push_back({&pair_rows_[i], drones[problem.data.pairs[i].drone].scale / sums.pairs[i], 1.0});
  }
  std::vector<double> limits_Bq(nodes_.size());
  std::array<ActivityEvidence, kSideBySide> evidence;
  for (std::size_t first = 0; first < limits_Bq.size(); first += kSideBySide) {
    const std::size_t n = std::min(kSideBySide, limits_Bq.size() - first);
    for (std::size_t j = 0; j < n; ++j) evidence[j] = {.sensitivity_s = S[first + j]};
    std::array<std::pair<double, double>, kSideBySide> small{};  // sums of n r and of n r^2
    for (const Term& term : terms) {
      for (std::size_t j = 0; j < n; ++j) {
        ActivityEvidence& e = evidence[j];
        const double r = term.ratio * (*term.row)[first + j], nr = term.counts * r;
        if (r * kActivityOfCounts < kSmall * e.sensitivity_s) {
          small[j].first += nr;
          small[j].second += nr * r;
        } else {
          e.ratios_per_Bq.push_back(r);
          e.counts.push_back(term.counts);
        }
      }
    }
    for (std::size_t j = 0; j < n; ++j) {
      const auto [nr, nrr] = small[j];
      if (nrr > 0.0) {
        evidence[j].ratios_per_Bq.push_back(nrr / nr);
        evidence[j].counts.push_back(nr * nr / nrr);
      }
      limits_Bq[first + j] = upper_limit_Bq(evidence[j], chance);
    }
  }
  return limits_Bq;
}

}  // namespace comptonaut
