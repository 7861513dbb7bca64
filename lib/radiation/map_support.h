// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "radiation/map_rows.h"
#include "radiation/map_state.h"

namespace comptonaut {

/// Newton's steps of a map. Where a likelihood like this one is largest, nearly all cells are empty [Lindsay 1983]; on
/// the few that are not, with the drones' background rates, its curvature can be written down and its quadratic model
/// maximised with no activity below zero. Empty cells join as soon as their slope is positive, best first.
class MapSupport {
 public:
  /// Beyond so many variables a step costs more than it gains.
  static constexpr std::size_t kVariablesMax = 256;

  /// For steps of one update. All must outlive this. `sensitivity_s`: per node, of leaves.
  MapSupport(const MapRows& rows, const JointProblem& problem, double scatter, std::span<const double> sensitivity_s)
      : rows_(rows), problem_(problem), scatter_(scatter), sensitivity_s_(sensitivity_s) {}

  struct Step {
    MapState to;
    double gain = 0.0;  ///< in log likelihood, promised by the quadratic model
  };
  /// From a state of which `at` is known. Its curvature is that of an earlier step if that knows all of the cells.
  /// nullopt where too many cells hold activity.
  [[nodiscard]] std::optional<Step> step(const MapState& from, const MapProjection& at, double gain_min);

 private:
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> support(const MapState& from, const MapProjection& at) const;
  [[nodiscard]] AlignedVector<float> curvature(const MapState& from, const MapProjection& at) const;

  const MapRows& rows_;
  const JointProblem& problem_;
  double scatter_;
  std::span<const double> sensitivity_s_;
  std::vector<std::uint32_t> leaves_;  ///< of the curvature, in growing order
  AlignedVector<float> curvature_;     ///< per expected count of each leaf, then of each drone's singles and pairs
};

}  // namespace comptonaut
