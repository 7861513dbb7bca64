// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_estimate.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "nodes/map_tiles.h"
#include "radiation/local_maxima.h"
#include "radiation/map_sources.h"
#include "radiation/response_lookup.h"

namespace comptonaut {
namespace {

/// The cell whose centre is nearest to a place, of those in its column if there are any.
std::size_t nearest_cell(const Cells& cells, const Eigen::Vector3d& p_W) {
  if (const auto at = cells.find(voxel_at(p_W, cells.cell_m()))) return *at;
  std::size_t nearest = 0;
  for (std::size_t j = 1; j < cells.size(); ++j) {
    if ((cells.p_W(j) - p_W).squaredNorm() < (cells.p_W(nearest) - p_W).squaredNorm()) nearest = j;
  }
  return nearest;
}

template <class Estimate>
void strongest_first(std::vector<Estimate>& estimates) {
  std::stable_sort(estimates.begin(), estimates.end(),
                   [](const Estimate& a, const Estimate& b) { return a.activity_Bq > b.activity_Bq; });
}

}  // namespace

TeamEstimate::TeamEstimate(const CoordinatorConfig& config, const Cells& cells, const ResponseTable& response,
                           const std::optional<ConeDensity>& cones, const std::vector<MoreNuclide>& more,
                           const World& world)
    : config_(config), cells_(cells) {
  if (config.estimator == "mlem") {
    if (!more.empty()) throw std::invalid_argument("estimator 'mlem' knows one nuclide; more_nuclides need 'joint'");
    pair_response_ = pair_lookup(response);
    mlem_.emplace(config.mlem, cells, config.nuclide, *pair_response_, world, config.obstacle_attenuation_per_m);
    maps_.push_back({.nuclide = config.nuclide, .lambda_Bq = {}, .sensitivity_s = {}});
  } else if (config.estimator == "joint") {
    if (!cones) throw std::invalid_argument("estimator 'joint' needs cone_density, the file of the nuclide's cones");
    for (JointChannel& channel : joint_channels(config, {response, *cones}, more)) {
      maps_.push_back({.nuclide = channel.nuclide, .lambda_Bq = {}, .sensitivity_s = {}});
      joint_.emplace_back(channel.config, cells, channel.nuclide, std::move(channel.physics), world);
    }
  } else {
    throw std::invalid_argument(fmt::format("estimator '{}' is unknown, must be mlem or joint", config.estimator));
  }
  points_.resize(joint_.size());
  for (NuclideMap& map : maps_) map.lambda_Bq.resize(cells.size()), map.sensitivity_s.resize(cells.size());
}

void TeamEstimate::set_terrain(const World& world) {
  if (mlem_) {
    mlem_.emplace(config_.mlem, cells_, config_.nuclide, *pair_response_, world, config_.obstacle_attenuation_per_m);
    for (const MeasurementBatch& batch : added_) mlem_->add(batch);
  }
  for (JointEstimator& joint : joint_) joint.set_terrain(cells_, world);
}

void TeamEstimate::add(const MeasurementBatch& batch) {
  if (mlem_) {
    mlem_->add(batch);
    added_.push_back(batch);
  }
  for (JointEstimator& joint : joint_) joint.add(batch);
}

std::vector<KnownSource> TeamEstimate::known_above(std::size_t nuclide) const {
  std::vector<KnownSource> known;
  for (std::size_t above = nuclide + 1; above < joint_.size(); ++above) {
    for (const SourceEstimate& source : points_[above]) {
      Eigen::Matrix2d covariance_m2 = source.position_sigma_m.head<2>().array().square().matrix().asDiagonal();
      covariance_m2(0, 1) = covariance_m2(1, 0) = source.position_cov_xy_m2;
      known.push_back({.other = above - nuclide - 1,
                       .source = {.p_W = source.p_W, .activity_Bq = source.activity_Bq},
                       .place_information = covariance_m2.inverse(),
                       .activity_rel_sigma =
                           std::hypot(config_.joint.known_rel_sigma, source.activity_sigma_Bq / source.activity_Bq)});
    }
  }
  return known;
}

void TeamEstimate::place_above(std::size_t nuclide) {
  auto known = joint_[nuclide].known().begin();
  for (std::size_t above = nuclide + 1; above < joint_.size(); ++above) {
    for (SourceEstimate& source : points_[above]) {
      source.p_W = known->p_W;
      source.position_sigma_m = known->position_sigma_m;
      source.position_cov_xy_m2 = known->position_cov_xy_m2;
      ++known;
    }
  }
}

std::vector<SourceEstimate> TeamEstimate::sources(std::size_t nuclide) const {
  const std::vector<SourceEstimate>&points = joint_[nuclide].points(), &shown = joint_[nuclide].sources();
  std::vector<SourceEstimate> sources;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool is_shown = std::ranges::any_of(shown, [&](const auto& one) { return one.p_W == points[k].p_W; });
    if (is_shown) sources.push_back(points_[nuclide][k]);
  }
  return sources;
}

