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

constexpr std::size_t kMaxOne = 8;      ///< hits that may be looked at as one cluster
constexpr std::uint32_t kFew = 24;      ///< hits in the window that are quicker looked at one by one
constexpr std::size_t kMeanSteps = 16;  ///< that a cluster may be out of place, before a sort is quicker

std::size_t slot(std::uint16_t pixel) {
  return static_cast<std::size_t>((pixel_y(pixel) + 1) * kStride + pixel_x(pixel) + 1);
}

/// To 1/1024 ns, so that differences of cluster times are exact and their order is one.
double rounded_ns(double offset_ns) {
  constexpr double kNoFraction = 0x1.8p52;  // what is added to it keeps no digits behind the point
  return (offset_ns * 1024.0 + kNoFraction - kNoFraction) / 1024.0;
}

/// Adds a hit; place and time are sums weighted by energy until finish().
void add_hit(const SensorConfig& sensor, const Hit& hit, double energy_keV, Cluster& cluster) {
  const double charge_ns = static_cast<double>(hit.t - cluster.t) * kChipTime_ns - time_walk_ns(sensor, energy_keV);
  cluster.offset_ns += energy_keV * charge_ns;
  cluster.x_px += energy_keV * pixel_x(hit.pixel);
  cluster.y_px += energy_keV * pixel_y(hit.pixel);
  cluster.energy_keV += energy_keV;
  cluster.tot_sum += hit.tot;
  cluster.size_px += 1;
  cluster.min_pixel = std::min(cluster.min_pixel, hit.pixel);
  cluster.saturated |= hit.tot >= kSaturatedTot;
}

/// Sums over hits become means.
void finish(Cluster& cluster) {
  const double per_keV = 1.0 / cluster.energy_keV;
  cluster.x_px *= per_keV;
  cluster.y_px *= per_keV;
  cluster.offset_ns = rounded_ns(cluster.offset_ns * per_keV);
}

/// Columns and rows from one pixel to another are -1, 0 or 1.
bool touch(std::uint16_t a, std::uint16_t b) {
  const auto near = [](int d) { return static_cast<unsigned>(d + 1) <= 2; };
  return near(pixel_x(a) - pixel_x(b)) & near(pixel_y(a) - pixel_y(b));
}

}  // namespace

ClusterFinder::ClusterFinder(const SensorConfig& sensor, double window_ns)
    : sensor_(sensor),
      window_(static_cast<ChipTime>(std::floor(window_ns / kChipTime_ns))),
      latest_(std::size_t{kStride} * kStride, 0) {}

std::span<const Cluster> ClusterFinder::find(std::span<const Hit> hits, const Calibration& calibration) {
  clusters_.clear();
  energies_keV_.resize(hits.size());
  calibration.energies_keV(hits, energies_keV_);
  for (std::size_t first = 0, last = 0; first < hits.size(); first = last) {
    for (++last; last < hits.size() && hits[last].t - hits[last - 1].t <= window_;) ++last;
    const auto burst = hits.subspan(first, last - first);
    const double* const energies_keV = energies_keV_.data() + first;
    if (!find_one(burst, energies_keV)) find_several(burst, energies_keV);
  }
  sort_clusters();
  return clusters_;
}

/// The usual case, quicker: few hits within one window, each beside an earlier one, are one cluster. False: they may
/// not be.
inline bool ClusterFinder::find_one(std::span<const Hit> burst, const double* energies_keV) {
  if (burst.size() > kMaxOne || burst.back().t - burst.front().t > window_) return false;
  bool one = energies_keV[0] > 0.0;
  for (std::size_t i = 1; i < burst.size(); ++i) {
    bool touches = false, repeats = false;
    for (std::size_t j = 0; j < i; ++j) {
      touches |= touch(burst[i].pixel, burst[j].pixel);
      repeats |= burst[i].pixel == burst[j].pixel;
    }
    one = one & touches & !repeats & (energies_keV[i] > 0.0);
  }
  if (!one) return false;
  Cluster& cluster = clusters_.emplace_back();
  cluster.t = burst[0].t;
  cluster.min_pixel = burst[0].pixel;
  for (std::size_t i = 0; i < burst.size(); ++i) add_hit(sensor_, burst[i], energies_keV[i], cluster);
  finish(cluster);
  return true;
}

void ClusterFinder::find_several(std::span<const Hit> burst, const double* energies_keV) {
  link(burst, energies_keV);
  sum(burst, energies_keV);
}

/// Joins each hit with those of its neighbours that came within the window before it.
void ClusterFinder::link(std::span<const Hit> hits, const double* energies_keV) {
  if (hits.size() >= kLeftOut - first_serial_) {
    std::fill(latest_.begin(), latest_.end(), 0);
    first_serial_ = 1;
  }
  parent_.resize(hits.size());
  in_table_ = 0;
  std::uint32_t first = 0;  // within the window before hit i
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    parent_[i] = kLeftOut;
    if (energies_keV[i] == 0.0) {
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
void ClusterFinder::sum(std::span<const Hit> hits, const double* energies_keV) {
  cluster_of_.resize(hits.size());
  const std::size_t before = clusters_.size();
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    if (parent_[i] == kLeftOut) continue;
    if (parent_[i] == i) {
      cluster_of_[i] = static_cast<std::uint32_t>(clusters_.size());
      clusters_.push_back({.t = hits[i].t, .min_pixel = hits[i].pixel});
    } else {
      cluster_of_[i] = cluster_of_[parent_[i]];
    }
    add_hit(sensor_, hits[i], energies_keV[i], clusters_[cluster_of_[i]]);
  }
  for (Cluster& cluster : std::span(clusters_).subspan(before)) finish(cluster);
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
