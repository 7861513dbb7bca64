// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/cones.h"

#include <algorithm>

namespace comptonaut {
namespace {

constexpr std::int32_t kNanosecondsPerMicrosecond = 1000;

/// The same batch with nothing in it but the names of its channels, which cones refer to.
MeasurementBatch continuation(const MeasurementBatch& batch) {
  MeasurementBatch next = batch;
  next.live_us = 0;
  next.others = 0;
  for (ChannelCounts& counts : next.channels) counts.singles = counts.pairs = 0;
  next.cones.clear();
  return next;
}

}  // namespace

std::vector<Cone> to_cones(const EventBatch& events, const DetectorPose& X_WD_at) {
  std::vector<Cone> cones;
  std::int32_t event = 0;
  for (const PairEvent& pair : events.pairs) {
    const std::int32_t offset_us = pair.offset_ns / kNanosecondsPerMicrosecond;
    const auto X_WD = X_WD_at(events.utime + offset_us);
    if (!X_WD) continue;
    for (const ConeHypothesis& hypothesis : {pair.a, pair.b}) {
      if (hypothesis.probability <= 0.0) continue;
      cones.push_back({.offset_us = offset_us,
                       .event = event,
                       .channel = pair.channel,
                       .p_WS = X_WD->translation(),
                       .axis_W = (X_WD->linear() * hypothesis.axis_D).normalized(),
                       .cos_beta = hypothesis.cos_beta,
                       .weight = hypothesis.probability});
    }
    ++event;
  }
  return cones;
}

std::vector<MeasurementBatch> in_datagrams(MeasurementBatch batch) {
  const std::vector<Cone> cones = std::move(batch.cones);
  batch.cones.clear();
  std::vector<MeasurementBatch> parts{std::move(batch)};
  for (auto photon = cones.begin(); photon != cones.end();) {
    const auto next = std::find_if(photon, cones.end(), [&](const Cone& cone) { return cone.event != photon->event; });
    const auto hypotheses = static_cast<std::size_t>(next - photon);
    if (parts.back().cones.size() + hypotheses > kMaxConesPerBatch) parts.push_back(continuation(parts.front()));
    parts.back().cones.insert(parts.back().cones.end(), photon, next);
    photon = next;
  }
  return parts;
}

}  // namespace comptonaut
