// SPDX-License-Identifier: BSD-3-Clause
#include "report/recorded_measurements.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "bus/codec.h"
#include "bus/log.h"
#include "nodes/mav_channel.h"
#include "report/measurement_csv.h"

namespace comptonaut {
namespace {

bool is_measurements(const std::string& channel) {
  const int mav = mav_of_channel(channel);
  return mav > 0 && channel == mav_channel(mav, "MEASUREMENTS");
}

/// As the coordinator folds; each batch once.
std::int64_t put_in_order(std::vector<MeasurementBatch>& batches) {
  const auto order = [](const MeasurementBatch& b) { return std::tuple(b.utime, b.key.sender, b.key); };
  const auto before = [&](const MeasurementBatch& a, const MeasurementBatch& b) { return order(a) < order(b); };
  const auto same = [](const MeasurementBatch& a, const MeasurementBatch& b) { return a.key == b.key; };
  std::stable_sort(batches.begin(), batches.end(), before);
  const auto end = std::unique(batches.begin(), batches.end(), same);
  const std::int64_t repeated = batches.end() - end;
  batches.erase(end, batches.end());
  return repeated;
}

void require_nuclide(const std::filesystem::path& log, const std::vector<MeasurementBatch>& batches,
                     const std::string& nuclide) {
  std::set<std::string> nuclides;
  for (const MeasurementBatch& batch : batches) {
    for (const ChannelCounts& counts : batch.channels) nuclides.insert(counts.nuclide);
  }
  if (nuclides.contains(nuclide)) return;
  throw std::runtime_error(
      fmt::format("{}: holds nothing of {}; give --nuclide {}", log.string(), nuclide, fmt::join(nuclides, " or ")));
}

/// When one drone could see.
struct LiveTimes {
  std::vector<Utime> middles;  ///< ascending
  Utime longest_us = 0;

  /// From the nearest middle.
  [[nodiscard]] Utime distance_us(Utime utime) const {
    const auto after = std::lower_bound(middles.begin(), middles.end(), utime);
    const Utime to_before = after == middles.begin() ? std::numeric_limits<Utime>::max() : utime - *std::prev(after);
    return after == middles.end() ? to_before : std::min(to_before, *after - utime);
  }
};

std::map<std::int32_t, LiveTimes> live_times(const std::vector<MeasurementBatch>& viewpoints) {
  std::map<std::int32_t, LiveTimes> times;
  for (const MeasurementBatch& viewpoint : viewpoints) {
    if (viewpoint.live_us <= 0) continue;
    LiveTimes& of_drone = times[viewpoint.key.sender];
    of_drone.middles.push_back(viewpoint.utime + viewpoint.duration_us / 2);
    of_drone.longest_us = std::max<Utime>(of_drone.longest_us, viewpoint.live_us);
  }
  for (auto& [drone, of_drone] : times) std::sort(of_drone.middles.begin(), of_drone.middles.end());
  return times;
}

}  // namespace

RecordedMeasurements read_measurements(const std::filesystem::path& log, const std::string& nuclide) {
  RecordedMeasurements recorded;
  std::int64_t refused = 0;
  try {
    read_log(log, [&](const LogEvent& event) {
      if (!is_measurements(event.channel)) return;
      if (auto batch = decode<MeasurementBatch>(event.bytes)) {
        recorded.batches.push_back(std::move(*batch));
      } else {
        ++refused;
      }
    });
  } catch (const std::runtime_error& damage) {
    if (recorded.batches.empty()) throw;
    recorded.remarks.push_back(fmt::format("{}; what stands before it is used", damage.what()));
  }
  if (recorded.batches.empty()) {
    throw std::runtime_error(fmt::format("{}: holds no MAVn_MEASUREMENTS that can be read", log.string()));
  }
  require_nuclide(log, recorded.batches, nuclide);
  const std::int64_t repeated = put_in_order(recorded.batches);
  if (refused > 0) recorded.remarks.push_back(fmt::format("{}: {} batches do not decode", log.string(), refused));
  if (repeated > 0) recorded.remarks.push_back(fmt::format("{}: {} batches stand twice", log.string(), repeated));
  return recorded;
}

RecordedMeasurements read_measurements(const std::filesystem::path& cones, const std::filesystem::path& viewpoints,
                                       const std::string& nuclide) {
  RecordedMeasurements recorded{.batches = read_viewpoints_csv(viewpoints, nuclide), .remarks = {}};
  if (recorded.batches.empty()) throw std::runtime_error(fmt::format("{}: holds no viewpoint", viewpoints.string()));
  const auto live = live_times(recorded.batches);
  std::int64_t apart = 0;
  for (MeasurementBatch& photon : read_cones_csv(cones, nuclide)) {
    const auto times = live.find(photon.key.sender);
    if (times == live.end()) {
      throw std::runtime_error(fmt::format("{}: drone {} has no live_s above 0, but cones in {}", viewpoints.string(),
                                           photon.key.sender, cones.string()));
    }
    const Utime reach_us = times->second.longest_us / 2 + kSecond_us;
    apart += times->second.distance_us(photon.utime) > reach_us ? 1 : 0;
    recorded.batches.push_back(std::move(photon));
  }
  if (apart > 0) {
    recorded.remarks.push_back(
        fmt::format("{}: {} photons came when their drone has no viewpoint, within 1 s", cones.string(), apart));
  }
  return recorded;
}

}  // namespace comptonaut