/// From the highest line down.
void TeamEstimate::update() {
  if (mlem_) {
    mlem_->update();
    const auto lambda_Bq = mlem_->lambda_Bq(), sensitivity_s = mlem_->sensitivity_s();
    maps_[0].lambda_Bq.assign(lambda_Bq.begin(), lambda_Bq.end());
    maps_[0].sensitivity_s.assign(sensitivity_s.begin(), sensitivity_s.end());
  }
  for (std::size_t i = joint_.size(); i-- > 0;) {
    JointEstimator& joint = joint_[i];
    joint.set_known(known_above(i));
    joint.update();
    points_[i] = joint.points();
    place_above(i);
    maps_[i].lambda_Bq = joint.ground_map().lambda_Bq();
    maps_[i].sensitivity_s = joint.ground_map().sensitivity_s();
    map_steps_ += joint.map_convergence().steps;
    if (!joint.map_convergence().reached) ++map_unconverged_;
  }
}

TeamEstimate::Ground TeamEstimate::ground() const {
  Ground ground{.lambda_Bq = maps_[0].lambda_Bq, .pair_sensitivity_s = maps_[0].sensitivity_s};
  for (std::size_t i = 1; i < maps_.size(); ++i) {
    for (std::size_t j = 0; j < cells_.size(); ++j) ground.lambda_Bq[j] += maps_[i].lambda_Bq[j];
  }
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    for (const SourceEstimate& source : sources(i)) {
      ground.lambda_Bq[nearest_cell(cells_, source.p_W)] += source.activity_Bq;
    }
  }
  if (!joint_.empty()) ground.pair_sensitivity_s = joint_[0].ground_map().pair_sensitivity_s();
  return ground;
}

std::vector<std::vector<Look>> TeamEstimate::looks() const {
  std::vector<std::vector<Look>> looks;
  for (const JointEstimator& joint : joint_) looks.push_back(joint.looks());
  return looks;
}

std::optional<PatchReport> TeamEstimate::patches() const {
  if (mlem_) return std::nullopt;
  PatchReport report;
  for (const JointEstimator& joint : joint_) {
    report.patches.insert(report.patches.end(), joint.patches().begin(), joint.patches().end());
  }
  strongest_first(report.patches);
  return report;
}

std::vector<ClearanceTile> TeamEstimate::clearance() const {
  std::vector<ClearanceTile> all;
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    for (ClearanceTile& tile : clearance_tiles(joint_[i].clearance_places(), joint_[i].clear_above_Bq())) {
      tile.nuclide = maps_[i].nuclide;
      all.push_back(std::move(tile));
    }
  }
  return all;
}

SourceReport TeamEstimate::report() const {
  SourceReport report{.estimator = config_.estimator};
  if (!joint_.empty()) {
    report.coverage = 1.0;
    report.certificate = 0.0;
    for (std::size_t i = 0; i < joint_.size(); ++i) {
      report.coverage = std::min(report.coverage, joint_[i].coverage());
      report.certificate = std::max(report.certificate, joint_[i].certificate_s());
      std::ranges::copy(sources(i), std::back_inserter(report.sources));
    }
    strongest_first(report.sources);
    const auto sources_max = static_cast<std::size_t>(config_.joint.sources_max);
    if (report.sources.size() > sources_max) report.sources.resize(sources_max);
    return report;
  }
  const auto s = mlem_->sensitivity_s();
  const double s_min_s = config_.search.werner2024.s_min_s;
  const auto searched = std::count_if(s.begin(), s.end(), [s_min_s](double s_j) { return s_j >= s_min_s; });
  report.coverage = static_cast<double>(searched) / static_cast<double>(s.size());
  report.sources = sources_of_map(cells_, mlem_->lambda_Bq(), local_maxima(cells_, mlem_->lambda_Bq()), config_.nuclide,
                                  config_.mlem.source_radius_m);
  return report;
}

std::int64_t TeamEstimate::rows() const {
  if (mlem_) return mlem_->rows();
  std::int64_t pairs = 0;
  for (const JointEstimator& joint : joint_) pairs += std::ssize(joint.data().pairs);
  return pairs;
}

std::int64_t TeamEstimate::viewpoints() const {
  return mlem_ ? mlem_->viewpoints() : static_cast<std::int64_t>(joint_[0].data().viewpoints.size());
}

std::vector<Counter> TeamEstimate::counters() const {
  if (mlem_) return {{"cones", mlem_->rows()}, {"cones_outside", mlem_->cones_outside()}};
  std::int64_t doubtful = 0;
  for (const JointEstimator& joint : joint_) doubtful += joint.doubtful();
  return {{"pairs", rows()},
          {"map_steps", map_steps_},
          {"map_updates_unconverged", map_unconverged_},
          {"sources_doubtful", doubtful}};
}

}  // namespace comptonaut
