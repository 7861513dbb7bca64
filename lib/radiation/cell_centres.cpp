// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cell_centres.h"

#include <algorithm>

namespace comptonaut {

CellCentres::CellCentres(const Cells& cells) : size(cells.size()) {
  for (std::size_t i = 0; size > 0 && i < padded(size); ++i) {
    const Eigen::Vector3d& p_W = cells.p_W(std::min(i, size - 1));
    x_m.push_back(p_W.x());
    y_m.push_back(p_W.y());
    z_m.push_back(p_W.z());
  }
}

}  // namespace comptonaut
