// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <tuple>
#include <type_traits>

#include "sim/campaign.h"

namespace comptonaut {

/// What stands in a shard's file of each struct, in order. Names stand for all members, or it does not compile.
template <class T, class Plain>
concept Is = std::same_as<std::remove_const_t<T>, Plain>;

auto members(Is<Eigen::Vector3d> auto& p) { return std::tie(p.x(), p.y(), p.z()); }
auto members(Is<Eigen::Vector3f> auto& p) { return std::tie(p.x(), p.y(), p.z()); }

auto members(Is<PointSource> auto& source) {
  auto& [p_W, activity_Bq, nuclide] = source;
  return std::tie(p_W, activity_Bq, nuclide);
}

auto members(Is<TrueSource> auto& source) {
  auto& [nuclide, p_W, activity_Bq] = source;
  return std::tie(nuclide, p_W, activity_Bq);
}

auto members(Is<Localisation> auto& localisation) {
  auto& [nearest, rmse, found_2m, found_half_m, reported, wrong, activity, nearest_m, found_by] = localisation;
  return std::tie(nearest, rmse, found_2m, found_half_m, reported, wrong, activity, nearest_m, found_by);
}

auto members(Is<SourceError> auto& error) {
  auto& [x, y, x_sigma, y_sigma, activity, activity_sigma] = error;
  return std::tie(x, y, x_sigma, y_sigma, activity, activity_sigma);
}

auto members(Is<PatchError> auto& error) {
  auto& [centroid, area, activity] = error;
  return std::tie(centroid, area, activity);
}

auto members(Is<Judgement> auto& judgement) {
  auto& [t_s, coverage, localisation, reported, errors, crb_m, patches, patch] = judgement;
  return std::tie(t_s, coverage, localisation, reported, errors, crb_m, patches, patch);
}

auto members(Is<EventTally> auto& tally) {
  auto& [singles, pairs, others] = tally;
  return std::tie(singles, pairs, others);
}

auto members(Is<MissionResult> auto& mission) {
  auto& [seed, sources, tracks, steps, events, distance_m, outside_s, at_home, collisions, cpu_s] = mission;
  return std::tie(seed, sources, tracks, steps, events, distance_m, outside_s, at_home, collisions, cpu_s);
}

auto members(Is<CampaignNames> auto& names) {
  auto& [scenario, strategy, estimator] = names;
  return std::tie(scenario, strategy, estimator);
}

auto members(Is<CampaignPart> auto& part) {
  auto& [names, missions] = part;
  return std::tie(names, missions);
}

auto members(Is<Area> auto& area) {
  auto& [x_min, x_max, y_min, y_max] = area;
  return std::tie(x_min, x_max, y_min, y_max);
}

auto members(Is<SeedRange> auto& seeds) {
  auto& [first, last] = seeds;
  return std::tie(first, last);
}

auto members(Is<CampaignFacts> auto& facts) {
  auto& [line, seeds, scenario, area, horizon_s, mavs, buildings] = facts;
  return std::tie(line, seeds, scenario, area, horizon_s, mavs, buildings);
}

}  // namespace comptonaut
