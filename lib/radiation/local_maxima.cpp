// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/local_maxima.h"

#include <algorithm>

namespace comptonaut {
namespace {

bool has_higher_neighbour(const Cells& cells, std::span<const double> value, std::uint32_t j) {
  const auto neighbours = cells.neighbours(j);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t k) { return value[k] > value[j]; });
}

/// Walks the whole plateau of cell j, marking its cells; whether nothing around it is higher.
bool plateau_is_maximum(const Cells& cells, std::span<const double> value, std::uint32_t j, std::vector<bool>& seen) {
  bool maximum = true;
  std::vector<std::uint32_t> open{j};
  seen[j] = true;
  while (!open.empty()) {
    const std::uint32_t cell = open.back();
    open.pop_back();
    maximum = maximum && !has_higher_neighbour(cells, value, cell);
    for (const std::uint32_t k : cells.neighbours(cell)) {
      if (seen[k] || value[k] != value[cell]) continue;
      seen[k] = true;
      open.push_back(k);
    }
  }
  return maximum;
}

}  // namespace

std::vector<std::uint32_t> local_maxima(const Cells& cells, std::span<const double> value) {
  std::vector<std::uint32_t> maxima;
  std::vector<bool> seen(cells.size(), false);
  for (std::uint32_t j = 0; j < cells.size(); ++j) {
    if (!(value[j] > 0.0) || seen[j]) continue;
    if (plateau_is_maximum(cells, value, j, seen)) maxima.push_back(j);
  }
  std::stable_sort(maxima.begin(), maxima.end(), [&](auto a, auto b) { return value[a] > value[b]; });
  return maxima;
}

}  // namespace comptonaut
