// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

#include "detector/event_batch.h"
#include "radiation/measurement_batch.h"

namespace comptonaut {

/// The detector's pose at one moment; nullopt where it is not known.
using DetectorPose = std::function<std::optional<Eigen::Isometry3d>(Utime)>;

/// A cone in W for each hypothesis of each pair that is physical, from where the detector was when its photon came.
/// A photon whose moment has no pose makes none.
[[nodiscard]] std::vector<Cone> to_cones(const EventBatch& events, const DetectorPose& X_WD_at);

/// The batch, and batches of the same time for the cones that are more than kMaxConesPerBatch; those have no live time
/// and no counts. Hypotheses of one photon stay together.
[[nodiscard]] std::vector<MeasurementBatch> in_datagrams(MeasurementBatch batch);

}  // namespace comptonaut
