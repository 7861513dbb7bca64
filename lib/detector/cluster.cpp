// SPDX-License-Identifier: BSD-3-Clause
#include "detector/cluster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "detector/touching.h"

namespace comptonaut {
namespace {

constexpr int kStride = kChipPixels + 2;  // a frame of one pixel saves the tests at the edges
constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();
constexpr std::array<int, 8> kNeighbours = {-kStride - 1, -kStride, -kStride + 1, -1, 1,
                                            kStride - 1,  kStride,  kStride + 1};

constexpr std::size_t kMaxFew = 16;     ///< hits of a burst that are looked at one by one
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
inline void add_hit(const SensorConfig& sensor, const Hit& hit, double energy_keV, Cluster& cluster) {
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

/// A cluster without hits whose first one is to be this.
Cluster begun(const Hit& first) {
  Cluster cluster;
  cluster.t = first.t;
  cluster.min_pixel = first.pixel;
  return cluster;
}

/// Sums over hits become means.
void finish(Cluster& cluster) {
  const double per_keV = 1.0 / cluster.energy_keV;
  cluster.x_px *= per_keV;
  cluster.y_px *= per_keV;
  cluster.offset_ns = rounded_ns(cluster.offset_ns * per_keV);
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
    const std::span<const Hit> burst = hits.subspan(first, last - first);
    const double* const burst_keV = energies_keV_.data() + first;
    if (!find_handful(burst, burst_keV) && !find_few(burst, burst_keV)) find_any(burst, burst_keV);
  }
  sort_clusters();
  return clusters_;
}

/// The usual: a handful of hits within one window, all with energy, none of the same pixel. False, and nothing done: it
/// is not so. Nearly without branches, since nothing foretells which way they would go.
template <std::size_t kHits>
inline bool ClusterFinder::find_handful(std::span<const Hit> burst, const double* energies_keV) {
  bool usual = burst[kHits - 1].t - burst[0].t <= window_;
  std::array<Place, kHits> places;
  std::uint32_t touching = 0;
  for (std::size_t j = 0; j < kHits; ++j) {
    places[j] = place_of(burst[j].pixel);
    usual &= energies_keV[j] > 0.0;
    for (std::size_t i = 0; i < j; ++i) {
      touching |= static_cast<std::uint32_t>(touch(places[i], places[j])) << pair_of(i, j);
      usual &= places[i] != places[j];
    }
  }
  if (!usual) return false;

  const SensorConfig sensor = sensor_;
  constexpr Members kAll = (1U << kHits) - 1;
  Members clusters = kMembers[touching] & 0x1111 * kAll;
  if (clusters == kAll) {
    Cluster cluster = begun(burst[0]);
    for (std::size_t i = 0; i < kHits; ++i) add_hit(sensor, burst[i], energies_keV[i], cluster);
    finish(cluster);
    clusters_.emplace_back() = cluster;
    return true;
  }
  for (; clusters != 0; clusters >>= kMaxHandful) {
    Members hits = clusters & kAll;
    Cluster cluster = begun(burst[static_cast<std::size_t>(std::countr_zero(hits))]);
    for (; hits != 0; hits &= hits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(hits));
      add_hit(sensor, burst[i], energies_keV[i], cluster);
    }
    finish(cluster);
    clusters_.emplace_back() = cluster;
  }
  return true;
}

inline bool ClusterFinder::find_handful(std::span<const Hit> burst, const double* energies_keV) {
  switch (burst.size()) {
    case 1:
      return find_handful<1>(burst, energies_keV);
    case 2:
      return find_handful<2>(burst, energies_keV);
    case 3:
      return find_handful<3>(burst, energies_keV);
    case 4:
      return find_handful<4>(burst, energies_keV);
    default:
      return false;
  }
}

/// The next usual: few hits, all with energy, none of a pixel that had just fired. False, and nothing done: it is not
/// so. Nearly without branches.
bool ClusterFinder::find_few(std::span<const Hit> burst, const double* energies_keV) {
  if (burst.size() > kMaxFew) return false;
  std::array<Place, kMaxFew> places;
  std::array<std::uint32_t, kMaxFew> cluster_of;  // of each hit, as the bit of its cluster's first one
  std::uint32_t clusters = 0;                     // these bits together
  bool usual = true;
  for (std::size_t i = 0, in_window = 0; i < burst.size(); ++i) {
    places[i] = place_of(burst[i].pixel);
    usual &= energies_keV[i] > 0.0;
    while (burst[i].t - burst[in_window].t > window_) ++in_window;
    std::uint32_t touched = 0;
    for (std::size_t j = in_window; j < i; ++j) {
      touched |= cluster_of[j] & -static_cast<std::uint32_t>(touch(places[i], places[j]));
      usual &= places[i] != places[j];
    }
    const std::uint32_t joined = touched | 1U << i;
    cluster_of[i] = joined & -joined;
    clusters = (clusters & ~touched) | cluster_of[i];
    if ((touched & (touched - 1)) == 0) continue;  // it joins no two
    for (std::size_t j = 0; j < i; ++j) cluster_of[j] = (touched & cluster_of[j]) != 0 ? cluster_of[i] : cluster_of[j];
  }
  if (!usual) return false;

  const SensorConfig sensor = sensor_;
  const std::size_t before = clusters_.size();
  std::array<std::size_t, kMaxFew> at;  // of the clusters' first hits
  for (; clusters != 0; clusters &= clusters - 1) {
    const auto first = static_cast<std::size_t>(std::countr_zero(clusters));
    at[first] = clusters_.size();
    clusters_.emplace_back() = begun(burst[first]);
  }
  Cluster* const found = clusters_.data();
  for (std::size_t i = 0; i < burst.size(); ++i) {
    add_hit(sensor, burst[i], energies_keV[i], found[at[static_cast<std::size_t>(std::countr_zero(cluster_of[i]))]]);
  }
  for (Cluster& cluster : std::span(clusters_).subspan(before)) finish(cluster);
  return true;
}

void ClusterFinder::find_any(std::span<const Hit> burst, const double* energies_keV) {
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
      clusters_.push_back(begun(hits[i]));
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
