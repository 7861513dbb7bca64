// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/point_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiation/source_heights.h"

namespace comptonaut {
namespace {

constexpr int kFitSteps = 12;
constexpr int kTrialSteps = 8;
constexpr double kFitGain = 1e-3;
constexpr double kTrialGain = 0.05;
constexpr double kWorthMoving = 3.0;   // gain of a new source where the score's maximum is
constexpr double kWorthFitting = 0.5;  // share of gain_to_add that a new source must bring before the others move
constexpr double kStrained = 2.0;      // likelihood that a known source costs, from which another beside it is tried
constexpr double kSplit_m = 1.0;       // half the distance at which the halves of a split start
constexpr double kMergeWithin_m = 6.0;

/// The activity of a new source that gains most with all else as it is, by Newton's method from `start_Bq`.
struct Activity {
  double activity_Bq = 0.0;
  double gain = 0.0;
};

Activity best_activity(const JointProblem& problem, const JointState& state, const Expected& sums,
                       const ResponseColumn& column) {
  const Viewpoints& v = problem.data.viewpoints;
  const auto& pairs = problem.data.pairs;
  std::vector<double> scale;
  for (const DroneModel& drone : state.model.drones) scale.push_back(drone.scale);
  double exposure_s = 0.0;
  for (std::size_t d = 0; d < scale.size(); ++d) exposure_s += scale[d] * column.exposure_s[d];
  // Derivative and curvature of the gain by the activity.
  const auto derivatives = [&](double A) {
    double first = problem.config.use_pairs ? -exposure_s : 0.0, second = 0.0;
    for (std::size_t i = 0; problem.config.use_singles && i < v.size(); ++i) {
      const double a = scale[v.drone[i]] * state.model.scatter * column.singles[i];
      const double mu = sums.singles[i] + A * a;
      first += a * (v.singles[i] / mu - 1.0);
      second -= v.singles[i] * a * a / (mu * mu);
    }
    for (std::size_t i = 0; problem.config.use_pairs && i < pairs.size(); ++i) {
      const double t = scale[pairs[i].drone] * column.pairs[i];
      const double ratio = t / (sums.pairs[i] + A * t);
      first += ratio;
      second -= ratio * ratio;
    }
    return std::pair(first, second);
  };
  Activity result;
  for (int step = 0; step < 12; ++step) {
    const auto [first, second] = derivatives(result.activity_Bq);
    if (!(second < 0.0)) break;
    // Concave with a growing derivative towards 0: Newton from below never overshoots.
    const double next_Bq = std::max(0.0, result.activity_Bq - first / second);
    const bool done = std::abs(next_Bq - result.activity_Bq) <= 0.01 * next_Bq;
    result.activity_Bq = next_Bq;
    if (done || next_Bq == 0.0) break;
  }
  const double A = result.activity_Bq;
  for (std::size_t i = 0; problem.config.use_singles && i < v.size(); ++i) {
    const double more = A * scale[v.drone[i]] * state.model.scatter * column.singles[i];
    result.gain += (v.singles[i] > 0.0 ? v.singles[i] * std::log1p(more / sums.singles[i]) : 0.0) - more;
  }
  for (std::size_t i = 0; problem.config.use_pairs && i < pairs.size(); ++i) {
    result.gain += std::log1p(A * scale[pairs[i].drone] * column.pairs[i] / sums.pairs[i]);
  }
  if (problem.config.use_pairs) result.gain -= A * exposure_s;
  return result;
}

Eigen::Vector3d on_ground(const Ground& ground, const Eigen::Vector3d& p_W) {
  const double x_m = std::clamp(p_W.x(), ground.area.x_min_m, ground.area.x_max_m);
  const double y_m = std::clamp(p_W.y(), ground.area.y_min_m, ground.area.y_max_m);
  return {x_m, y_m, ground.z_m(x_m, y_m)};
}

JointState with_source(const JointProblem& problem, const JointState& state, const PointSource& source,
                       ResponseColumn column) {
  JointState next = state;
  next.model.sources.push_back(source);
  next.columns.push_back(std::move(column));
  next.log_likelihood = log_likelihood(problem, next.model, next.columns);
  return next;
}

JointState without_source(const JointProblem& problem, const JointState& state, std::size_t k) {
  JointState next = state;
  next.model.sources.erase(next.model.sources.begin() + static_cast<std::ptrdiff_t>(k));
  next.columns.erase(next.columns.begin() + static_cast<std::ptrdiff_t>(k));
  next.log_likelihood = log_likelihood(problem, next.model, next.columns);
  return next;
}

std::size_t nearest_to(const JointModel& model, std::size_t k) {
  std::size_t nearest = k;
  double nearest_m = kMergeWithin_m;
  for (std::size_t i = model.known.size(); i < model.sources.size(); ++i) {
    const double d_m = (model.sources[i].p_W - model.sources[k].p_W).norm();
    if (i != k && d_m < nearest_m) nearest = i, nearest_m = d_m;
  }
  return nearest;
}

/// Source k given to its neighbour, which stands for both.
JointState merged(const JointProblem& problem, const Ground& ground, const JointState& state, std::size_t k,
                  std::size_t neighbour) {
  JointModel model = state.model;
  const PointSource& gone = model.sources[k];
  PointSource& stays = model.sources[neighbour];
  const double sum_Bq = gone.activity_Bq + stays.activity_Bq;
  stays.p_W = on_ground(ground, (gone.activity_Bq * gone.p_W + stays.activity_Bq * stays.p_W) / sum_Bq);
  stays.activity_Bq = sum_Bq;
  model.sources.erase(model.sources.begin() + static_cast<std::ptrdiff_t>(k));
  return state_of(problem, std::move(model));
}

void fit_all(const JointProblem& problem, const Ground& ground, JointState& state, int steps = kFitSteps,
             double gain_min = kFitGain) {
  refit(problem, ground, all_of(state.model.sources.size()), steps, gain_min, state);
}

/// The best state without source k.
JointState best_without(const JointProblem& problem, const Ground& ground, const JointState& state, std::size_t k) {
  JointState out = without_source(problem, state, k);
  fit_all(problem, ground, out, kTrialSteps, kTrialGain);
  const std::size_t neighbour = nearest_to(state.model, k);
  if (neighbour == k) return out;
  JointState one = merged(problem, ground, state, k, neighbour);
  fit_all(problem, ground, one, kTrialSteps, kTrialGain);
  return one.log_likelihood > out.log_likelihood ? one : out;
}

/// What taking out each source would cost at least about, from the information: (A / sigma_A)^2 / 2 at the response as
/// it is. A source that something beside it could explain has a large sigma_A.
std::vector<double> expected_losses(const JointProblem& problem, const Ground& ground, const JointState& state) {
  const std::size_t n = state.model.sources.size();
  const ParameterLayout layout = layout_of(ground, state.model, all_of(n));
  Eigen::MatrixXd information = linearise(problem, state, layout).information;
  information.diagonal().array() += 1e-9;
  constexpr double kFixed = 1e12;
  for (std::size_t d = 0; d < layout.drones; ++d) information(layout.scale(d), layout.scale(d)) += kFixed;
  information(layout.scatter(), layout.scatter()) += kFixed;
  const Eigen::MatrixXd covariance = information.inverse();
  std::vector<double> losses;
  for (std::size_t k = 0; k < n; ++k) losses.push_back(0.5 / std::max(covariance(k, k), 1e-12));
  return losses;
}

bool has_room(const JointProblem& problem, const JointModel& model) {
  return own_sources(model) < static_cast<std::size_t>(problem.config.sources_max);
}

bool grow(const JointProblem& problem, const Ground& ground, const ScoreMap& map, JointState& state) {
  bool changed = false;
  while (has_room(problem, state.model)) {
    auto more = with_best_addition(problem, ground, map, state);
    if (!more || more->log_likelihood - state.log_likelihood < problem.config.gain_to_add) return changed;
    state = std::move(*more);
    adjust_heights(problem, ground, state);
    changed = true;
  }
  return changed;
}

/// Tries the weakest source first. True: something changed.
bool shrink(const JointProblem& problem, const Ground& ground, const ScoreMap& map, JointState& state) {
  const std::vector<double> losses = expected_losses(problem, ground, state);
  std::vector<std::size_t> order = all_of(losses.size());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return losses[a] < losses[b]; });
  for (const std::size_t k : order) {
    if (k < state.model.known.size()) continue;
    if (losses[k] > problem.config.loss_to_reseed) return false;
    JointState without = best_without(problem, ground, state, k);
    const double loss = state.log_likelihood - without.log_likelihood;
    if (loss < problem.config.loss_to_drop) {
      state = std::move(without);
      return true;
    }
    if (loss > problem.config.loss_to_reseed) continue;
    auto elsewhere = with_best_addition(problem, ground, map, without);
    if (elsewhere && elsewhere->log_likelihood > state.log_likelihood + 0.5) {
      state = std::move(*elsewhere);
      return true;
    }
  }
  return false;
}

