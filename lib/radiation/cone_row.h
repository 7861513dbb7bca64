// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "radiation/cell_blocks.h"
#include "radiation/measurement_batch.h"
#include "radiation/mlem_config.h"
#include "radiation/packed_rows.h"
#include "radiation/view.h"

namespace comptonaut {

/// Fills `row` with one cone's t_ij (design, section 5), where blocks are not all zeros:
///   t_ij = L(u_ij) exp(-mu d_ij) / d_ij^2 h(delta_ij),  h(delta) = exp(-(delta / sigma)^2 / 2)
///   delta_ij = angle(m_j - p_i, a_i) - beta_i
/// with h taken as zero where it is below core_cut. Single precision: within 1e-4 of each entry, a part of the rounding
/// of stored rows (packed_rows.h). `q_WD` rotates D to W. `let_through`: per cell, by obstacles; empty: all.
void fill_cone_row(const CellBlocks& cells, const ResponseLookup& response, const MlemConfig& config, const Cone& cone,
                   const Eigen::Quaterniond& q_WD, SparseRow& row, std::span<const float> let_through = {});

}  // namespace comptonaut
