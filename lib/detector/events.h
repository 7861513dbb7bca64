// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detector/calibration.h"
#include "detector/cluster.h"
#include "detector/hit.h"
#include "detector/nuclide.h"
#include "detector/pair.h"
#include "detector/reading.h"
#include "detector/sensor.h"

namespace comptonaut {

enum class EventKind { kSingle, kPair, kOther };

/// What one photon left: a coincidence group, told apart by the nuclides' windows.
struct DetectorEvent {
  DetectorEvent() {}  // a defaulted one would be zeroed as a whole first

  EventKind kind = EventKind::kOther;
  int channel = -1;  ///< index into EventRules::channels; -1: of none
  int clusters = 0;  ///< in the group, before fluorescence was merged
  int hits = 0;      ///< in the group
  std::int64_t tot_ticks = 0;
  double energy_keV = 0.0;                   ///< of the whole group
  Cluster first;                             ///< the earlier cluster, with the fluorescence that belongs to it
  Cluster second;                            ///< what else is left of the group; of a pair, the later cluster
  std::optional<PairHypotheses> hypotheses;  ///< of a pair only
};

/// Everything that decides which hits become which events. The same rules read the detector and make the response
/// table.
struct EventRules {
  SensorConfig sensor;
  double cluster_window_ns = kClusterWindow_ns;
  double fluorescence_min_keV = 20.0;  ///< K-fluorescence of Cd and Te, as clusters show it
  double fluorescence_max_keV = 35.0;
  double fluorescence_radius_px = 15.0;  ///< fluorescence within this distance belongs to its neighbour
  double pair_distance_min_px = 15.0;
  bool constrain_to_line = true;  ///< E_0 is the line, the energies fitted to it; else E_0 = E_1 + E_2
  std::vector<NuclideChannel> channels = {NuclideChannel{}};
};

/// Throws std::invalid_argument that names what is wrong.
void check(const EventRules& rules);

/// From hits to events: clusters, coincidence groups (all clusters within the drift time of each other), fluorescence
/// merged, then classified. Keeps memory of its own for reuse, nothing of earlier calls.
class EventFinder {
 public:
  EventFinder(const EventRules& rules, Calibration calibration);

  /// Events of hits that are ordered by time, one per coincidence group, in order of time. Valid until the next call.
  /// Call it for one photon's hits, or for a stretch of a stream that begins and ends with at least quiet() between
  /// hits: then the events of a stream are those of its stretches.
  [[nodiscard]] std::span<const DetectorEvent> find(std::span<const Hit> hits);
  /// All clusters of the latest call, before fluorescence was merged.
  [[nodiscard]] std::span<const Cluster> clusters() const { return clusters_; }

  /// Hits farther apart than this are never of one event.
  [[nodiscard]] ChipTime quiet() const;
  [[nodiscard]] const ClusterFinder& cluster_finder() const { return cluster_finder_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }

 private:
  void add_event(std::span<const Cluster> group);

  EventRules rules_;
  Calibration calibration_;
  ClusterFinder cluster_finder_;
  double drift_ns_;
  std::vector<PairReader> pair_readers_;  ///< one per channel
  std::span<const Cluster> clusters_;
  std::vector<Cluster> group_;
  std::vector<DetectorEvent> events_;
};

/// The same once, for tests and small tasks.
[[nodiscard]] std::vector<DetectorEvent> find_events(std::span<const Hit> hits, const EventRules& rules,
                                                     const Calibration& calibration);

}  // namespace comptonaut
