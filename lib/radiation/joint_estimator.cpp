// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_estimator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "radiation/hiding_chance.h"
#include "radiation/pass_shifts.h"
#include "radiation/sight_lines.h"
#include "radiation/sure_loss.h"

namespace comptonaut {
namespace {

/// The lowest cell of a column is its ground, the others are walls beside it.
Ground ground_of(const Cells& cells, double height_max_m) {
  struct Column {
    double low_m, high_m;
  };
  auto column_at = std::make_shared<std::map<std::pair<std::int32_t, std::int32_t>, Column>>();
  bool walls = false;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    const std::pair key(cells.key(j).x, cells.key(j).y);
    Column& column = column_at->emplace(key, Column{p_W.z(), p_W.z()}).first->second;
    column = {.low_m = std::min(column.low_m, p_W.z()), .high_m = std::max(column.high_m, p_W.z())};
    walls = walls || column.high_m > column.low_m;
  }
  const double cell_m = cells.cell_m(), fallback_m = cells.p_W(0).z();
  const auto column = [column_at, cell_m, fallback_m](double x_m, double y_m) {
    const VoxelKey key = voxel_at({x_m, y_m, 0.0}, cell_m);
    const auto at = column_at->find({key.x, key.y});
    return at == column_at->end() ? Column{fallback_m, fallback_m} : at->second;
  };
  Ground ground{.area = bounding_area(cells), .height_max_m = height_max_m, .z_m = [column](double x_m, double y_m) {
                  return column(x_m, y_m).low_m;
                }};
  if (walls) {
    ground.wall_m = [column](double x_m, double y_m) {
      const auto [low_m, high_m] = column(x_m, y_m);
      return high_m - low_m;
    };
  }
  return ground;
}

double covered_share(const JointConfig& config, const std::vector<double>& sensitivity_s) {
  constexpr double kCovered = 0.05;
  const auto covered = std::count_if(sensitivity_s.begin(), sensitivity_s.end(), [&](double S) {
    return hiding_chance(S, config.activity_min_Bq, config.activity_max_Bq) < kCovered;
  });
  return static_cast<double>(covered) / static_cast<double>(sensitivity_s.size());
}

/// Log likelihood that is lost without source k, with all else as it is.
double loss_without(const JointProblem& problem, const JointState& state, std::size_t k) {
  JointModel model = state.model;
  model.sources[k].activity_Bq = 0.0;
  return state.log_likelihood - log_likelihood(problem, model, state.columns);
}

bool is_member(const SourceEstimate& estimate, const std::vector<SourceDisc>& discs, const JointModel& model) {
  return std::any_of(discs.begin(), discs.end(), [&](const SourceDisc& disc) {
    return std::any_of(disc.members.begin(), disc.members.end(),
                       [&](std::size_t k) { return model.sources[k].p_W == estimate.p_W; });
  });
}

/// Places of the channel's own sources that may be nothing but the edges of obstacles' shadows.
std::vector<Eigen::Vector3d> doubtful_of(const JointProblem& problem, const JointState& state) {
  std::vector<Eigen::Vector3d> places_W;
  for (std::size_t k = state.model.known.size(); problem.data.sight && k < state.model.sources.size(); ++k) {
    const bool sure = sure_loss(problem, state, k) >= problem.config.loss_to_drop;
    if (!sure) places_W.push_back(state.model.sources[k].p_W);
  }
  return places_W;
}

}  // namespace

JointEstimator::JointEstimator(const JointConfig& config, const Cells& cells, std::string nuclide,
                               const ResponseTable& response, const ConeDensity& cones)
    : JointEstimator(config, cells, std::move(nuclide),
                     {.response = SmoothResponse(response),
                      .cones = ConeTable(cones, config.attitude_sigma_rad),
                      .attenuation_per_m = config.attenuation_per_m}) {}

JointEstimator::JointEstimator(const JointConfig& config, const Cells& cells, std::string nuclide, JointPhysics physics,
                               const World& world)
    : config_(config),
      nuclide_(std::move(nuclide)),
      physics_(std::move(physics)),
      ground_(ground_of(cells, config.height_max_m)),
      map_(cells, config.score_spacing_m),
      ground_map_(new_map(cells)) {
  state_.model.scatter = 1.0 + config.scatter_share;
  if (!world.is_flat()) data_.sight = std::make_shared<SightLines>(world);
}

void JointEstimator::add(const MeasurementBatch& batch) { comptonaut::add(data_, batch, nuclide_); }

void JointEstimator::set_terrain(const Cells& cells, const World& world) {
  const Ground before = std::exchange(ground_, ground_of(cells, config_.height_max_m));
  for (PointSource& source : state_.model.sources) {
    const double above_m = std::max(0.0, height_m(before, source));
    source.p_W.z() = ground_.z_m(source.p_W.x(), source.p_W.y()) + above_m;
  }
  map_ = ScoreMap(cells, config_.score_spacing_m);
  ground_map_ = new_map(cells);
  data_.sight = world.is_flat() ? nullptr : std::make_shared<SightLines>(world);
}

