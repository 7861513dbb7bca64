// SPDX-License-Identifier: BSD-3-Clause
#include "response/response_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr std::size_t kMostEntries = 30'000;

bool is_valid(const ResponseEntry& entry) {
  const auto chance = [](double value) { return value >= 0.0 && std::isfinite(value); };
  return std::abs(entry.phi_rad) <= 2.0 * std::numbers::pi && entry.theta_rad >= 0.0 &&
         entry.theta_rad <= std::numbers::pi && chance(entry.single) && chance(entry.single_rel_sigma) &&
         chance(entry.pair) && chance(entry.pair_rel_sigma);
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
    directions_.push_back(direction_D(entry.phi_rad, entry.theta_rad));
  }
  fill_map();
}

Eigen::Vector3d ResponseTable::map_direction(double a, double b) {
  const double z = 1.0 - std::abs(a) - std::abs(b);
  if (z >= 0.0) return Eigen::Vector3d(a, b, z).normalized();
  return Eigen::Vector3d(std::copysign(1.0 - std::abs(b), a), std::copysign(1.0 - std::abs(a), b), z).normalized();
}

void ResponseTable::fill_map() {
  map_.resize(std::size_t{kMapEdge} * kMapEdge);
  std::vector<double> cosines(directions_.size());
  constexpr double kHalf = 1.0 / kMapEdge;
  for (int row = 0; row < kMapEdge; ++row) {
    for (int column = 0; column < kMapEdge; ++column) {
      const double a = (2 * column + 1) * kHalf - 1.0, b = (2 * row + 1) * kHalf - 1.0;
      const Eigen::Vector3d centre_D = map_direction(a, b);
      double radius_rad = 0.0;
      for (const double da : {-kHalf, kHalf}) {
        for (const double db : {-kHalf, kHalf}) {
          radius_rad = std::max(radius_rad, std::acos(std::min(1.0, centre_D.dot(map_direction(a + da, b + db)))));
        }
      }
      for (std::size_t i = 0; i < directions_.size(); ++i) cosines[i] = centre_D.dot(directions_[i]);
      // An entry that is nearest to some point of the cell is at most twice the cell's radius farther from its centre
      // than the entry nearest to that. (A tenth more: the borders of a cell are not quite great circles.)
      const double best = std::min(1.0, *std::max_element(cosines.begin(), cosines.end()));
      const double limit = std::cos(std::min(std::numbers::pi, std::acos(best) + 2.2 * radius_rad));
      std::vector<std::int16_t> near;
      for (std::size_t i = 0; i < directions_.size(); ++i) {
        if (cosines[i] >= limit) near.push_back(static_cast<std::int16_t>(i));
      }
      std::int32_t& cell = map_[static_cast<std::size_t>(row * kMapEdge + column)];
      if (near.size() == 1) {
        cell = near.front();
      } else {
        cell = ~static_cast<std::int32_t>(candidates_.size());
        candidates_.push_back(std::move(near));
      }
    }
  }
}

std::size_t ResponseTable::nearest_of(const std::vector<std::int16_t>& candidates, const Eigen::Vector3d& u_D) const {
  std::int16_t best = candidates.front();
  double best_dot = -std::numeric_limits<double>::infinity();
  for (const std::int16_t candidate : candidates) {
    const double dot = directions_[static_cast<std::size_t>(candidate)].dot(u_D);
    if (dot > best_dot) {
      best = candidate;
      best_dot = dot;
    }
  }
  return static_cast<std::size_t>(best);
}

}  // namespace comptonaut
