// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/mlem_estimator.h"

#include <utility>

#include "radiation/cone_row.h"
#include "radiation/mlem.h"
#include "radiation/sensitivity.h"

namespace comptonaut {

MlemEstimator::MlemEstimator(const MlemConfig& config, const Cells& cells, std::string nuclide,
                             ResponseLookup pair_response)
    : config_(config),
      cells_(cells),
      nuclide_(std::move(nuclide)),
      pair_response_(std::move(pair_response)),
      rows_(cells.size()),
      sensitivity_s_(padded(cells.size()), 0.0),
      lambda_Bq_(padded(cells.size()), 0.0),
      row_(padded(cells.size()), 0.0F) {}

void MlemEstimator::add(const MeasurementBatch& batch) {
  if (batch.live_us > 0) {
    const Viewpoint viewpoint{.p_WD = batch.p_WD, .q_WD = batch.q_WD, .live_s = seconds(batch.live_us)};
    add_sensitivity(cells_, pair_response_, config_.attenuation_per_m, viewpoint, sensitivity_s_);
    ++viewpoints_;
  }
  for (const Cone& cone : batch.cones) {
    if (batch.channels.at(static_cast<std::size_t>(cone.channel)).nuclide != nuclide_) continue;
    fill_cone_row(cells_, pair_response_, config_, cone, batch.q_WD, row_);
    if (!rows_.add(row_)) ++cones_outside_;
  }
}

void MlemEstimator::update() { lambda_Bq_ = mlem(rows_, sensitivity_s_, config_.iterations); }

}  // namespace comptonaut
