// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/random.h"
#include "detector/calibration.h"
#include "detector/events.h"
#include "physics/material.h"
#include "physics/transport.h"
#include "response/angular_error.h"
#include "response/digitizer.h"
#include "response/fit_cone_density.h"
#include "response/response_table.h"

namespace comptonaut {

/// A Monte Carlo of the response to one line: rules.channels has exactly one entry.
struct ResponseConfig {
  EventRules rules;
  DigitizerConfig digitizer;
  Calibration calibration = Calibration::uniform();
  std::int64_t photons = 1'000'000;  ///< that reach the block, per direction
  std::uint64_t seed = 1;
  int threads = 1;
  int grid_deg = 10;  ///< step of phi and theta; divides 90
};

/// Throws std::invalid_argument that names what is wrong.
void check(const ResponseConfig& config);

/// What photons from one direction did.
struct DirectionCounts {
  std::int64_t photons = 0;     ///< that reached the block
  std::int64_t interacted = 0;  ///< left energy in it
  std::int64_t singles = 0;
  std::int64_t pairs = 0;
  std::int64_t others = 0;                   ///< events that are neither
  std::vector<AngularError> angular_errors;  ///< one per pair
  std::vector<ConeSample> cones;             ///< of the pairs

  void add(const DirectionCounts& more);
};

/// One thread's chain from photon to event: transport, digitizer and the reader's own rules.
class PhotonSimulator {
 public:
  /// Keeps references to both.
  PhotonSimulator(const ResponseConfig& config, const Transport& transport);

  /// A parallel beam from direction u_D (unit vector), each photon an event of its own.
  [[nodiscard]] DirectionCounts simulate(const Eigen::Vector3d& u_D, std::int64_t photons, Random& random);

 private:
  void count(const DetectorEvent& event, const PhotonHistory& history, const Eigen::Vector3d& u_D,
             DirectionCounts& counts) const;

  const ResponseConfig& config_;
  const Transport& transport_;
  Digitizer digitizer_;
  EventFinder events_;
  std::vector<Hit> hits_;
};

struct Response {
  ResponseTable table;
  AngularSummary angular;  ///< over all directions of the grid that were simulated
  /// Of the pairs of all directions, each counted as a source there would give it if all directions were alike.
  std::vector<ConeSample> cones;
};

/// The whole table. Of directions that the block's symmetries (a turn by 90 degrees about z, the mirror x <-> y) make
/// equal one is simulated. `progress` is called with the share done, by one thread at a time. The result is the same
/// whatever the number of threads. Throws as `check` does.
[[nodiscard]] Response make_response(const ResponseConfig& config, const Material& cdte,
                                     const std::function<void(double)>& progress = {});

}  // namespace comptonaut
