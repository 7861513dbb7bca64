// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/seen_nodes.h"

#include <algorithm>
#include <array>

#include "core/simd.h"
#include "radiation/view_response.h"

namespace comptonaut {
namespace {

/// Where points lie along an axis, in standard deviations, and what each of three counts.
constexpr std::array<double, 2> kTwo = {-1.0, 1.0};
constexpr std::array<double, 3> kThree = {-1.3416407864998738, 0.0, 1.3416407864998738};  // square root of 1.8
constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
constexpr double kSquare = 0.8;  // mean of (t^2 - 1)^2 over the three

std::span<const double> rule_of(int per_axis) {
  return per_axis == 2 ? std::span<const double>(kTwo) : std::span<const double>(kThree);
}

COMPTONAUT_SIMD_CLONES
void move(const double* __restrict from_m, double by, const double* __restrict sigma_m, std::size_t n,
          double* __restrict to_m) {
  for (std::size_t i = 0; i < n; ++i) to_m[i] = from_m[i] + by * sigma_m[i];
}

/// Of four values of each of the merged nodes.
COMPTONAUT_SIMD_CLONES
void means(const double* __restrict values, std::size_t merged, double* __restrict mean) {
  const double *first = values, *second = first + merged, *third = second + merged, *fourth = third + merged;
  for (std::size_t i = 0; i < merged; ++i) mean[i] = 0.25 * ((first[i] + second[i]) + (third[i] + fourth[i]));
}

/// The parts of a NodeField one after another, each of all merged nodes.
constexpr std::size_t kParts = 6;

/// The polynomials whose terms, each orthogonal to the others over the node, are the nine values'.
COMPTONAUT_SIMD_CLONES
void fit(const double* __restrict values, const double* __restrict sigma_x_m, const double* __restrict sigma_y_m,
         std::size_t merged, double* __restrict parts) {
  for (std::size_t i = 0; i < merged; ++i) {
    double mean = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
#pragma GCC unroll 9
    for (std::size_t p = 0; p < 9; ++p) {
      const double u = kThree[p % 3], v = kThree[p / 3];
      const double f = kWeight[p % 3] * kWeight[p / 3] * values[p * merged + i];
      mean += f;
      x += f * u;
      y += f * v;
      xx += f * (u * u - 1.0) / kSquare;
      xy += f * u * v;
      yy += f * (v * v - 1.0) / kSquare;
    }
    const double per_x = sigma_x_m[i] > 0.0 ? 1.0 / sigma_x_m[i] : 0.0;
    const double per_y = sigma_y_m[i] > 0.0 ? 1.0 / sigma_y_m[i] : 0.0;
    parts[i] = mean - xx - yy;
    parts[merged + i] = x * per_x;
    parts[2 * merged + i] = y * per_y;
    parts[3 * merged + i] = xx * per_x * per_x;
    parts[4 * merged + i] = xy * per_x * per_y;
    parts[5 * merged + i] = yy * per_y * per_y;
  }
}

}  // namespace

NodePoints::NodePoints(const GroundTree& tree, std::span<const std::uint32_t> nodes, int per_axis) {
  const auto of = [&](std::size_t i) -> const GroundNode& { return tree.nodes()[nodes[i]]; };
  while (merged < nodes.size() && of(merged).cells > 1) ++merged;
  single = nodes.size() - merged;
  const std::span<const double> rule = rule_of(per_axis);
  points.size = rule.size() * rule.size() * merged + single;
  for (std::vector<double>* axis_m : {&points.x_m, &points.y_m, &points.z_m}) axis_m->resize(padded(points.size));
  sigma_x_m.resize(merged);
  sigma_y_m.resize(merged);
  std::vector<double> x_m(merged), y_m(merged), z_m(merged);
  for (std::size_t i = 0; i < merged; ++i) {
    const GroundNode& node = of(i);
    x_m[i] = node.p_W.x(), y_m[i] = node.p_W.y(), z_m[i] = node.p_W.z();
    sigma_x_m[i] = node.sigma_x_m, sigma_y_m[i] = node.sigma_y_m;
  }
  std::size_t at = 0;
  for (const double v : rule) {
    for (const double u : rule) {
      move(x_m.data(), u, sigma_x_m.data(), merged, &points.x_m[at]);
      move(y_m.data(), v, sigma_y_m.data(), merged, &points.y_m[at]);
      std::copy(z_m.begin(), z_m.end(), points.z_m.begin() + static_cast<std::ptrdiff_t>(at));
      at += merged;
    }
  }
  for (std::size_t i = merged; at < padded(points.size); ++i, ++at) {
    const Eigen::Vector3d& p_W = of(std::min(i, nodes.size() - 1)).p_W;
    points.x_m[at] = p_W.x(), points.y_m[at] = p_W.y(), points.z_m[at] = p_W.z();
  }
}

void PointSums::add(const JointPhysics& physics, const NodePoints& nodes, const Eye& eye, double live_s) {
  std::array<double, kChunk> of_singles, of_pairs;
  for_each_chunk(nodes.points, eye, [&](const View& view, std::size_t first, std::size_t n) {
    respond(physics.response, view, n, of_singles.data(), of_pairs.data());
    accumulate(of_singles.data(), view.weight_per_m2.data(), live_s, &single[first], n);
    accumulate(of_pairs.data(), view.weight_per_m2.data(), live_s, &pair[first], n);
  });
}

std::vector<NodeField> fitted(const NodePoints& nodes, const std::vector<double>& values) {
  const std::size_t merged = nodes.merged;
  std::vector<double> parts(kParts * merged);
  fit(values.data(), nodes.sigma_x_m.data(), nodes.sigma_y_m.data(), merged, parts.data());
  std::vector<NodeField> result;
  result.reserve(merged + nodes.single);
  for (std::size_t i = 0; i < merged; ++i) {
    const double* part = &parts[i];
    result.push_back({part[0], part[merged], part[2 * merged], part[3 * merged], part[4 * merged], part[5 * merged]});
  }
  for (std::size_t i = 9 * merged; i < values.size(); ++i) result.push_back({.value = values[i]});
  return result;
}

std::vector<double> node_density(const JointPhysics& physics, const NodePoints& nodes, const Pair& pair) {
  const Eye eye{.p_W = pair.p_WS, .R_DW = pair.R_DW, .attenuation_per_m = physics.attenuation_per_m};
  std::vector<double> density(nodes.points.size);
  for_each_chunk(nodes.points, eye, [&](const View& view, std::size_t first, std::size_t n) {
    pair_densities(physics, pair, view, n, &density[first]);
  });
  std::vector<double> result(nodes.merged + nodes.single);
  means(density.data(), nodes.merged, result.data());
  std::copy(density.end() - static_cast<std::ptrdiff_t>(nodes.single), density.end(),
            result.begin() + static_cast<std::ptrdiff_t>(nodes.merged));
  return result;
}

}  // namespace comptonaut
