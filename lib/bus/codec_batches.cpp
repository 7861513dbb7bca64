// SPDX-License-Identifier: BSD-3-Clause
// Batches of events and of measurements.
#include <comptonaut/msg/events_t.hpp>
#include <comptonaut/msg/measurements_t.hpp>

#include "bus/codec.h"
#include "bus/codec_keys.h"
#include "bus/valid.h"
#include "bus/wire.h"

namespace comptonaut {
namespace {

constexpr std::string_view kEventsLayout = "{8488} 84444 n*{s44} n*{41 44 44444 44444}";
constexpr std::string_view kMeasurementsLayout = "{8488} 8444 888 4444 444 44 n*{s44} n*{441 444 444 44}";
constexpr double kMaxEnergy_keV = 1e5;
constexpr double kProbabilityTolerance = 1e-5;

/// A hypothesis that is not physical has nothing else that means anything: it goes out as the default one.
template <class Axis, class Scalar>
void hypothesis_to_msg(const ConeHypothesis& hypothesis, Axis& axis_D, Scalar& cos_beta, Scalar& probability) {
  const ConeHypothesis& h = hypothesis.probability > 0.0 ? hypothesis : ConeHypothesis{};
  pack_vector(h.axis_D, axis_D);
  cos_beta = static_cast<Scalar>(h.cos_beta);
  probability = static_cast<Scalar>(h.probability);
}

msg::pair_t pair_to_msg(const PairEvent& pair) {
  msg::pair_t m;
  m.offset_ns = pair.offset_ns;
  m.channel = static_cast<std::int8_t>(pair.channel);
  m.e1_keV = static_cast<float>(pair.e1_keV);
  m.e2_keV = static_cast<float>(pair.e2_keV);
  hypothesis_to_msg(pair.a, m.axis_a_D, m.cos_beta_a, m.probability_a);
  hypothesis_to_msg(pair.b, m.axis_b_D, m.cos_beta_b, m.probability_b);
  return m;
}

bool valid(const ConeHypothesis& h) {
  return valid_unit(h.axis_D) && within(h.cos_beta, -1.0, 1.0) && within(h.probability, 0.0, 1.0);
}

std::optional<PairEvent> pair_from_msg(const msg::pair_t& m) {
  const PairEvent pair{
      .offset_ns = m.offset_ns,
      .channel = m.channel,
      .e1_keV = m.e1_keV,
      .e2_keV = m.e2_keV,
      .a = {.axis_D = unpack_vector(m.axis_a_D), .cos_beta = m.cos_beta_a, .probability = m.probability_a},
      .b = {.axis_D = unpack_vector(m.axis_b_D), .cos_beta = m.cos_beta_b, .probability = m.probability_b}};
  const bool ok = valid(pair.a) && valid(pair.b) &&
                  std::abs(pair.a.probability + pair.b.probability - 1.0) <= kProbabilityTolerance &&
                  within(pair.e1_keV, 0.0, kMaxEnergy_keV) && within(pair.e2_keV, 0.0, kMaxEnergy_keV);
  return ok ? std::optional(pair) : std::nullopt;
}

msg::cone_t cone_to_msg(const Cone& cone, const Eigen::Vector3d& p_WD) {
  msg::cone_t m;
  m.offset_us = cone.offset_us;
  m.event = cone.event;
  m.channel = static_cast<std::int8_t>(cone.channel);
  pack_vector(cone.p_WS - p_WD, m.p_WS_offset_m);
  pack_vector(cone.axis_W, m.axis_W);
  m.cos_beta = static_cast<float>(cone.cos_beta);
  m.weight = static_cast<float>(cone.weight);
  return m;
}

std::optional<Cone> cone_from_msg(const msg::cone_t& m, const Eigen::Vector3d& p_WD) {
  const Cone cone{.offset_us = m.offset_us,
                  .event = m.event,
                  .channel = m.channel,
                  .p_WS = p_WD + unpack_vector(m.p_WS_offset_m),
                  .axis_W = unpack_vector(m.axis_W),
                  .cos_beta = m.cos_beta,
                  .weight = m.weight};
  const bool ok = cone.event >= 0 && valid_vector(cone.p_WS) && valid_unit(cone.axis_W) &&
                  within(cone.cos_beta, -1.0, 1.0) && within(cone.weight, 0.0, 1.0);
  return ok ? std::optional(cone) : std::nullopt;
}

/// What batches of both kinds have in common: their span of time and their counts.
template <class Batch>
bool valid_span(const Batch& batch) {
  return valid_utime(batch.utime) && batch.utime % kBatch_us == 0 && batch.duration_us > 0 &&
         batch.duration_us <= kBatch_us && batch.live_us >= 0 && batch.live_us <= batch.duration_us &&
         batch.utime_sigma_us >= 0 && batch.others >= 0;
}

/// Whether a photon of the batch lies in its time and in one of its channels.
template <class Batch>
bool has_place(const Batch& batch, std::int64_t offset, std::int64_t duration, std::int32_t channel) {
  return offset >= 0 && offset < duration && channel >= 0 && static_cast<std::size_t>(channel) < batch.channels.size();
}

}  // namespace

Bytes encode(const EventBatch& batch) {
  msg::events_t m;
  m.key = to_msg(batch.key);
  m.utime = batch.utime;
  m.duration_us = batch.duration_us;
  m.live_us = batch.live_us;
  m.utime_sigma_us = batch.utime_sigma_us;
  m.others = batch.others;
  pack_all(batch.channels, m.n_channels, m.channels, [](const ChannelCounts& counts) { return to_msg(counts); });
  pack_all(batch.pairs, m.n_pairs, m.pairs, pair_to_msg);
  return pack(m);
}

template <>
std::optional<EventBatch> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::events_t>(bytes, kEventsLayout);
  if (!m) return {};
  const auto key = from_msg(m->key);
  EventBatch batch{.key = key.value_or(BatchKey{}),
                   .utime = m->utime,
                   .duration_us = m->duration_us,
                   .live_us = m->live_us,
                   .utime_sigma_us = m->utime_sigma_us,
                   .others = m->others,
                   .channels = {},
                   .pairs = {}};
  if (!key || !valid_span(batch)) return {};
  if (!unpack_all(m->channels, batch.channels, [](const auto& c) { return from_msg(c); })) return {};
  if (!unpack_all(m->pairs, batch.pairs, pair_from_msg)) return {};
  for (const PairEvent& pair : batch.pairs) {
    if (!has_place(batch, pair.offset_ns, std::int64_t{1000} * batch.duration_us, pair.channel)) return {};
  }
  return batch;
}

