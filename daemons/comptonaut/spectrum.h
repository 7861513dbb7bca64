// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "detector/events.h"
#include "picture/picture.h"

namespace comptonaut {

/// Two histograms of energy: of all clusters, and of the summed energies of two clusters that came together and far
/// enough from each other to be a Compton pair, whatever their sum.
class Spectrum {
 public:
  /// From 0 to bins * bin_keV.
  Spectrum(double bin_keV, std::size_t bins);

  void add(std::span<const Cluster> clusters, std::span<const DetectorEvent> events, double pair_distance_min_px);

  [[nodiscard]] std::int64_t clusters() const { return clusters_; }
  [[nodiscard]] std::int64_t pairs() const { return pairs_; }
  /// Upper edge of the bin below which 99.95 % of clusters and pairs lie, a round number above the axis' least length.
  [[nodiscard]] double end_keV() const;

  /// Rows `from_keV,to_keV,clusters,pair_sums` up to max_keV.
  [[nodiscard]] std::string csv(double max_keV) const;
  /// Both histograms on a logarithmic scale up to max_keV, with the lines that the nuclides emit.
  [[nodiscard]] Chart picture(const std::string& title, double max_keV,
                              const std::vector<NuclideChannel>& nuclides) const;

 private:
  void count(double energy_keV, std::vector<std::int64_t>& histogram) const;
  [[nodiscard]] std::size_t bins_to(double max_keV) const;

  double bin_keV_;
  std::vector<std::int64_t> cluster_bins_, pair_bins_;
  std::int64_t clusters_ = 0;
  std::int64_t pairs_ = 0;
};

}  // namespace comptonaut
