// SPDX-License-Identifier: BSD-3-Clause
#include "detector/cluster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

constexpr int kStride = kChipPixels + 2;  // a frame of one pixel saves the tests at the edges
constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();
constexpr std::array<int, 8> kNeighbours = {-kStride - 1, -kStride, -kStride + 1, -1, 1,
                                            kStride - 1,  kStride,  kStride + 1};

constexpr std::uint32_t kFew = 24;      ///< hits in the window that are quicker looked at one by one
constexpr std::size_t kMeanSteps = 16;  ///< that a cluster may be out of place, before a sort is quicker

std::size_t slot(std::uint16_t pixel) {
  return static_cast<std::size_t>((pixel_y(pixel) + 1) * kStride + pixel_x(pixel) + 1);
}

/// To 1/1024 ns, so that differences of cluster times are exact and their order is one.
double rounded_ns(double offset_ns) { return std::round(offset_ns * 1024.0) / 1024.0; }

/// Sums over hits become means.
void finish(Cluster& cluster) {
  cluster.x_px /= cluster.energy_keV;
  cluster.y_px /= cluster.energy_keV;
  cluster.offset_ns = rounded_ns(cluster.offset_ns / cluster.energy_keV);
}

}  // namespace

ClusterFinder::ClusterFinder(const SensorConfig& sensor, double window_ns)
    : sensor_(sensor),
      window_(static_cast<ChipTime>(std::floor(window_ns / kChipTime_ns))),
      latest_(std::size_t{kStride} * kStride, 0) {}

std::span<const Cluster> ClusterFinder::find(std::span<const Hit> hits, const Calibration& calibration) {
  clusters_.clear();
  energy_keV_.resize(hits.size());
  calibration.energies_keV(hits, energy_keV_);
  link(hits);
  sum(hits);
  sort_clusters();
  return clusters_;
}

/// Joins each hit with those of its neighbours that came within the window before it.
void ClusterFinder::link(std::span<const Hit> hits) {
  if (hits.size() >= kLeftOut - first_serial_) {
    std::fill(latest_.begin(), latest_.end(), 0);
    first_serial_ = 1;
  }
  parent_.resize(hits.size());
  in_table_ = 0;
  std::uint32_t first = 0;  // within the window before hit i
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    parent_[i] = kLeftOut;
    if (energy_keV_[i] == 0.0) {
      ++without_energy_;
      continue;
    }
    while (hits[i].t - hits[first].t > window_) ++first;
    const bool joined = i - first <= kFew ? link_few(hits, first, i) : link_many(hits, first, i);
    repeated_ += joined ? 0 : 1;
  }
  first_serial_ += static_cast<std::uint32_t>(hits.size());
}

/// Looks at each hit of the window. False: one of them was of the same pixel.
bool ClusterFinder::link_few(std::span<const Hit> hits, std::uint32_t first, std::uint32_t i) {
  std::array<std::uint32_t, kFew> beside;
  std::size_t count = 0;
  const int x = pixel_x(hits[i].pixel), y = pixel_y(hits[i].pixel);
  for (std::uint32_t j = first; j < i; ++j) {
    const int dx = pixel_x(hits[j].pixel) - x, dy = pixel_y(hits[j].pixel) - y;
    if (dx < -1 || dx > 1 || dy < -1 || dy > 1 || parent_[j] == kLeftOut) continue;
    if (dx == 0 && dy == 0) return false;
    beside[count++] = j;
  }
  parent_[i] = i;
  for (std::size_t k = 0; k < count; ++k) unite(i, beside[k]);
  return true;
}

/// The same by a table of the latest hit of each pixel, whose cost does not grow with the hits of the window. Older
/// ones of the same pixel need no look: they are either too old or were left out as repeated.
bool ClusterFinder::link_many(std::span<const Hit> hits, std::uint32_t first, std::uint32_t i) {
  for (in_table_ = std::max(in_table_, first); in_table_ < i; ++in_table_) {
    if (parent_[in_table_] != kLeftOut) latest_[slot(hits[in_table_].pixel)] = first_serial_ + in_table_;
  }
  const auto in_window = [&](std::uint32_t serial) { return serial >= first_serial_ + first; };
  const std::uint32_t* latest = &latest_[slot(hits[i].pixel)];
  if (in_window(*latest)) return false;
  parent_[i] = i;
  for (const int step : kNeighbours) {
    if (in_window(latest[step])) unite(i, latest[step] - first_serial_);
  }
  return true;
}

/// Parents come before their children, and the earliest hit of a cluster is its own parent.
void ClusterFinder::sum(std::span<const Hit> hits) {
  cluster_of_.resize(hits.size());
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    if (parent_[i] == kLeftOut) continue;
    const Hit& hit = hits[i];
    if (parent_[i] == i) {
      cluster_of_[i] = static_cast<std::uint32_t>(clusters_.size());
      clusters_.push_back({.t = hit.t, .min_pixel = hit.pixel});
    } else {
      cluster_of_[i] = cluster_of_[parent_[i]];
    }
    Cluster& cluster = clusters_[cluster_of_[i]];
    const double energy_keV = energy_keV_[i];
    const double charge_ns = static_cast<double>(hit.t - cluster.t) * kChipTime_ns - time_walk_ns(sensor_, energy_keV);
    cluster.offset_ns += energy_keV * charge_ns;
    cluster.x_px += energy_keV * pixel_x(hit.pixel);
    cluster.y_px += energy_keV * pixel_y(hit.pixel);
    cluster.energy_keV += energy_keV;
    cluster.tot_sum += hit.tot;
    cluster.size_px += 1;
    cluster.min_pixel = std::min(cluster.min_pixel, hit.pixel);
    cluster.saturated |= hit.tot >= kSaturatedTot;
  }
  for (Cluster& cluster : clusters_) finish(cluster);
}

/// They are nearly in order: each is a few places off, if at all.
void ClusterFinder::sort_clusters() {
  std::size_t steps_left = kMeanSteps * clusters_.size();
  for (std::size_t i = 1; i < clusters_.size(); ++i) {
    if (!is_earlier(clusters_[i], clusters_[i - 1])) continue;
    const Cluster cluster = clusters_[i];
    std::size_t place = i;
    for (; place > 0 && steps_left > 0 && is_earlier(cluster, clusters_[place - 1]); --place, --steps_left) {
      clusters_[place] = clusters_[place - 1];
    }
    clusters_[place] = cluster;
    if (steps_left == 0) return std::stable_sort(clusters_.begin(), clusters_.end(), is_earlier);
  }
}

std::uint32_t ClusterFinder::root(std::uint32_t hit) {
  while (parent_[hit] != hit) hit = parent_[hit] = parent_[parent_[hit]];
  return hit;
}

void ClusterFinder::unite(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t root_a = root(a), root_b = root(b);
  parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

}  // namespace comptonaut
