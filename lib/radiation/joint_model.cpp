// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_model.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

double squared(double x) { return x * x; }

double log_prior(const JointConfig& config, const JointModel& model) {
  const double scale_sigma = std::max(config.response_rel_sigma, model.response_spread);
  double sum = squared((model.scatter - 1.0 - config.scatter_share) / config.scatter_share_sigma);
  for (const DroneModel& drone : model.drones) {
    sum += squared((drone.scale - 1.0) / scale_sigma);
    sum += drone.alignment_rad.squaredNorm() / squared(config.alignment_sigma_rad);
    double before = 0.0;
    for (const double drift : drone.drift) {
      sum += squared((drift - before) / config.drift_sigma);
      before = drift;
    }
  }
  for (std::size_t k = 0; k < model.known.size(); ++k) {
    const KnownSource& known = model.known[k];
    const Eigen::Vector2d off_m = (model.sources[k].p_W - known.source.p_W).head<2>();
    sum += off_m.dot(known.place_information * off_m);
    sum += squared(std::log(model.sources[k].activity_Bq / known.source.activity_Bq) / known.activity_rel_sigma);
  }
  return -0.5 * sum;
}

double log_pairs(const JointData& data, const JointModel& model, const std::vector<ResponseColumn>& columns,
                 const std::vector<double>& densities) {
  double sum = 0.0;
  for (const double density : densities) sum += std::log(density);
  for (std::size_t d = 0; d < model.drones.size(); ++d) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      sum -= model.drones[d].scale * model.sources[k].activity_Bq * columns[k].exposure_s[d];
    }
    sum -= model.drones[d].pairs_per_s * data.live_s[d];
  }
  return sum;
}

double log_singles(const std::vector<double>& counted, const std::vector<double>& mu) {
  double sum = 0.0;
  for (std::size_t v = 0; v < mu.size(); ++v) {
    sum -= mu[v];
    if (counted[v] > 0.0) sum += counted[v] * std::log(mu[v]);
  }
  return sum;
}

}  // namespace

const JointPhysics& physics_of(const JointPhysics& physics, const JointModel& model, std::size_t k) {
  return k < model.known.size() ? physics.of_others[model.known[k].other] : physics;
}

std::size_t own_sources(const JointModel& model) { return model.sources.size() - model.known.size(); }

double response_spread(const JointConfig& config, const JointModel& model) {
  const auto n = static_cast<double>(model.drones.size());
  double mean = 0.0, squares = squared(config.response_rel_sigma);
  for (const DroneModel& drone : model.drones) mean += drone.scale / n;
  for (const DroneModel& drone : model.drones) squares += squared(drone.scale - mean);
  return std::sqrt(squares / std::max(1.0, n - 1.0));
}

DriftPlace drift_place(const JointProblem& problem, Utime utime, std::size_t points) {
  const Utime since = std::max<Utime>(0, utime - problem.data.viewpoints.utime.front());
  const double at = std::min(seconds(since) / problem.config.drift_s, static_cast<double>(points));
  const std::size_t whole = std::min(static_cast<std::size_t>(at), points - 1);
  return {.at = whole, .share = at - static_cast<double>(whole)};
}

std::size_t drift_points(const JointProblem& problem) {
  const std::vector<Utime>& utime = problem.data.viewpoints.utime;
  if (utime.empty()) return 0;
  const Utime length = *std::max_element(utime.begin(), utime.end()) - utime.front();
  const double points = std::round(seconds(length) / problem.config.drift_s);
  return points < 2.0 ? 0 : static_cast<std::size_t>(points);
}

double background(const JointProblem& problem, const JointModel& model, std::size_t viewpoint) {
  const Viewpoints& v = problem.data.viewpoints;
  const DroneModel& drone = model.drones[v.drone[viewpoint]];
  const double constant = drone.singles_per_s * v.live_s[viewpoint];
  if (drone.drift.empty()) return constant;
  const auto [at, share] = drift_place(problem, v.utime[viewpoint], drone.drift.size());
  const double before = at > 0 ? drone.drift[at - 1] : 0.0;
  return constant * std::exp(before + share * (drone.drift[at] - before));
}

Expected expected(const JointProblem& problem, const JointModel& model, const std::vector<ResponseColumn>& columns) {
  const Viewpoints& viewpoints = problem.data.viewpoints;
  const auto& pairs = problem.data.pairs;
  Expected sums{.singles = std::vector<double>(viewpoints.size(), 0.0),
                .pairs = std::vector<double>(pairs.size(), 0.0)};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double activity_Bq = model.sources[k].activity_Bq;
    const double *singles = columns[k].singles.data(), *densities = columns[k].pairs.data();
    for (std::size_t v = 0; v < sums.singles.size(); ++v) sums.singles[v] += activity_Bq * singles[v];
    for (std::size_t i = 0; i < sums.pairs.size(); ++i) sums.pairs[i] += activity_Bq * densities[i];
  }
  for (std::size_t v = 0; v < sums.singles.size(); ++v) {
    const DroneModel& drone = model.drones[viewpoints.drone[v]];
    sums.singles[v] = drone.scale * model.scatter * sums.singles[v] + background(problem, model, v);
  }
  for (std::size_t i = 0; i < sums.pairs.size(); ++i) {
    const DroneModel& drone = model.drones[pairs[i].drone];
    sums.pairs[i] = drone.scale * sums.pairs[i] + drone.pairs_per_s * kIsotropic_per_sr;
  }
  return sums;
}

double log_likelihood(const JointProblem& problem, const JointModel& model,
                      const std::vector<ResponseColumn>& columns) {
  const Expected sums = expected(problem, model, columns);
  double sum = log_prior(problem.config, model);
  if (problem.config.use_pairs) sum += log_pairs(problem.data, model, columns, sums.pairs);
  if (problem.config.use_singles) sum += log_singles(problem.data.viewpoints.singles, sums.singles);
  return sum;
}

JointState state_of(const JointProblem& problem, JointModel model) {
  JointState state{.model = std::move(model), .columns = {}, .log_likelihood = 0.0};
  state.columns.resize(state.model.sources.size());
  for (std::size_t k = 0; k < state.columns.size(); ++k) {
    fill_column(physics_of(problem.physics, state.model, k), problem.data, state.model.sources[k].p_W,
                state.columns[k]);
  }
  state.log_likelihood = log_likelihood(problem, state.model, state.columns);
  return state;
}

}  // namespace comptonaut
