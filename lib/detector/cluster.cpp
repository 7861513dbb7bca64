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
  link(hits, calibration);
  sum(hits);
  std::sort(clusters_.begin(), clusters_.end(), is_earlier);
  return clusters_;
}

/// Joins each hit with the latest hits of its neighbours. Older ones of the same pixel need no look: they are either
/// too old or were left out as repeated.
void ClusterFinder::link(std::span<const Hit> hits, const Calibration& calibration) {
  if (hits.size() >= kLeftOut - first_serial_) {
    std::fill(latest_.begin(), latest_.end(), 0);
    first_serial_ = 1;
  }
  parent_.assign(hits.size(), kLeftOut);
  energy_keV_.resize(hits.size());
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    const auto energy_keV = hits[i].energy_keV > 0.0F ? std::optional<double>(hits[i].energy_keV)
                                                      : calibration.energy_keV(hits[i].pixel, hits[i].tot);
    if (!energy_keV) {
      ++without_energy_;
      continue;
    }
    const auto in_window = [&](std::uint32_t serial) {
      return serial >= first_serial_ && hits[i].t - hits[serial - first_serial_].t <= window_;
    };
    std::uint32_t* latest = &latest_[slot(hits[i].pixel)];
    if (in_window(*latest)) {
      ++repeated_;
      continue;
    }
    parent_[i] = i;
    energy_keV_[i] = *energy_keV;
    *latest = first_serial_ + i;
    for (const int step : kNeighbours) {
      if (in_window(latest[step])) unite(i, latest[step] - first_serial_);
    }
  }
  first_serial_ += static_cast<std::uint32_t>(hits.size());
}

void ClusterFinder::sum(std::span<const Hit> hits) {
  cluster_of_.resize(hits.size());
  for (std::uint32_t i = 0; i < hits.size(); ++i) {
    if (parent_[i] == kLeftOut) continue;
    const std::uint32_t first = root(i);  // the earliest hit of its cluster
    if (first == i) {
      cluster_of_[i] = static_cast<std::uint32_t>(clusters_.size());
      clusters_.push_back({.t = hits[i].t, .min_pixel = hits[i].pixel});
    }
    Cluster& cluster = clusters_[cluster_of_[first]];
    const Hit& hit = hits[i];
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

std::uint32_t ClusterFinder::root(std::uint32_t hit) {
  while (parent_[hit] != hit) hit = parent_[hit] = parent_[parent_[hit]];
  return hit;
}

void ClusterFinder::unite(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t root_a = root(a), root_b = root(b);
  parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

}  // namespace comptonaut
