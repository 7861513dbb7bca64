// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/calibration.h"
#include "detector/hit.h"
#include "detector/sensor.h"

namespace comptonaut {

/// Neighbouring pixels that fired together: one deposit of energy.
struct Cluster {
  ChipTime t = 0;          ///< of its earliest hit, as measured
  double offset_ns = 0.0;  ///< from t to the arrival of its charge: energy-weighted, freed of time walk
  double x_px = 0.0;       ///< energy-weighted centroid, pixel coordinates of the chip
  double y_px = 0.0;
  double energy_keV = 0.0;
  std::int32_t tot_sum = 0;     ///< ticks
  std::int32_t size_px = 0;     ///< hits
  std::uint16_t min_pixel = 0;  ///< lowest matrix index: settles ties
  bool saturated = false;       ///< a hit's ToT is at the counter's end: the energy is a lower bound
};

/// Time of a cluster on the chip's clock, ns.
[[nodiscard]] inline double time_ns(const Cluster& cluster) {
  return static_cast<double>(cluster.t) * kChipTime_ns + cluster.offset_ns;
}
/// Time of `late` after `early`, ns; exact however long the chip has been counting.
[[nodiscard]] inline double between_ns(const Cluster& early, const Cluster& late) {
  return static_cast<double>(late.t - early.t) * kChipTime_ns + late.offset_ns - early.offset_ns;
}
/// Earlier first; at the same time the lower pixel index.
[[nodiscard]] inline bool is_earlier(const Cluster& a, const Cluster& b) {
  const double dt_ns = between_ns(a, b);
  return dt_ns > 0.0 || (dt_ns == 0.0 && a.min_pixel < b.min_pixel);
}

/// Two hits of neighbouring pixels (8-neighbourhood, or the same pixel) within this time are of one cluster, and so on
/// from hit to hit.
inline constexpr double kClusterWindow_ns = 200.0;

/// Finds clusters in linear time. Keeps memory of its own for reuse, nothing of earlier calls.
class ClusterFinder {
 public:
  ClusterFinder(const SensorConfig& sensor, double window_ns);

  /// Clusters of hits that are ordered by time, themselves ordered by is_earlier. Hits of masked pixels and of ToT 0
  /// are left out unless their energy is given, as is a hit on a pixel that fired within the window before: a pixel
  /// cannot. Valid until the next call.
  [[nodiscard]] std::span<const Cluster> find(std::span<const Hit> hits, const Calibration& calibration);

  /// Hits of repeated pixels left out so far.
  [[nodiscard]] std::int64_t repeated() const { return repeated_; }
  /// Hits left out so far because their pixel's calibration gives them no energy.
  [[nodiscard]] std::int64_t without_energy() const { return without_energy_; }

 private:
  template <std::size_t kHits>
  [[nodiscard]] bool find_handful(std::span<const Hit> burst, const double* energies_keV);
  [[nodiscard]] bool find_handful(std::span<const Hit> burst, const double* energies_keV);
  [[nodiscard]] bool find_few(std::span<const Hit> burst, const double* energies_keV);
  void find_any(std::span<const Hit> burst, const double* energies_keV);
  void link(std::span<const Hit> hits, const double* energies_keV);
  [[nodiscard]] bool link_few(std::span<const Hit> hits, std::uint32_t first, std::uint32_t i);
  [[nodiscard]] bool link_many(std::span<const Hit> hits, std::uint32_t first, std::uint32_t i);
  void sum(std::span<const Hit> hits, const double* energies_keV);
  void sort_clusters();
  std::uint32_t root(std::uint32_t hit);
  void unite(std::uint32_t a, std::uint32_t b);

  SensorConfig sensor_;
  ChipTime window_;
  std::vector<std::uint32_t> latest_;  ///< per pixel, with a frame of one: serial number of its latest hit, where many
                                       ///< came at a time
  std::uint32_t first_serial_ = 1;
  std::uint32_t in_table_ = 0;         ///< hits before this index need no place in `latest_` any more
  std::vector<std::uint32_t> parent_;  ///< union-find over hits; kLeftOut for hits that are of no cluster
  std::vector<double> energies_keV_;   ///< of each hit
  std::vector<std::uint32_t> cluster_of_;
  std::vector<Cluster> clusters_;
  std::int64_t repeated_ = 0;
  std::int64_t without_energy_ = 0;
};

}  // namespace comptonaut
