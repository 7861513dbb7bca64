// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_support.h"

#include <algorithm>

#include "radiation/curvature.h"
#include "radiation/map_projection.h"

namespace comptonaut {
namespace {

constexpr double kNothing = 1e-3;                                // expected counts: a cell of fewer is empty
constexpr double kSlopeMin = 1e-4;                               // per expected count
constexpr std::size_t kRoomMin = MapSupport::kVariablesMax / 8;  // for cells that join

/// Where the nodes that a block sees stand in its rows.
class Columns {
 public:
  Columns(const GroundTree& tree, std::span<const std::uint32_t> leaves) : place_(tree.nodes().size()) {
    for (const std::uint32_t leaf : leaves) {
      for (std::uint32_t node = leaf; first_.push_back(node), node != tree.nodes()[node].parent;) {
        node = tree.nodes()[node].parent;
      }
      start_.push_back(first_.size());
    }
  }

  /// Of each leaf, or of the node that holds it.
  const std::vector<std::uint32_t>& in(std::uint32_t block, std::span<const std::uint32_t> nodes) {
    for (std::uint32_t k = 0; k < nodes.size(); ++k) place_[nodes[k]] = {block, k};
    columns_.clear();
    for (std::size_t leaf = 0, at = 0; leaf < start_.size(); at = start_[leaf++]) {
      while (place_[first_[at]].block != block) ++at;
      columns_.push_back(place_[first_[at]].at);
    }
    return columns_;
  }

 private:
  struct Place {
    std::uint32_t block = ~0U, at = 0;
  };
  std::vector<Place> place_;          ///< per node: in the last block that saw it
  std::vector<std::uint32_t> first_;  ///< leaf by leaf: itself and the nodes that hold it, smallest first
  std::vector<std::size_t> start_;    ///< of the next leaf's
  std::vector<std::uint32_t> columns_;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> MapSupport::support(const MapState& from, const MapProjection& at) const {
  const std::vector<GroundNode>& nodes = rows_.tree().nodes();
  std::vector<std::uint32_t> leaves, joining;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].children > 0 || !(sensitivity_s_[i] > 0.0)) continue;
    if (sensitivity_s_[i] * from.lambda_Bq[i] > kNothing) {
      leaves.push_back(i);
    } else if (at.ratio[i] > 1.0 + kSlopeMin) {
      joining.push_back(i);
    }
  }
  const std::size_t rates = 2 * from.drones.size();
  if (leaves.size() + rates + kRoomMin > kVariablesMax) return {};
  const std::size_t room = std::min(joining.size(), kVariablesMax - rates - leaves.size());
  std::partial_sort(
      joining.begin(), joining.begin() + static_cast<std::ptrdiff_t>(room), joining.end(),
      [&](std::uint32_t a, std::uint32_t b) { return at.ratio[a] != at.ratio[b] ? at.ratio[a] > at.ratio[b] : a < b; });
  leaves.insert(leaves.end(), joining.begin(), joining.begin() + static_cast<std::ptrdiff_t>(room));
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

AlignedVector<float> MapSupport::curvature(const MapState& from, const MapProjection& at) const {
  const std::size_t n = leaves_.size() + 2 * from.drones.size();
  Curvature sum(n);
  Columns columns(rows_.tree(), leaves_);
  std::vector<float> per_count(leaves_.size());
  for (std::size_t k = 0; k < leaves_.size(); ++k) per_count[k] = static_cast<float>(1.0 / sensitivity_s_[leaves_[k]]);
  const std::vector<const float*> rows =
      rows_of(rows_.blocks(), problem_.config.use_singles, problem_.config.use_pairs);
  std::size_t done = 0;
  for (std::uint32_t b = 0; b < rows_.blocks().size(); ++b) {
    const MapBlock& block = rows_.blocks()[b];
    const std::vector<std::uint32_t>& in = columns.in(b, block.nodes);
    const auto add = [&](double response, std::size_t rate, double per_unit) {
      float* to = sum.next_row();
      const auto root = static_cast<double>(at.root_curvature[done]);
      const float *row = rows[done++], *next = rows[std::min(done, rows.size() - 1)];
      row_pick(row, in.data(), per_count.data(), static_cast<float>(root * response), to, in.size(), next);
      to[in.size() + rate] = static_cast<float>(root * per_unit);
    };
    for (const SinglesRow& row : block.singles) {
      if (!problem_.config.use_singles) break;
      const auto d = static_cast<std::size_t>(row.drone);
      add(from.drones[d].scale * scatter_, 2 * d, row.live_s / problem_.data.live_s[d]);
    }
    for (std::size_t r = 0; problem_.config.use_pairs && r < block.pairs.size(); ++r) {
      const auto d = static_cast<std::size_t>(problem_.data.pairs[block.pairs[r]].drone);
      add(from.drones[d].scale, 2 * d + 1, kIsotropic_per_sr / problem_.data.live_s[d]);
    }
  }
  return sum.finish();
}

std::optional<MapSupport::Step> MapSupport::step(const MapState& from, const MapProjection& at, double gain_min) {
  std::optional<std::vector<std::uint32_t>> leaves = support(from, at);
  if (!leaves) return {};
  if (curvature_.empty() || !std::includes(leaves_.begin(), leaves_.end(), leaves->begin(), leaves->end())) {
    leaves_ = std::move(*leaves);
    curvature_ = curvature(from, at);
  }
  Step result{.to = from};
  std::vector<double*> unknowns;
  std::vector<double> per_unit, slope;  // in expected counts
  const auto add = [&](double& unknown, double counts, double ratio) {
    unknowns.push_back(&unknown);
    per_unit.push_back(counts);
    slope.push_back(ratio - 1.0);
  };
  std::fill(result.to.lambda_Bq.begin(), result.to.lambda_Bq.end(), 0.0);
  for (const std::uint32_t leaf : leaves_) {
    result.to.lambda_Bq[leaf] = from.lambda_Bq[leaf];
    add(result.to.lambda_Bq[leaf], sensitivity_s_[leaf], at.ratio[leaf]);
  }
  for (std::size_t d = 0; d < from.drones.size(); ++d) {
    add(result.to.drones[d].singles_per_s, problem_.data.live_s[d], at.singles_ratio[d]);
    add(result.to.drones[d].pairs_per_s, problem_.data.live_s[d], at.pairs_ratio[d]);
  }
  std::vector<double> x;
  for (std::size_t k = 0; k < unknowns.size(); ++k) x.push_back(*unknowns[k] * per_unit[k]);
  const QuadraticStep best = quadratic_step(curvature_, slope, x, gain_min);
  result.gain = best.gain;
  const std::size_t rates_from = leaves_.size();
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const double least = k < rates_from ? 0.0 : 0.1 * x[k];  // rates stay positive
    *unknowns[k] = std::max(x[k] + best.step[k], least) / per_unit[k];
  }
  return result;
}

}  // namespace comptonaut
