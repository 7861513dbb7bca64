// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "bus/codec.h"
#include "bus/log.h"
#include "nodes/mav_channel.h"
#include "radiation/joint_world.h"

namespace comptonaut {

inline constexpr Utime kFieldStart = 1'700'000'000'000'000;

/// What two drones measure over 16 x 16 m with two sources of Cs-137, as the shipped tables have it, with counts of
/// another nuclide beside, as they come from the wire.
inline std::vector<MeasurementBatch> measured_field() {
  const std::filesystem::path tables = COMPTONAUT_SOURCE_DIR "/config/response";
  const JointPhysics physics{.response = SmoothResponse(ResponseTable::load(tables / "cs-137.csv")),
                             .cones = ConeTable(ConeDensity::load(tables / "cs-137-cones.csv"), 0.01),
                             .attenuation_per_m = 0.0093};
  const ToyField field{.sources = {{{4.3, 5.2, 0.0}, 2e9}, {{11.6, 10.1, 0.0}, 4e9}}};
  std::vector<MeasurementBatch> batches;
  for (MeasurementBatch& batch : field.sweep(physics, 16.0, 2.0, 7)) {
    const auto number = static_cast<std::int64_t>(batches.size());
    batch.key.number = number;
    batch.utime = kFieldStart + number * kBatch_us;
    batch.live_us -= static_cast<std::int32_t>(number % 1000);
    for (Cone& cone : batch.cones) cone.channel = 1, cone.offset_us = 1000 * cone.event;
    batch.channels.insert(batch.channels.begin(), {.nuclide = "Co-60", .singles = 5});
    batches.push_back(*decode<MeasurementBatch>(encode(batch)));
  }
  return batches;
}

inline std::filesystem::path write_measurements(const std::vector<MeasurementBatch>& batches,
                                                const std::filesystem::path& file) {
  std::filesystem::remove(file);
  LogWriter writer(file);
  for (const MeasurementBatch& batch : batches) {
    const Bytes bytes = encode(batch);
    const LogEvent event{
        .logged_utime = batch.utime, .channel = mav_channel(batch.key.sender, "MEASUREMENTS"), .bytes = bytes};
    if (!writer.append(event)) throw std::runtime_error(file.string() + ": cannot be written");
  }
  return file;
}

}  // namespace comptonaut
