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
      blocks_(cells),
      nuclide_(std::move(nuclide)),
      pair_response_(std::move(pair_response)),
      rows_(cells.size()),
      sensitivity_s_(padded(cells.size()), 0.0),
      lambda_Bq_(padded(cells.size()), 0.0) {
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
    fill_cone_row(blocks_, pair_response_, config_, cone, batch.q_WD, row_, let_through(cone.p_WS));
    if (!rows_.add(row_, config_.row_cut)) ++cones_outside_;
  }
}

void MlemEstimator::update() {
  const std::vector<double> s = blocks_.by_block(sensitivity_s_);
  std::vector<double> lambda_Bq = mlem(rows_, s, std::max(1, config_.iterations - 1));
  if (config_.iterations > 1) {
    const std::vector<double> before_Bq = lambda_Bq;
    mlem_step(rows_, s, lambda_Bq);
    double moved = 0.0, all = 0.0;
    for (std::size_t j = 0; j < s.size(); ++j) {
      moved += s[j] * std::abs(lambda_Bq[j] - before_Bq[j]);
      all += s[j] * lambda_Bq[j];
    }
    change_ = all > 0.0 ? 0.5 * moved / all : 0.0;
  }
  lambda_Bq_ = blocks_.by_cell(lambda_Bq);
}

}  // namespace comptonaut
