// SPDX-License-Identifier: BSD-3-Clause
// Files that a person may have edited: tables, configurations, scenarios.
#include <algorithm>
#include <cmath>

#include "config/config.h"
#include "detector/nuclide.h"
#include "fuzz/check_read.h"
#include "nodes/coordinator_config.h"
#include "nodes/detector_reader_config.h"
#include "nodes/mapper_config.h"
#include "nodes/pose_bridge.h"
#include "nodes/team_link_config.h"
#include "report/recorded_measurements.h"
#include "response/cone_density.h"
#include "response/response_table.h"
#include "sim/scenario.h"

namespace comptonaut {
namespace {

/// The error may be of a file that this one names.
template <class Read>
void check_config(std::span<const char> bytes, Read&& read) {
  check_read("", [&] { (void)parse_config(std::string(bytes.begin(), bytes.end()), "file.yaml", read); });
}

}  // namespace

void fuzz_response(std::span<const char> bytes) {
  const MemoryFile file(bytes);
  check_read(file.path(), [&] {
    const ResponseTable table = ResponseTable::load(file.path());
    for (const ResponseEntry& entry : table.entries()) {
      require_law(entry.single >= 0.0 && entry.pair >= 0.0, "chances are not negative");
      require_law(std::isfinite(table.single(direction_D(entry.phi_rad, entry.theta_rad))), "a direction has a value");
    }
  });
}

void fuzz_cones(std::span<const char> bytes) {
  const MemoryFile file(bytes);
  check_read(file.path(), [&] { (void)ConeDensity::load(file.path()); });
}

void fuzz_config(std::span<const char> bytes) {
  switch (take_choice(bytes) % 6) {
    case 0:
      return check_config(bytes, read_nuclide_channel);
    case 1:
      return check_config(bytes, read_detector_reader_config);
    case 2:
      return check_config(bytes, read_mapper_config);
    case 3:
      return check_config(bytes, read_coordinator_config);
    case 4:
      return check_config(bytes, read_pose_bridge_config);
    default:
      return check_config(bytes, read_team_link_config);
  }
}

void fuzz_scenario(std::span<const char> bytes) {
  const MemoryFile file(bytes);
  check_read(file.path(), [&] { (void)load_scenario(file.path()); });
}

/// Cones and viewpoints, told apart by a zero.
void fuzz_measurements(std::span<const char> bytes) {
  const auto zero = std::find(bytes.begin(), bytes.end(), '\0');
  const MemoryFile cones(std::span(bytes.begin(), zero));
  const MemoryFile viewpoints(std::span(zero == bytes.end() ? zero : zero + 1, bytes.end()));
  check_read("/proc/self/fd/", [&] {
    for (const MeasurementBatch& batch : read_measurements(cones.path(), viewpoints.path(), "Cs-137").batches) {
      require_law(batch.live_us >= 0 && batch.live_us <= batch.duration_us, "no more life than time");
    }
  });
}

}  // namespace comptonaut
