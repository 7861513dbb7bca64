// SPDX-License-Identifier: BSD-3-Clause
// A daemon's health, and the simulator's truth.
#include <comptonaut/msg/status_t.hpp>
#include <comptonaut/msg/truth_t.hpp>

#include "bus/codec.h"
#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

constexpr std::string_view kStatusLayout = "84sss n*{s8}";
constexpr std::string_view kTruthLayout = "88s4 8888 n*{s 888 8} n*{4 888 4 8}";
constexpr double kMaxTimeScale = 1e6;

std::optional<Counter> counter_from_msg(const msg::counter_t& m) {
  const Counter counter{.name = m.name, .value = m.value};
  return valid_text(counter.name) ? std::optional(counter) : std::nullopt;
}

msg::truth_source_t true_source_to_msg(const TrueSource& source) {
  msg::truth_source_t m;
  m.nuclide = clean_text(source.nuclide);
  pack_vector(source.p_W, m.p_W_m);
  m.activity_Bq = source.activity_Bq;
  return m;
}

std::optional<TrueSource> true_source_from_msg(const msg::truth_source_t& m) {
  const TrueSource source{.nuclide = m.nuclide, .p_W = unpack_vector(m.p_W_m), .activity_Bq = m.activity_Bq};
  const bool valid =
      valid_text(source.nuclide) && valid_vector(source.p_W) && within(source.activity_Bq, 0.0, kMaxActivity_Bq);
  return valid ? std::optional(source) : std::nullopt;
}

msg::truth_mav_t mav_to_msg(const TrueMav& mav) {
  msg::truth_mav_t m;
  m.mav = mav.mav;
  pack_vector(mav.p_WB, m.p_WB_m);
  m.yaw_rad = static_cast<float>(mav.yaw_rad);
  m.photons = mav.photons;
  return m;
}

std::optional<TrueMav> mav_from_msg(const msg::truth_mav_t& m) {
  const TrueMav mav{.mav = m.mav, .p_WB = unpack_vector(m.p_WB_m), .yaw_rad = m.yaw_rad, .photons = m.photons};
  const bool valid = valid_mav(mav.mav) && valid_vector(mav.p_WB) &&
                     within(mav.yaw_rad, -kMaxCoordinate, kMaxCoordinate) && mav.photons >= 0;
  return valid ? std::optional(mav) : std::nullopt;
}

bool valid(const Area& area) {
  return valid_vector({area.x_min_m, area.y_min_m, 0.0}) && valid_vector({area.x_max_m, area.y_max_m, 0.0}) &&
         area.x_min_m <= area.x_max_m && area.y_min_m <= area.y_max_m;
}

}  // namespace

Bytes encode(const DaemonStatus& status) {
  msg::status_t m;
  m.utime = status.utime;
  m.sender = status.sender;
  m.daemon = clean_text(status.daemon);
  m.version = clean_text(status.version);
  m.state = clean_text(status.state);
  pack_all(status.counters, m.n, m.counters, [](const Counter& counter) {
    return msg::counter_t{.name = clean_text(counter.name), .value = counter.value};
  });
  return pack(m);
}

template <>
std::optional<DaemonStatus> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::status_t>(bytes, kStatusLayout);
  if (!m) return {};
  DaemonStatus status{.utime = m->utime,
                      .sender = m->sender,
                      .daemon = m->daemon,
                      .version = m->version,
                      .state = m->state,
                      .counters = {}};
  const bool ok = valid_utime(status.utime) && valid_mav(status.sender) && valid_text(status.daemon) &&
                  valid_text(status.version) && valid_text(status.state) &&
                  unpack_all(m->counters, status.counters, counter_from_msg);
  return ok ? std::optional(status) : std::nullopt;
}

Bytes encode(const Truth& truth) {
  const Area& area = truth.area;
  const double edges_m[4] = {area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m};
  msg::truth_t m;
  m.utime = truth.utime;
  m.start_utime = truth.start_utime;
  m.scenario = clean_text(truth.scenario);
  m.time_scale = static_cast<float>(truth.time_scale);
  std::copy(std::begin(edges_m), std::end(edges_m), m.area_m);
  pack_all(truth.sources, m.n, m.sources, true_source_to_msg);
  pack_all(truth.mavs, m.n_mavs, m.mavs, mav_to_msg);
  return pack(m);
}

template <>
std::optional<Truth> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::truth_t>(bytes, kTruthLayout);
  if (!m) return {};
  Truth truth{.utime = m->utime,
              .start_utime = m->start_utime,
              .scenario = m->scenario,
              .time_scale = m->time_scale,
              .area = {m->area_m[0], m->area_m[1], m->area_m[2], m->area_m[3]},
              .sources = {},
              .mavs = {}};
  const bool ok = valid_utime(truth.utime) && valid_utime(truth.start_utime) && valid_text(truth.scenario) &&
                  truth.time_scale > 0.0 && truth.time_scale <= kMaxTimeScale && valid(truth.area) &&
                  unpack_all(m->sources, truth.sources, true_source_from_msg) &&
                  unpack_all(m->mavs, truth.mavs, mav_from_msg);
  return ok ? std::optional(truth) : std::nullopt;
}

}  // namespace comptonaut
