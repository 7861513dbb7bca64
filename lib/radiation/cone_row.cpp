// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cone_row.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "radiation/cone_kernel.h"

namespace comptonaut {
namespace {

/// t *= L and what obstacles let through.
void respond(const CellBlocks& cells, std::size_t first, const GroupSeen& seen, const Directions& directions,
             const ResponseLookup& response, std::span<const float> let_through, float* t) {
  alignas(64) std::array<float, kGroup * kBlock> value;
  response(directions.x_D.data(), directions.y_D.data(), directions.z_D.data(), value.data(), seen.n_live * kBlock);
  multiply(t, value.data(), seen.n_live * kBlock);
  for (std::size_t k = 0; !let_through.empty() && k < seen.n_live; ++k) {
    const std::uint32_t* its = &cells.cells[(first + seen.live[k]) * kBlock];
    for (std::size_t i = 0; i < kBlock; ++i) t[k * kBlock + i] *= let_through[its[i]];
  }
}

}  // namespace

void fill_cone_row(const CellBlocks& cells, const ResponseLookup& response, const MlemConfig& config, const Cone& cone,
                   const Eigen::Quaterniond& q_WD, SparseRow& row, std::span<const float> let_through) {
  const ConeKernel kernel = make_cone_kernel(cone, q_WD.conjugate().toRotationMatrix(), config);
  GroupSeen seen;
  Directions directions;
  row.blocks.resize(cells.blocks());
  row.values.resize(cells.cells.size());
  std::size_t n = 0;
  for (std::size_t first = 0; first < cells.blocks(); first += kGroup) {
    see_group(cells, first, std::min(kGroup, cells.blocks() - first), kernel, seen);
    if (seen.n_live == 0) continue;
    float* t = &row.values[n * kBlock];
    cone_kernel(cells, first, seen, kernel, t, directions);
    respond(cells, first, seen, directions, response, let_through, t);
    for (std::size_t k = 0; k < seen.n_live; ++k) {
      row.blocks[n++] = static_cast<std::uint32_t>(first) + seen.live[k];
    }
  }
  row.blocks.resize(n);
  if (row.blocks.empty() || row.blocks.back() + 1 != cells.blocks()) return;
  float* past = &row.values[row.blocks.size() * kBlock];
  std::fill(past - (cells.cells.size() - cells.size), past, 0.0F);
}

}  // namespace comptonaut