/// Where source k would fall apart: the direction in which the score pulls most to both sides; nullopt: nowhere.
std::optional<Eigen::Vector3d> split_direction(const JointProblem& problem, const JointState& state, std::size_t k) {
  constexpr int kDirections = 4;
  const Residuals pulls = residuals(problem, state);
  const Eigen::Vector3d& p_W = state.model.sources[k].p_W;
  std::optional<Eigen::Vector3d> best;
  double best_s = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = std::numbers::pi * i / kDirections;
    const Eigen::Vector3d aside_W = kSplit_m * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    const double both_s = score(problem, pulls, p_W + aside_W) + score(problem, pulls, p_W - aside_W);
    if (both_s > best_s) best = aside_W, best_s = both_s;
  }
  return best;
}

/// Tries two sources in the place of source k. True: they gained enough to stay.
bool split(const JointProblem& problem, const Ground& ground, std::size_t k, JointState& state) {
  if (!has_room(problem, state.model)) return false;
  const auto aside_W = split_direction(problem, state, k);
  if (!aside_W) return false;
  JointModel model = state.model;
  model.sources[k].activity_Bq *= 0.5;
  model.sources.push_back(model.sources[k]);
  model.sources[k].p_W = on_ground(ground, model.sources[k].p_W + *aside_W);
  model.sources.back().p_W = on_ground(ground, model.sources.back().p_W - *aside_W);
  JointState two = state_of(problem, std::move(model));
  refit(problem, ground, {k, two.model.sources.size() - 1}, kTrialSteps, kTrialGain, two);
  if (two.log_likelihood - state.log_likelihood < kWorthFitting * problem.config.gain_to_add) return false;
  fit_all(problem, ground, two);
  if (two.log_likelihood - state.log_likelihood < problem.config.gain_to_add) return false;
  state = std::move(two);
  return true;
}

