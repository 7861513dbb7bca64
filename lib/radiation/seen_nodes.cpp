// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/seen_nodes.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

/// Where points lie along an axis, in standard deviations, and what each counts.
struct PointRule {
  std::vector<double> at, weight;
};
const PointRule& rule_of(int per_axis) {
  static const double far = std::sqrt(1.8);
  static const PointRule two{.at = {-1.0, 1.0}, .weight = {0.5, 0.5}},
      three{.at = {-far, 0.0, far}, .weight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0}};
  return per_axis == 2 ? two : three;
}

/// Of four points side by side, then of one each.
std::vector<double> means(const NodePoints& nodes, const std::vector<double>& values) {
  std::vector<double> result;
  for (std::size_t i = 0; i < nodes.merged; ++i) {
    const double* four = &values[4 * i];
    result.push_back(0.25 * ((four[0] + four[1]) + (four[2] + four[3])));
  }
  result.insert(result.end(), values.begin() + static_cast<std::ptrdiff_t>(4 * nodes.merged), values.end());
  return result;
}

/// The polynomial whose terms, each orthogonal to the others over the node, are the nine values'.
NodeField fitted(const double* values, double sigma_x_m, double sigma_y_m) {
  const PointRule& rule = rule_of(3);
  constexpr double kSquare = 0.8;  // mean of (t^2 - 1)^2 over the rule
  double mean = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double f = rule.weight[i] * rule.weight[j] * *values++, u = rule.at[i], v = rule.at[j];
      mean += f;
      x += f * u;
      y += f * v;
      xx += f * (u * u - 1.0) / kSquare;
      xy += f * u * v;
      yy += f * (v * v - 1.0) / kSquare;
    }
  }
  const double per_x = sigma_x_m > 0.0 ? 1.0 / sigma_x_m : 0.0, per_y = sigma_y_m > 0.0 ? 1.0 / sigma_y_m : 0.0;
  return {mean - xx - yy, x * per_x, y * per_y, xx * per_x * per_x, xy * per_x * per_y, yy * per_y * per_y};
}

std::vector<NodeField> fields(const NodePoints& nodes, const std::vector<double>& values) {
  std::vector<NodeField> result;
  result.reserve(nodes.merged + nodes.single);
  for (std::size_t i = 0; i < nodes.merged; ++i) {
    result.push_back(fitted(&values[9 * i], nodes.sigma_x_m[i], nodes.sigma_y_m[i]));
  }
  for (std::size_t i = 9 * nodes.merged; i < values.size(); ++i) result.push_back({.value = values[i]});
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

NodePoints::NodePoints(const GroundTree& tree, std::span<const std::uint32_t> nodes, int points_per_axis)
    : per_axis(points_per_axis) {
  const auto add = [&](const Eigen::Vector3d& p_W, double dx_m, double dy_m) {
    points.x_m.push_back(p_W.x() + dx_m);
    points.y_m.push_back(p_W.y() + dy_m);
    points.z_m.push_back(p_W.z());
  };
  const PointRule& rule = rule_of(per_axis);
  for (const std::uint32_t at : nodes) {
    const GroundNode& node = tree.nodes()[at];
    if (node.cells == 1) {
      ++single;
      add(node.p_W, 0, 0);
      continue;
    }
    ++merged;
    sigma_x_m.push_back(node.sigma_x_m);
    sigma_y_m.push_back(node.sigma_y_m);
    for (const double v : rule.at) {
      for (const double u : rule.at) add(node.p_W, u * node.sigma_x_m, v * node.sigma_y_m);
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
  return {.single = fields(nodes, single), .pair = fields(nodes, pair)};
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
  return means(nodes, density);
}

}  // namespace comptonaut
