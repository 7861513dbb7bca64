// SPDX-License-Identifier: BSD-3-Clause
#include "detector/cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <tuple>

#include "core/random.h"
#include "detector/make_hits.h"

namespace comptonaut {
namespace {

using Summary = std::tuple<ChipTime, std::uint16_t, std::int32_t, std::int32_t>;  // t, lowest pixel, size, sum of ToT

std::vector<Summary> fast(const std::vector<Hit>& hits) {
  ClusterFinder finder(SensorConfig{}, kClusterWindow_ns);
  std::vector<Summary> found;
  for (const Cluster& c : finder.find(hits, typical_calibration())) {
    found.emplace_back(c.t, c.min_pixel, c.size_px, c.tot_sum);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Every hit against every other, labels passed on until nothing changes.
std::vector<Summary> obvious(const std::vector<Hit>& hits) {
  const ChipTime window = static_cast<ChipTime>(kClusterWindow_ns / kChipTime_ns);
  std::vector<Hit> kept;
  for (const Hit& hit : hits) {
    const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const Hit& other) {
      return other.pixel == hit.pixel && hit.t - other.t <= window;
    });
    if (!repeated) kept.push_back(hit);
  }
  std::vector<std::size_t> label(kept.size());
  std::iota(label.begin(), label.end(), 0u);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      for (std::size_t j = 0; j < kept.size(); ++j) {
        const Hit &a = kept[i], &b = kept[j];
        const bool joined = std::abs(a.t - b.t) <= window && std::abs(pixel_x(a.pixel) - pixel_x(b.pixel)) <= 1 &&
                            std::abs(pixel_y(a.pixel) - pixel_y(b.pixel)) <= 1;
        if (!joined || label[j] <= label[i]) continue;
        label[j] = label[i];
        changed = true;
      }
    }
  }
  std::vector<Summary> found;
  for (std::size_t first = 0; first < kept.size(); ++first) {
    Summary sum{kept[first].t, kept[first].pixel, 0, 0};
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (label[i] != first) continue;
      std::get<1>(sum) = std::min(std::get<1>(sum), kept[i].pixel);
      ++std::get<2>(sum);
      std::get<3>(sum) += kept[i].tot;
    }
    if (label[first] == first) found.push_back(sum);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Crowded: `edge` x `edge` pixels at a corner or the middle, so that clusters touch, meet late and repeat.
std::vector<Hit> random_hits(Random& random, int count, int edge, double mean_gap_ns) {
  std::vector<Hit> hits;
  const int corner = static_cast<int>(random.uniform(0.0, kChipPixels - edge + 0.999));
  double t_ns = 1e6;
  for (int i = 0; i < count; ++i) {
    t_ns += mean_gap_ns * random.exponential();
    hits.push_back({.t = chip_time_ns(t_ns),
                    .pixel = pixel_at(corner + static_cast<int>(random.uniform(0.0, edge)),
                                      corner + static_cast<int>(random.uniform(0.0, edge))),
                    .tot = static_cast<std::uint16_t>(1.0 + random.uniform(0.0, 500.0))});
  }
  return hits;
}

TEST(Clusters, AreThoseOfComparingEveryHitWithEveryOther) {
  Random random(20261);
  for (int trial = 0; trial < 300; ++trial) {
    const int edge = 3 + trial % 30;
    const auto hits = random_hits(random, 60, edge, 5.0 + trial % 9 * 30.0);  // bursts of all to of one
    EXPECT_EQ(fast(hits), obvious(hits)) << "trial " << trial;
  }
}

TEST(Clusters, OfUpToFourHitsAreThatWhereverTheseLie) {
  constexpr unsigned kColumns = 5, kPlaces = 2 * kColumns;  // apart, beside each other, joined by a later one, the same
  for (unsigned count = 1, layouts = kPlaces; count <= 4; ++count, layouts *= kPlaces) {
    for (unsigned layout = 0; layout < layouts; ++layout) {
      std::vector<Hit> hits;
      for (unsigned i = 0, rest = layout; i < count; ++i, rest /= kPlaces) {
        const int column = static_cast<int>(rest % kColumns), row = static_cast<int>(rest / kColumns % 2);
        hits.push_back({.t = chip_time_ns(1000.0 + 30.0 * i),
                        .pixel = pixel_at(100 + column, 100 + 2 * row),
                        .tot = static_cast<std::uint16_t>(50 + i)});
      }
      ASSERT_EQ(fast(hits), obvious(hits)) << count << " hits, layout " << layout;
    }
  }
}

TEST(Clusters, OneFinderGivesTheSameCallAfterCall) {
  Random random(20262);
  ClusterFinder finder(SensorConfig{}, kClusterWindow_ns);
  for (int trial = 0; trial < 50; ++trial) {
    const auto hits = random_hits(random, 40, 6, 30.0);
    EXPECT_EQ(finder.find(hits, typical_calibration()).size(), fast(hits).size()) << "trial " << trial;
  }
}

TEST(Clusters, DoNotReachAroundTheChipsEdge) {
  EXPECT_EQ(fast({make_hit(255, 10, 50.0, 0.0), make_hit(0, 11, 50.0, 0.0)}).size(), 2u);
  EXPECT_EQ(fast({make_hit(0, 0, 50.0, 0.0), make_hit(255, 255, 50.0, 0.0)}).size(), 2u);
}

TEST(Clusters, TimeIsFreedOfTimeWalk) {
  for (const double energy_keV : {6.0, 20.0, 60.0, 400.0}) {
    ClusterFinder finder(SensorConfig{}, kClusterWindow_ns);
    const std::vector<Hit> hits = {make_hit(10, 10, energy_keV, 1e6)};
    const auto clusters = finder.find(hits, typical_calibration());
    ASSERT_EQ(clusters.size(), 1u);
    EXPECT_NEAR(time_ns(clusters[0]), 1e6, energy_keV < 10.0 ? 3.0 : 1.0) << energy_keV << " keV";
  }
}

TEST(Clusters, HitsWithoutEnergyAreLeftOutAndCounted) {
  ClusterFinder finder(SensorConfig{}, kClusterWindow_ns);
  const std::vector<Hit> hits = {{.t = 0, .pixel = 5, .tot = 0}, {.t = 1, .pixel = 700, .tot = 50}};
  EXPECT_EQ(finder.find(hits, typical_calibration()).size(), 1u);
  EXPECT_EQ(finder.without_energy(), 1);
}

}  // namespace
}  // namespace comptonaut
