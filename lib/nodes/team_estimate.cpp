// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

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

}  // namespace

TeamEstimate::TeamEstimate(const CoordinatorConfig& config, const Cells& cells, const ResponseTable& response,
                           const std::optional<ConeDensity>& cones)
    : config_(config), cells_(cells), lambda_Bq_(cells.size(), 0.0), sensitivity_s_(cells.size(), 0.0) {
  if (config.estimator == "mlem") {
    mlem_.emplace(config.mlem, cells, config.nuclide, pair_lookup(response));
  } else if (config.estimator == "joint") {
    if (!cones) throw std::invalid_argument("estimator 'joint' needs cone_density, the file of the nuclide's cones");
    joint_.emplace(config.joint, cells, config.nuclide, response, *cones);
  } else {
    throw std::invalid_argument(fmt::format("estimator '{}' is unknown, must be mlem or joint", config.estimator));
  }
}

void TeamEstimate::add(const MeasurementBatch& batch) { joint_ ? joint_->add(batch) : mlem_->add(batch); }

void TeamEstimate::update() {
  if (mlem_) return mlem_->update();
  joint_->update();
  lambda_Bq_ = joint_->ground_map().lambda_Bq();
  sensitivity_s_ = joint_->ground_map().sensitivity_s();
  map_steps_ += joint_->map_convergence().steps;
  if (!joint_->map_convergence().reached) ++map_unconverged_;
}

std::span<const double> TeamEstimate::lambda_Bq() const { return mlem_ ? mlem_->lambda_Bq() : lambda_Bq_; }

std::span<const double> TeamEstimate::sensitivity_s() const { return mlem_ ? mlem_->sensitivity_s() : sensitivity_s_; }

TeamEstimate::Ground TeamEstimate::ground() const {
  const std::span<const double> lambda_Bq = this->lambda_Bq(), s = sensitivity_s();
  Ground ground{.lambda_Bq = {lambda_Bq.begin(), lambda_Bq.end()}, .pair_sensitivity_s = {s.begin(), s.end()}};
  if (!joint_) return ground;
  for (const SourceEstimate& source : joint_->sources()) {
    ground.lambda_Bq[nearest_cell(cells_, source.p_W)] += source.activity_Bq;
  }
  ground.pair_sensitivity_s = joint_->ground_map().pair_sensitivity_s();
  return ground;
}

std::optional<PatchReport> TeamEstimate::patches() const {
  return joint_ ? std::optional(PatchReport{.patches = joint_->patches()}) : std::nullopt;
}

std::vector<ClearanceTile> TeamEstimate::clearance() const {
  if (!joint_) return {};
  return clearance_tiles(joint_->clearance_places(), joint_->clear_above_Bq());
}

SourceReport TeamEstimate::report() const {
  SourceReport report{.estimator = config_.estimator};
  if (joint_) {
    report.coverage = joint_->coverage();
    report.certificate = joint_->certificate_s();
    report.sources = joint_->sources();
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

std::int64_t TeamEstimate::rows() const { return mlem_ ? mlem_->rows() : std::ssize(joint_->data().pairs); }

std::int64_t TeamEstimate::viewpoints() const {
  return mlem_ ? mlem_->viewpoints() : static_cast<std::int64_t>(joint_->data().viewpoints.size());
}

std::vector<Counter> TeamEstimate::counters() const {
  if (mlem_) return {{"cones", mlem_->rows()}, {"cones_outside", mlem_->cones_outside()}};
  return {{"pairs", rows()}, {"map_steps", map_steps_}, {"map_updates_unconverged", map_unconverged_}};
}

}  // namespace comptonaut
