// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "radiation/cell_centres.h"
#include "radiation/view.h"

namespace comptonaut {

/// One detector's stay at one place.
struct Viewpoint {
  Eigen::Vector3d p_WD = Eigen::Vector3d::Zero();            ///< m
  Eigen::Quaterniond q_WD = Eigen::Quaterniond::Identity();  ///< rotates D to W
  double live_s = 0.0;                                       ///< Delta_v >= 0
};

/// Adds to each cell's s_j what one viewpoint adds to it for one kind of event (design, section 5):
///   s_j += L(u_jv) exp(-mu d_jv) / d_jv^2 Delta_v
/// `sensitivity_s` has padded(cells.size) elements; those of the padding are left alone.
void add_sensitivity(const CellCentres& cells, const ResponseLookup& response, double attenuation_per_m,
                     const Viewpoint& viewpoint, std::span<double> sensitivity_s,
                     std::span<const float> let_through = {});

}  // namespace comptonaut