Bytes encode(const MeasurementBatch& batch) {
  msg::measurements_t m;
  m.key = to_msg(batch.key);
  m.utime = batch.utime;
  m.duration_us = batch.duration_us;
  m.live_us = batch.live_us;
  m.utime_sigma_us = batch.utime_sigma_us;
  pack_vector(batch.p_WD, m.p_WD_m);
  pack_quaternion(batch.q_WD, m.q_WD);
  pack_vector(batch.v_WD, m.v_WD_m_s);
  m.battery_percent = static_cast<float>(batch.battery_percent);
  m.others = batch.others;
  pack_all(batch.channels, m.n_channels, m.channels, [](const ChannelCounts& counts) { return to_msg(counts); });
  pack_all(batch.cones, m.n_cones, m.cones, [&](const Cone& cone) { return cone_to_msg(cone, batch.p_WD); });
  return pack(m);
}

template <>
std::optional<MeasurementBatch> decode(std::span<const std::uint8_t> bytes) {
  const auto m = unpack<msg::measurements_t>(bytes, kMeasurementsLayout);
  if (!m) return {};
  const auto key = from_msg(m->key);
  MeasurementBatch batch{.key = key.value_or(BatchKey{}),
                         .utime = m->utime,
                         .duration_us = m->duration_us,
                         .live_us = m->live_us,
                         .utime_sigma_us = m->utime_sigma_us,
                         .p_WD = unpack_vector(m->p_WD_m),
                         .q_WD = unpack_quaternion(m->q_WD),
                         .v_WD = unpack_vector(m->v_WD_m_s),
                         .battery_percent = m->battery_percent,
                         .others = m->others,
                         .channels = {},
                         .cones = {}};
  if (!key || !valid_span(batch)) return {};
  if (!valid_vector(batch.p_WD) || !valid_unit(batch.q_WD) || !unknown_or_vector(batch.v_WD)) return {};
  if (!unknown_or_within(batch.battery_percent, 0.0, 100.0)) return {};
  if (!unpack_all(m->channels, batch.channels, [](const auto& c) { return from_msg(c); })) return {};
  if (!unpack_all(m->cones, batch.cones, [&](const auto& c) { return cone_from_msg(c, batch.p_WD); })) return {};
  for (const Cone& cone : batch.cones) {
    if (!has_place(batch, cone.offset_us, batch.duration_us, cone.channel)) return {};
  }
  return batch;
}

}  // namespace comptonaut
