// SPDX-License-Identifier: BSD-3-Clause
// What the coordinator answers: sources, map tiles, its own state.
#include <comptonaut/msg/coordinator_t.hpp>
#include <comptonaut/msg/radiation_map_t.hpp>
#include <comptonaut/msg/sources_t.hpp>

#include "bus/codec.h"
#include "bus/codec_keys.h"
#include "bus/codec_tiles.h"
#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

constexpr std::string_view kSourcesLayout = "88s44 n*{s 888 8 444 444}";
constexpr std::string_view kRadiationMapLayout = "88s844 444 n*1*1*1*4*4";
constexpr std::string_view kCoordinatorLayout = "884888 {n*{488n*8}} 888";
constexpr double kMaxScore = 1e30;

msg::source_t source_to_msg(const SourceEstimate& source) {
  msg::source_t m;
  m.nuclide = clean_text(source.nuclide);
  pack_vector(source.p_W, m.p_W_m);
  m.activity_Bq = source.activity_Bq;
  pack_vector(source.position_sigma_m, m.position_sigma_m);
  m.position_cov_xy_m2 = static_cast<float>(source.position_cov_xy_m2);
  m.activity_sigma_Bq = static_cast<float>(source.activity_sigma_Bq);
  m.significance = static_cast<float>(source.significance);
  return m;
}

bool valid(const SourceEstimate& s) {
  for (const double sigma_m : s.position_sigma_m) {
    if (!unknown_or_within(sigma_m, 0.0, kMaxCoordinate)) return false;
  }
  return valid_text(s.nuclide) && valid_vector(s.p_W) && within(s.activity_Bq, 0.0, kMaxActivity_Bq) &&
         unknown_or_within(s.position_cov_xy_m2, -kMaxScore, kMaxScore) &&
         unknown_or_within(s.activity_sigma_Bq, 0.0, kMaxActivity_Bq) &&
         unknown_or_within(s.significance, -kMaxScore, kMaxScore);
}

std::optional<SourceEstimate> source_from_msg(const msg::source_t& m) {
  const SourceEstimate source{.nuclide = m.nuclide,
                              .p_W = unpack_vector(m.p_W_m),
                              .activity_Bq = m.activity_Bq,
                              .position_sigma_m = unpack_vector(m.position_sigma_m),
                              .position_cov_xy_m2 = m.position_cov_xy_m2,
                              .activity_sigma_Bq = m.activity_sigma_Bq,
                              .significance = m.significance};
  return valid(source) ? std::optional(source) : std::nullopt;
}

bool valid(const MapTile& tile) {
  for (const MapCell& cell : tile.cells) {
    if (!within(cell.lambda_Bq, 0.0, kMaxActivity_Bq) || !within(cell.sensitivity_s, 0.0, kMaxActivity_Bq))
      return false;
  }
  return valid_tile(tile);
}

}  // namespace

Bytes encode(const SourceReport& report) {
  msg::sources_t m;
  m.mission = report.mission;
  m.utime = report.utime;
  m.estimator = clean_text(report.estimator);
  m.certificate = static_cast<float>(report.certificate);
  m.coverage = static_cast<float>(report.coverage);
  pack_all(report.sources, m.n, m.sources, source_to_msg);
  return pack(m);
}

template <>
std::optional<SourceReport> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::sources_t>(bytes, kSourcesLayout);
  if (!m) return {};
  SourceReport report{.mission = m->mission,
                      .utime = m->utime,
                      .estimator = m->estimator,
                      .certificate = m->certificate,
                      .coverage = m->coverage,
                      .sources = {}};
  const bool ok = report.mission >= 0 && valid_utime(report.utime) && valid_text(report.estimator) &&
                  unknown_or_within(report.certificate, -kMaxScore, kMaxScore) && within(report.coverage, 0.0, 1.0) &&
                  unpack_all(m->sources, report.sources, source_from_msg);
  return ok ? std::optional(report) : std::nullopt;
}

Bytes encode(const MapTile& tile) {
  auto m = tile_to_msg<msg::radiation_map_t>(tile);
  for (const MapCell& cell : tile.cells) {
    m.lambda_Bq.push_back(static_cast<float>(cell.lambda_Bq));
    m.sensitivity_s.push_back(static_cast<float>(cell.sensitivity_s));
  }
  return pack(m);
}

template <>
std::optional<MapTile> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::radiation_map_t>(bytes, kRadiationMapLayout);
  auto tile = m ? tile_from_msg<MapTile>(*m) : std::nullopt;
  for (std::size_t i = 0; tile && i < tile->cells.size(); ++i) {
    tile->cells[i].lambda_Bq = m->lambda_Bq[i];
    tile->cells[i].sensitivity_s = m->sensitivity_s[i];
  }
  return tile && valid(*tile) ? tile : std::nullopt;
}

Bytes encode(const CoordinatorState& state) {
  msg::coordinator_t m;
  m.mission = state.mission;
  m.utime = state.utime;
  m.sender = state.sender;
  m.term = state.term;
  m.lease_us = state.lease_us;
  m.terrain_hash = static_cast<std::int64_t>(state.terrain_hash);
  m.basis = to_msg(state.basis);
  m.lambda_hash = static_cast<std::int64_t>(state.lambda_hash);
  m.cones = state.cones;
  m.viewpoints = state.viewpoints;
  return pack(m);
}

template <>
std::optional<CoordinatorState> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::coordinator_t>(bytes, kCoordinatorLayout);
  if (!m) return {};
  const auto basis = from_msg(m->basis);
  const CoordinatorState state{.mission = m->mission,
                               .utime = m->utime,
                               .sender = m->sender,
                               .term = m->term,
                               .lease_us = m->lease_us,
                               .terrain_hash = static_cast<std::uint64_t>(m->terrain_hash),
                               .basis = basis.value_or(Basis{}),
                               .lambda_hash = static_cast<std::uint64_t>(m->lambda_hash),
                               .cones = m->cones,
                               .viewpoints = m->viewpoints};
  const bool ok = basis && state.mission >= 0 && valid_utime(state.utime) && state.utime % kSecond_us == 0 &&
                  valid_mav(state.sender) && state.term >= 0 && state.lease_us >= 0 && state.cones >= 0 &&
                  state.viewpoints >= 0;
  return ok ? std::optional(state) : std::nullopt;
}

}  // namespace comptonaut