/// A known source goes on from where this channel's data had moved it.
void JointEstimator::set_known(std::vector<KnownSource> known) {
  constexpr double kSame_m = 1.0;
  JointModel& model = state_.model;
  const auto own = model.sources.begin() + static_cast<std::ptrdiff_t>(model.known.size());
  std::vector<PointSource> sources;
  for (const KnownSource& of : known) {
    const auto before = std::find_if(model.sources.begin(), own, [&](const PointSource& source) {
      return (source.p_W - of.source.p_W).norm() < kSame_m;
    });
    sources.push_back({.p_W = before == own ? of.source.p_W : before->p_W, .activity_Bq = of.source.activity_Bq});
  }
  sources.insert(sources.end(), own, model.sources.end());
  model.sources = std::move(sources);
  model.known = std::move(known);
}

void JointEstimator::update() {
  state_.model.drones.resize(data_.senders.size());
  for (DroneModel& drone : state_.model.drones) {
    drone.drift.resize(drift_points(problem()), drone.drift.empty() ? 0.0 : drone.drift.back());
  }
  state_.model.response_spread = response_spread(config_, state_.model);
  state_ = state_of(problem(), std::move(state_.model));
  map_.extend(problem());
  improve(problem(), ground_, map_, updates_++, state_);
  if (!state_.model.sources.empty()) align(config_, physics_, ground_, data_, state_);
  discs_ = discs_of(problem(), ground_, state_, discs_);
  patches_ = patches_of(discs_, nuclide_);
  const std::vector<SourceEstimate> all = estimates_of(problem(), ground_, state_, nuclide_);
  const auto own = all.begin() + static_cast<std::ptrdiff_t>(state_.model.known.size());
  known_.assign(all.begin(), own);
  points_.assign(own, all.end());
  std::ranges::stable_sort(points_, std::greater(), &SourceEstimate::activity_Bq);
  estimates_ = points_;
  const std::vector<Eigen::Vector3d> doubtful_W = doubtful_of(problem(), state_);
  doubtful_ = std::ssize(doubtful_W);
  std::erase_if(estimates_, [&](const SourceEstimate& estimate) {
    return is_member(estimate, discs_, state_.model) || std::ranges::find(doubtful_W, estimate.p_W) != doubtful_W.end();
  });
  coverage_ = covered_share(config_, map_.corrected_sensitivity_s(problem(), state_));
  const Residuals pulls = residuals(problem(), state_);
  certificate_s_ = 0.0;
  for (const ScoreMaximum& maximum : map_.maxima(problem(), pulls, config_.candidates)) {
    certificate_s_ = std::max(certificate_s_, score(problem(), pulls, maximum.p_W));
  }
  if (config_.map_steps == 0) return;
  ground_map_.extend(physics_, data_);
  const JointState shown = without_members(problem(), state_, discs_);
  const Expected held = sources_only(problem(), shown.model, shown.columns);
  map_convergence_ = ground_map_.update(problem(), state_.model, held);
}

std::vector<Look> JointEstimator::looks() const {
  const Viewpoints& v = data_.viewpoints;
  const std::vector<double> singles = expected(problem(), state_.model, state_.columns).singles;
  std::vector<Look> looks;
  looks.reserve(singles.size());
  for (std::size_t i = 0; i < singles.size(); ++i) {
    looks.push_back({.p_WD = {v.x_m[i], v.y_m[i], v.z_m[i]},
                     .live_s = v.live_s[i],
                     .singles = v.singles[i],
                     .expected = singles[i],
                     .background = background(problem(), state_.model, i)});
  }
  return looks;
}

std::vector<double> JointEstimator::clear_above_Bq() const {
  constexpr double kChance = 0.05;
  return map_.clear_above_Bq(problem(), state_, kChance);
}

std::vector<SourceEstimate> estimates_of(const JointProblem& problem, const Ground& ground, const JointState& state,
                                         const std::string& nuclide) {
  const std::size_t n = state.model.sources.size();
  const ParameterLayout layout = layout_of(ground, state.model, all_of(n), true);
  Eigen::MatrixXd information = linearise(problem, state, layout).information;
  information.diagonal().array() += 1e-9;
  const Eigen::MatrixXd covariance = information.inverse();
  std::vector<Eigen::Matrix2d> places;
  for (std::size_t k = 0; k < n; ++k) {
    places.push_back(covariance.block<2, 2>(static_cast<Eigen::Index>(layout.x_m(k)), layout.x_m(k)));
  }
  const std::vector<Eigen::Matrix2d> shifts = pass_shifts(problem, state, places);
  std::vector<SourceEstimate> estimates;
  for (std::size_t k = 0; k < n; ++k) {
    const PointSource& source = state.model.sources[k];
    const Eigen::Matrix2d place = places[k] + shifts[k];
    SourceEstimate estimate{.nuclide = nuclide, .p_W = source.p_W, .activity_Bq = source.activity_Bq};
    estimate.position_sigma_m = {std::sqrt(place(0, 0)), std::sqrt(place(1, 1)), 0.0};
    const auto lifted = std::find(layout.lifted.begin(), layout.lifted.end(), k);
    if (lifted != layout.lifted.end()) {
      const auto z = static_cast<Eigen::Index>(layout.z_m(lifted - layout.lifted.begin()));
      estimate.position_sigma_m.z() = std::sqrt(covariance(z, z));
    }
    estimate.position_cov_xy_m2 = place(0, 1);
    estimate.activity_sigma_Bq = source.activity_Bq * std::sqrt(covariance(k, k));
    estimate.significance = loss_without(problem, state, k);
    estimates.push_back(estimate);
  }
  return estimates;
}

}  // namespace comptonaut
