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
#include "response/response_table.h"

namespace comptonaut {

/// A Monte Carlo of the response to all that one nuclide emits: rules.channels has exactly one entry.
struct ResponseConfig {
  EventRules rules;
  DigitizerConfig digitizer;
  Calibration calibration = Calibration::uniform();
  std::int64_t photons = 1'000'000;  ///< that reach the block, per direction; at most, if a precision is enough
  double single_rel_sigma = 0.0;     ///< relative statistical errors that are enough: a direction ends where it has
  double pair_rel_sigma = 0.0;       ///< both; 0: never
  std::uint64_t seed = 1;
  int threads = 1;
  int grid_deg = 10;  ///< step of phi and theta; divides 90
  int thinning = 16;  ///< of photons that can make a single only one in so many is digitized, and counts for all
};

/// Throws std::invalid_argument that names what is wrong.
void check(const ResponseConfig& config);

/// Events counted by weight: whole numbers, so that sums do not depend on their order.
struct Tally {
  std::int64_t weight = 0, weight2 = 0;  ///< sums of weights and of their squares

  void add(std::int64_t event_weight) {
    weight += event_weight;
    weight2 += event_weight * event_weight;
  }
  [[nodiscard]] double sum() const { return static_cast<double>(weight); }
  /// Relative standard deviation of the sum, of a count among so many photons; 1 where nothing was counted.
  [[nodiscard]] double rel_sigma(std::int64_t photons) const;
};

/// What photons from one direction did.
struct DirectionCounts {
  std::int64_t photons = 0;      ///< that reached the block
  std::int64_t interacted = 0;   ///< left energy in it
  Tally singles, pairs, others;  ///< others: events that are neither
  std::vector<SimulatedPair> simulated_pairs;

  void add(const DirectionCounts& more);
};

/// One thread's chain from photon to event: transport, digitizer and the reader's own rules.
///
/// Most of the time goes into the digitizer, and pairs are rare. Photons that left about a pair's energy at places
/// about as far apart as a pair's are all digitized; of the others one in `thinning`, drawn at random, or, if the
/// energy is far from the channel's window of singles, one in 64, and its events count as many times (Russian
/// roulette). That leaves all expectations as they are, whatever the criteria.
class PhotonSimulator {
 public:
  /// Keeps references to both.
  PhotonSimulator(const ResponseConfig& config, const Transport& transport);

  /// A parallel beam from direction u_D (unit vector), each photon an event of its own.
  [[nodiscard]] DirectionCounts simulate(const Eigen::Vector3d& u_D, std::int64_t photons, Random& random);

 private:
  [[nodiscard]] double draw_energy_keV(Random& random) const;
  [[nodiscard]] bool may_be_pair(const PhotonHistory& history, double deposited_keV) const;
  [[nodiscard]] bool may_be_single(double deposited_keV) const;
  [[nodiscard]] std::int64_t photons_per_digitized(const PhotonHistory& history) const;
  void count(const DetectorEvent& event, const PhotonHistory& history, std::int64_t weight, const Eigen::Vector3d& u_D,
             DirectionCounts& counts) const;

  const ResponseConfig& config_;
  const Transport& transport_;
  std::vector<GammaLine> lines_;
  double lines_per_decay_ = 0.0;
  Digitizer digitizer_;
  EventFinder events_;
  std::vector<Hit> hits_;
};

struct Response {
  ResponseTable table;
  AngularSummary angular;  ///< over all directions of the grid that were simulated
  /// Those of all directions, each weighted so that a source is as likely in any direction.
  std::vector<SimulatedPair> pairs;
};

/// The whole table. Of directions that the block's symmetries (a turn by 90 degrees about z, the mirror x <-> y) make
/// equal one is simulated. `progress` is called with the share done, by one thread at a time. The result is the same
/// whatever the number of threads. Throws as `check` does.
[[nodiscard]] Response make_response(const ResponseConfig& config, const Material& cdte,
                                     const std::function<void(double)>& progress = {});

}  // namespace comptonaut
