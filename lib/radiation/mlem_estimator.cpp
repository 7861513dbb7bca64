// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/mlem_estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiation/cone_row.h"
#include "radiation/mlem.h"
#include "radiation/sensitivity.h"

namespace comptonaut {

MlemEstimator::MlemEstimator(const MlemConfig& config, const Cells& cells, std::string nuclide,
                             ResponseLookup pair_response, const World& world, double obstacles_per_m)
    : config_(config),
      cells_(cells),
      nuclide_(std::move(nuclide)),
      pair_response_(std::move(pair_response)),
      rows_(cells.size()),
      sensitivity_s_(padded(cells.size()), 0.0),
      lambda_Bq_(padded(cells.size()), 0.0),
      row_(padded(cells.size()), 0.0F) {
  if (world.is_flat()) return;
  for (std::size_t j = 0; j < cells.size(); ++j) places_W_.push_back(cells.p_W(j));
  sight_.emplace(world, obstacles_per_m);
}

std::span<const float> MlemEstimator::let_through(const Eigen::Vector3d& eye_W) {
  return sight_ ? sight_->shares(eye_W, places_W_) : std::span<const float>{};
}

void MlemEstimator::add(const MeasurementBatch& batch) {
  if (batch.live_us > 0) {
    const Viewpoint viewpoint{.p_WD = batch.p_WD, .q_WD = batch.q_WD, .live_s = seconds(batch.live_us)};
    add_sensitivity(cells_, pair_response_, config_.attenuation_per_m, viewpoint, sensitivity_s_,
                    let_through(batch.p_WD));
    ++viewpoints_;
  }
  for (const Cone& cone : batch.cones) {
    if (batch.channels.at(static_cast<std::size_t>(cone.channel)).nuclide != nuclide_) continue;
    fill_cone_row(cells_, pair_response_, config_, cone, batch.q_WD, row_, let_through(cone.p_WS));
    if (!rows_.add(row_)) ++cones_outside_;
  }
}

void MlemEstimator::update() {
  lambda_Bq_ = mlem(rows_, sensitivity_s_, std::max(1, config_.iterations - 1));
  if (config_.iterations < 2) return;
  const std::vector<double> before_Bq = lambda_Bq_;
  mlem_step(rows_, sensitivity_s_, lambda_Bq_);
  double moved = 0.0, all = 0.0;
  for (std::size_t j = 0; j < lambda_Bq_.size(); ++j) {
    moved += sensitivity_s_[j] * std::abs(lambda_Bq_[j] - before_Bq[j]);
    all += sensitivity_s_[j] * lambda_Bq_[j];
  }
  change_ = all > 0.0 ? 0.5 * moved / all : 0.0;
}

}  // namespace comptonaut
