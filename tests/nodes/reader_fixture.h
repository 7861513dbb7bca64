// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "detector/make_hits.h"
#include "nodes/detector_reader.h"

namespace comptonaut {

inline constexpr Utime kReaderStart = 1'700'000'000'020'000;  // not on a batch's border
inline const BatchKey kReaderKey{.mission = 3, .sender = 2, .boot_epoch = 77, .number = 0};
inline const std::string kStamp = "# start_utime_us " + std::to_string(kReaderStart) + "\n";

inline DetectorReader new_reader(const DetectorReaderConfig& config = {}) {
  return DetectorReader(config, typical_calibration(), kReaderKey);
}

inline std::string alive(double t_s) { return "# alive " + std::to_string(std::llround(t_s * 40e6)) + "\n"; }

/// A photon that a single of 300 keV is made of.
inline std::string single(std::int64_t index, double t_s) {
  return t3pa_row(index, make_hit_anywhere(index, 300.0, 1e9 * t_s));
}

/// Of several calls, in one line.
class Batches {
 public:
  void add(const std::vector<EventBatch>& more) { all.insert(all.end(), more.begin(), more.end()); }
  [[nodiscard]] std::int64_t singles() const {
    std::int64_t sum = 0;
    for (const EventBatch& batch : all) sum += batch.channels[0].singles;
    return sum;
  }
  [[nodiscard]] std::int64_t live_us() const {
    std::int64_t sum = 0;
    for (const EventBatch& batch : all) sum += batch.live_us;
    return sum;
  }
  std::vector<EventBatch> all;
};

}  // namespace comptonaut
