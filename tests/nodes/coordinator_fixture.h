// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "nodes/coordinator.h"
#include "response/cone_density.h"
#include "response/response_table.h"
#include "world/world.h"

namespace comptonaut {

/// A table of the size of a real one, different in every direction.
inline ResponseTable toy_table() {
  std::vector<ResponseEntry> entries;
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k < 24; ++k) {
      const double theta_rad = (i + 0.5) / 12 * std::numbers::pi, phi_rad = (k + 0.5) / 12 * std::numbers::pi;
      const double pair = 3e-8 * (1.0 + 0.3 * std::cos(theta_rad) + 0.1 * std::cos(phi_rad));
      entries.push_back({.phi_rad = phi_rad, .theta_rad = theta_rad, .single = 1e-6, .pair = pair});
    }
  }
  return ResponseTable(entries);
}

inline CoordinatorConfig small_config() {
  CoordinatorConfig config{.mission = 5, .mavs = {1, 2, 3}, .area = {0, 20, 0, 20}, .estimator = "mlem"};
  config.search.werner2024.explore_clusters = 6;
  return config;
}

inline ConeDensity some_cones() {
  const ConeDensity::Node node{.weights = {0, 0, 0.5, 0.2, 0.2, 0.05, 0.03, 0.02}};
  return {{node}, {node}};
}

inline Coordinator make_coordinator(const CoordinatorConfig& config) {
  return {config, flat_cells(config.area, config.cell_m), toy_table(), World::flat(), some_cones()};
}

/// A cone with the source on its surface, its axis tilted by beta in a random plane.
inline Cone noiseless_cone(const Eigen::Vector3d& p_WS, const Eigen::Vector3d& source_W, Random& random) {
  const Eigen::Vector3d u_W = (source_W - p_WS).normalized();
  const double beta_rad = random.uniform(0.3, 1.5);
  const Eigen::Vector3d axis_W = Eigen::AngleAxisd(beta_rad, u_W.cross(random.unit_vector()).normalized()) * u_W;
  return {.p_WS = p_WS, .axis_W = axis_W, .cos_beta = std::cos(beta_rad), .weight = 1.0};
}

inline constexpr Utime kMissionStart = 1'700'000'000'000'000;

/// Three MAVs that circle over the field for some seconds, with cones to a source at (6, 13), by sender and number.
inline std::vector<MeasurementBatch> some_mission(int duration_s, std::uint64_t seed = 51) {
  Random random(seed);
  std::vector<MeasurementBatch> batches;
  for (int number = 0; number < 20 * duration_s; ++number) {
    for (std::int32_t mav = 1; mav <= 3; ++mav) {
      const double turn_rad = 0.02 * number + 2.1 * mav;
      MeasurementBatch batch{.key = {.mission = 5, .sender = mav, .boot_epoch = 100, .number = number}};
      batch.utime = kMissionStart + number * kBatch_us;
      batch.live_us = 50'000;
      batch.p_WD = {10 + 7 * std::cos(turn_rad), 10 + 7 * std::sin(turn_rad), 2.0};
      batch.q_WD = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ());
      batch.channels = {{.nuclide = "Cs-137"}};
      for (auto n = random.poisson(0.15); n > 0; --n) {
        batch.cones.push_back(noiseless_cone(batch.p_WD, {6.25, 13.25, 0}, random));
      }
      batches.push_back(batch);
    }
  }
  return batches;
}

inline std::int64_t counter(const Coordinator& coordinator, const std::string& name) {
  for (const Counter& c : coordinator.counters()) {
    if (c.name == name) return c.value;
  }
  return -1;
}

}  // namespace comptonaut
