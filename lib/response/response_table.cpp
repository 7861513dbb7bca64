// SPDX-License-Identifier: BSD-3-Clause
#include "response/response_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr std::size_t kMostEntries = 20'000;
constexpr std::size_t kMostCandidates = 2'000'000;

bool is_valid(const ResponseEntry& entry) {
  const auto chance = [](double value) { return value >= 0.0 && std::isfinite(value); };
  return std::abs(entry.phi_rad) <= 2.0 * std::numbers::pi && entry.theta_rad >= 0.0 &&
         entry.theta_rad <= std::numbers::pi && chance(entry.single) && chance(entry.single_rel_sigma) &&
         chance(entry.pair) && chance(entry.pair_rel_sigma);
}

/// A square of the unfolded octahedron.
struct MapSquare {
  double a = 0.0, b = 0.0;  ///< centre, -1..1
  double half = 1.0;
};

Eigen::Vector3d map_direction(double a, double b) {
  const double z = 1.0 - std::abs(a) - std::abs(b);
  if (z >= 0.0) return Eigen::Vector3d(a, b, z).normalized();
  return Eigen::Vector3d(std::copysign(1.0 - std::abs(b), a), std::copysign(1.0 - std::abs(a), b), z).normalized();
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)); }

/// Those of `among` that may be nearest to some direction in the square: at most twice its radius farther from its
/// centre than the nearest one. (A tenth more: its borders are not quite great circles.)
std::vector<std::uint32_t> nearest_in(const MapSquare& square, const std::vector<Eigen::Vector3d>& directions_D,
                                      const std::vector<std::uint32_t>& among) {
  const Eigen::Vector3d centre_D = map_direction(square.a, square.b);
  double radius_rad = 0.0;
  for (const double i : {-1.0, 0.0, 1.0}) {
    for (const double j : {-1.0, 0.0, 1.0}) {
      const Eigen::Vector3d border_D = map_direction(square.a + i * square.half, square.b + j * square.half);
      radius_rad = std::max(radius_rad, angle(centre_D, border_D));
    }
  }
  double best_rad = std::numbers::pi;
  for (const std::uint32_t i : among) best_rad = std::min(best_rad, angle(centre_D, directions_D[i]));
  std::vector<std::uint32_t> result;
  std::copy_if(among.begin(), among.end(), std::back_inserter(result),
               [&](std::uint32_t i) { return angle(centre_D, directions_D[i]) <= best_rad + 2.2 * radius_rad; });
  return result;
}

}  // namespace

Eigen::Vector3d direction_D(double phi_rad, double theta_rad) {
  return {std::sin(theta_rad) * std::cos(phi_rad), std::sin(theta_rad) * std::sin(phi_rad), std::cos(theta_rad)};
}

ResponseTable::ResponseTable(std::vector<ResponseEntry> entries, Facts facts)
    : entries_(std::move(entries)), facts_(std::move(facts)) {
  if (entries_.empty() || entries_.size() > kMostEntries) {
    throw std::invalid_argument(
        fmt::format("a response table of {} entries, must have 1 to {}", entries_.size(), kMostEntries));
  }
  std::vector<Eigen::Vector3d> directions_D;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const ResponseEntry& entry = entries_[i];
    if (!is_valid(entry)) {
      throw std::invalid_argument(
          fmt::format("response entry {}: phi {}, theta {}, single {}, pair {}: angles must be on "
                      "the sphere, values finite and not negative",
                      i, entry.phi_rad, entry.theta_rad, entry.single, entry.pair));
    }
    single_.push_back(entry.single);
    pair_.push_back(entry.pair);
    directions_D.push_back(direction_D(entry.phi_rad, entry.theta_rad));
  }
  fill_map(directions_D);
}

void ResponseTable::fill_map(const std::vector<Eigen::Vector3d>& directions_D) {
  std::vector<std::uint32_t> all(directions_D.size());
  std::iota(all.begin(), all.end(), 0U);
  map_.resize(std::size_t{kMapEdge} * kMapEdge);
  constexpr int kBlock = 16;  // cells along the edge of a square that is searched first
  const auto square = [](int column, int row, int edge) {
    const double half = static_cast<double>(edge) / kMapEdge;
    return MapSquare{.a = 2.0 * column / kMapEdge - 1.0 + half, .b = 2.0 * row / kMapEdge - 1.0 + half, .half = half};
  };
  for (int block = 0; block < kMapEdge * kMapEdge / (kBlock * kBlock); ++block) {
    const int column = block * kBlock % kMapEdge, row = block * kBlock / kMapEdge * kBlock;
    const auto near_block = nearest_in(square(column, row, kBlock), directions_D, all);
    for (int y = row; y < row + kBlock; ++y) {
      for (int x = column; x < column + kBlock; ++x) {
        const auto near_cell = nearest_in(square(x, y, 1), directions_D, near_block);
        map_[static_cast<std::size_t>(y * kMapEdge + x)] = make_cell(near_cell, directions_D);
      }
    }
  }
}

ResponseTable::MapCell ResponseTable::make_cell(const std::vector<std::uint32_t>& nearest,
                                                const std::vector<Eigen::Vector3d>& directions_D) {
  if (nearest.size() == 1) return {.first = nearest.front(), .candidates = 1};
  const MapCell cell{.first = static_cast<std::uint32_t>(candidates_.size()),
                     .candidates = static_cast<std::uint32_t>(nearest.size())};
  for (const std::uint32_t i : nearest) candidates_.push_back({.u_D = directions_D[i], .entry = i});
  if (candidates_.size() > kMostCandidates) {
    throw std::invalid_argument("response entries lie too close together: they must be spread over the sphere");
  }
  return cell;
}

double mean_single(const ResponseTable& table) {
  // Points spread evenly along a spiral from pole to pole [Vogel 1979].
  constexpr int kPoints = 2000;
  const double golden_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    sum += table.single(direction_D(i * golden_rad, std::acos(1.0 - (2.0 * i + 1.0) / kPoints)));
  }
  return sum / kPoints;
}

}  // namespace comptonaut
