// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/seen_nodes.h"

#include <algorithm>

namespace comptonaut {
namespace {

constexpr std::size_t kPoints = 4;

/// Of four points side by side, then of one each.
std::vector<double> means(const std::vector<double>& values, std::size_t merged, std::size_t single) {
  std::vector<double> result(merged + single);
  for (std::size_t i = 0; i < merged; ++i) {
    const double* four = &values[kPoints * i];
    result[i] = 0.25 * ((four[0] + four[1]) + (four[2] + four[3]));
  }
  for (std::size_t i = 0; i < single; ++i) result[merged + i] = values[kPoints * merged + i];
  return result;
}

/// f(view, i, place) for each point, seen in chunks.
template <typename F>
void for_each_point(const CellCentres& points, const Eye& eye, const F& f) {
  View view;
  for (std::size_t first = 0; first < points.size; first += kChunk) {
    const std::size_t n = std::min(kChunk, points.size - first);
    see(points, first, padded(n), eye, view);
    for (std::size_t i = 0; i < n; ++i) f(view, i, first + i);
  }
}

}  // namespace

NodePoints::NodePoints(const GroundTree& tree, std::span<const std::uint32_t> nodes) {
  const auto add = [&](const Eigen::Vector3d& p_W, double dx_m, double dy_m) {
    points.x_m.push_back(p_W.x() + dx_m);
    points.y_m.push_back(p_W.y() + dy_m);
    points.z_m.push_back(p_W.z());
  };
  for (const std::uint32_t at : nodes) {
    const GroundNode& node = tree.nodes()[at];
    const double x = node.sigma_x_m, y = node.sigma_y_m;
    if (node.cells == 1) {
      ++single;
      add(node.p_W, 0, 0);
    } else {
      ++merged;
      for (const auto& [dx_m, dy_m] : {std::pair(-x, -y), {x, -y}, {-x, y}, {x, y}}) add(node.p_W, dx_m, dy_m);
    }
  }
  points.size = points.x_m.size();
  for (std::vector<double>* axis_m : {&points.x_m, &points.y_m, &points.z_m}) {
    axis_m->resize(padded(points.size), axis_m->back());
  }
}

NodeResponse node_response(const JointPhysics& physics, const NodePoints& nodes, const Eye& eye) {
  std::vector<double> single(nodes.points.size), pair(nodes.points.size);
  for_each_point(nodes.points, eye, [&](const View& view, std::size_t i, std::size_t at) {
    const Response L = physics.response(view.x_D[i], view.y_D[i], view.z_D[i] + kSomewhere_m);
    single[at] = view.weight_per_m2[i] * L.single;
    pair[at] = view.weight_per_m2[i] * L.pair;
  });
  return {.single = means(single, nodes.merged, nodes.single), .pair = means(pair, nodes.merged, nodes.single)};
}

std::vector<double> node_density(const JointPhysics& physics, const NodePoints& nodes, const Pair& pair) {
  const Eye eye{.p_W = pair.p_WS, .R_DW = pair.R_DW, .attenuation_per_m = physics.attenuation_per_m};
  std::vector<double> density(nodes.points.size, 0.0);
  for (const Hypothesis& hypothesis : pair.hypotheses) {
    const Eigen::Vector3d axis_D = pair.R_DW * hypothesis.axis_W;
    for_each_point(nodes.points, eye, [&](const View& view, std::size_t i, std::size_t at) {
      const double along_m = view.x_D[i] * axis_D.x() + view.y_D[i] * axis_D.y() + view.z_D[i] * axis_D.z();
      const double cosine = std::clamp(along_m / view.d_m[i], -1.0, 1.0);
      density[at] += hypothesis.weight * physics.cones.per_sr(pair.readings, hypothesis.beta_rad, cosine);
    });
  }
  for_each_point(nodes.points, eye, [&](const View& view, std::size_t i, std::size_t at) {
    const double L = physics.response(view.x_D[i], view.y_D[i], view.z_D[i] + kSomewhere_m).pair;
    density[at] *= view.weight_per_m2[i] * L;
  });
  return means(density, nodes.merged, nodes.single);
}

}  // namespace comptonaut