/// How much likelihood it costs that this channel's data have moved known source k from what is believed of it.
double strain(const JointModel& model, std::size_t k) {
  const KnownSource& known = model.known[k];
  const Eigen::Vector2d off_m = (model.sources[k].p_W - known.source.p_W).head<2>();
  const double log_ratio = std::log(model.sources[k].activity_Bq / known.source.activity_Bq) / known.activity_rel_sigma;
  return 0.5 * (off_m.dot(known.place_information * off_m) + log_ratio * log_ratio);
}

/// Tries the known source that is moved most as it is believed to be, and a source of the channel's own that explains
/// what is left: a fit alone would rather move the known one. True: they gained enough to stay.
bool separate(const JointProblem& problem, const Ground& ground, const ScoreMap& map, JointState& state) {
  if (!has_room(problem, state.model)) return false;
  std::optional<std::size_t> moved;
  double most = kStrained;
  for (std::size_t k = 0; k < state.model.known.size(); ++k) {
    if (strain(state.model, k) > most) moved = k, most = strain(state.model, k);
  }
  if (!moved) return false;
  JointModel model = state.model;
  model.sources[*moved] = model.known[*moved].source;
  auto two = with_best_addition(problem, ground, map, state_of(problem, std::move(model)));
  if (!two || two->log_likelihood - state.log_likelihood < problem.config.gain_to_add) return false;
  state = std::move(*two);
  return true;
}

}  // namespace

std::optional<JointState> with_best_addition(const JointProblem& problem, const Ground& ground, const ScoreMap& map,
                                             const JointState& state) {
  const Expected sums = expected(problem, state.model, state.columns);
  std::optional<JointState> best;
  for (const ScoreMaximum& maximum : map.maxima(problem, residuals(problem, state), problem.config.candidates)) {
    ResponseColumn column;
    fill_column(problem.physics, problem.data, maximum.p_W, column);
    const Activity activity = best_activity(problem, state, sums, column);
    if (activity.gain < kWorthMoving) continue;
    JointState next =
        with_source(problem, state, {.p_W = maximum.p_W, .activity_Bq = activity.activity_Bq}, std::move(column));
    refit(problem, ground, {next.model.sources.size() - 1}, kTrialSteps, kTrialGain, next);
    if (!best || next.log_likelihood > best->log_likelihood) best = std::move(next);
  }
  if (!best || best->log_likelihood - state.log_likelihood < kWorthFitting * problem.config.gain_to_add) return {};
  fit_all(problem, ground, *best);
  return best;
}

void improve(const JointProblem& problem, const Ground& ground, const ScoreMap& map, std::size_t turn,
             JointState& state) {
  constexpr int kRounds = 8;
  fit_all(problem, ground, state);
  adjust_heights(problem, ground, state);
  const std::size_t own = own_sources(state.model);
  if (own > 0) split(problem, ground, state.model.known.size() + turn % own, state);
  separate(problem, ground, map, state);
  for (int round = 0; round < kRounds; ++round) {
    const bool grown = grow(problem, ground, map, state);
    const bool shrunk = shrink(problem, ground, map, state);
    if (!grown && !shrunk) return;
  }
}

}  // namespace comptonaut
