// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comptonaut {
namespace {

constexpr double kLink_m = 5.5;
constexpr std::size_t kPointsMin = 3;
constexpr double kOwnCost = 1.5;  // in points
constexpr double kStep_m = 0.2;
constexpr double kRadiusMin_m = 0.5;
constexpr double kSame_m = 5.0;  // a disc so near to a group is that group's of the last time
constexpr int kRefitSteps = 3;
constexpr double kRefitGain = 0.05;

/// Own sources linked to one another, each group in the order of their indices.
std::vector<std::vector<std::size_t>> linked(const JointModel& model) {
  const std::vector<PointSource>& sources = model.sources;
  std::vector<std::vector<std::size_t>> groups;
  std::vector<bool> taken(sources.size(), false);
  std::fill_n(taken.begin(), model.known.size(), true);
  for (std::size_t first = 0; first < sources.size(); ++first) {
    if (taken[first]) continue;
    std::vector<std::size_t> group = {first};
    taken[first] = true;
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (std::size_t k = 0; k < sources.size(); ++k) {
        if (taken[k] || (sources[k].p_W - sources[group[i]].p_W).norm() > kLink_m) continue;
        taken[k] = true;
        group.push_back(k);
      }
    }
    std::sort(group.begin(), group.end());
    if (group.size() >= kPointsMin) groups.push_back(std::move(group));
  }
  return groups;
}

/// The even disc that has the points' activity, centroid and second moment.
SourceDisc of_moments(const std::vector<PointSource>& sources, const std::vector<std::size_t>& members) {
  SourceDisc disc{.members = members};
  for (const std::size_t k : members) {
    disc.activity_Bq += sources[k].activity_Bq;
    disc.p_W += sources[k].activity_Bq * sources[k].p_W;
  }
  disc.p_W /= disc.activity_Bq;
  double second_m2 = 0.0;
  for (const std::size_t k : members) {
    second_m2 += sources[k].activity_Bq * (sources[k].p_W - disc.p_W).head<2>().squaredNorm();
  }
  disc.radius_m = std::max(kRadiusMin_m, std::sqrt(2.0 * second_m2 / disc.activity_Bq));
  return disc;
}

/// The state with the disc, as one more source that does not move, in the place of its members.
JointState with_disc(const JointProblem& problem, const Ground& ground, const JointState& state,
                     const SourceDisc& disc) {
  JointState next = without_members(problem, state, {&disc, 1});
  next.model.sources.push_back({.p_W = disc.p_W, .activity_Bq = disc.activity_Bq});
  next.columns.push_back(disc_column(problem, ground, disc.p_W, disc.radius_m));
  next.log_likelihood = log_likelihood(problem, next.model, next.columns);
  refit(problem, ground, {}, kRefitSteps, kRefitGain, next);
  return next;
}

SourceDisc evaluated(const JointProblem& problem, const Ground& ground, const JointState& state, SourceDisc disc) {
  const JointState with = with_disc(problem, ground, state, disc);
  disc.activity_Bq = with.model.sources.back().activity_Bq;
  disc.gain = with.log_likelihood - state.log_likelihood;
  return disc;
}

/// One step along each parameter, to either side, wherever it gains.
SourceDisc improved(const JointProblem& problem, const Ground& ground, const JointState& state, SourceDisc disc) {
  for (int parameter = 0; parameter < 3; ++parameter) {
    for (const double step_m : {kStep_m, -kStep_m}) {
      SourceDisc tried = disc;
      if (parameter < 2) tried.p_W[parameter] += step_m;
      if (parameter == 2) tried.radius_m = std::max(kRadiusMin_m, disc.radius_m + step_m);
      tried = evaluated(problem, ground, state, std::move(tried));
      if (tried.gain <= disc.gain) continue;
      disc = std::move(tried);
      break;
    }
  }
  return disc;
}

}  // namespace

ResponseColumn disc_column(const JointProblem& problem, const Ground& ground, const Eigen::Vector3d& p_W,
                           double radius_m) {
  constexpr int kDiscPoints = 24;  // a spiral that fills the disc evenly [Vogel 1979]
  const double turn_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  ResponseColumn sum, one;
  const auto add = [](std::vector<double>& to, const std::vector<double>& from) {
    to.resize(from.size(), 0.0);
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i] / kDiscPoints;
  };
  for (int i = 0; i < kDiscPoints; ++i) {
    const double r_m = radius_m * std::sqrt((i + 0.5) / kDiscPoints);
    const double x_m = p_W.x() + r_m * std::cos(turn_rad * i), y_m = p_W.y() + r_m * std::sin(turn_rad * i);
    fill_column(problem.physics, problem.data, {x_m, y_m, ground.z_m(x_m, y_m)}, one);
    add(sum.singles, one.singles);
    add(sum.pairs, one.pairs);
    add(sum.exposure_s, one.exposure_s);
  }
  return sum;
}

JointState without_members(const JointProblem& problem, const JointState& state, std::span<const SourceDisc> discs) {
  if (discs.empty()) return state;
  JointState left{.model = state.model};
  left.model.sources.clear();
  for (std::size_t k = 0; k < state.model.sources.size(); ++k) {
    const bool member = std::any_of(discs.begin(), discs.end(), [k](const SourceDisc& disc) {
      return std::binary_search(disc.members.begin(), disc.members.end(), k);
    });
    if (member) continue;
    left.model.sources.push_back(state.model.sources[k]);
    left.columns.push_back(state.columns[k]);
  }
  left.log_likelihood = log_likelihood(problem, left.model, left.columns);
  return left;
}

std::vector<SourceDisc> discs_of(const JointProblem& problem, const Ground& ground, const JointState& state,
                                 std::span<const SourceDisc> before) {
  std::vector<SourceDisc> discs;
  for (const std::vector<std::size_t>& group : linked(state.model)) {
    SourceDisc disc = of_moments(state.model.sources, group);
    const auto last = std::find_if(before.begin(), before.end(),
                                   [&](const SourceDisc& other) { return (other.p_W - disc.p_W).norm() < kSame_m; });
    if (last != before.end()) disc.p_W = last->p_W, disc.radius_m = last->radius_m;
    disc = improved(problem, ground, state, evaluated(problem, ground, state, std::move(disc)));
    const double saved = static_cast<double>(group.size()) - kOwnCost;
    if (disc.gain > -problem.config.gain_to_add * saved) discs.push_back(std::move(disc));
  }
  return discs;
}

std::vector<PatchEstimate> patches_of(std::span<const SourceDisc> discs, const std::string& nuclide) {
  std::vector<PatchEstimate> patches;
  for (const SourceDisc& disc : discs) {
    patches.push_back({.nuclide = nuclide,
                       .p_W = disc.p_W,
                       .area_m2 = std::numbers::pi * disc.radius_m * disc.radius_m,
                       .activity_Bq = disc.activity_Bq,
                       .gain = disc.gain});
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const PatchEstimate& a, const PatchEstimate& b) { return a.activity_Bq > b.activity_Bq; });
  return patches;
}

}  // namespace comptonaut
