// SPDX-License-Identifier: BSD-3-Clause
// Rows in order of arrival become hits in order of time: the quick ways against slow ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <span>

#include "core/random.h"
#include "detector/epoch_repair.h"
#include "detector/make_hits.h"
#include "detector/time_order.h"

namespace comptonaut {
namespace {

/// Clusters of one to four rows, `mean_gap` apart, their rows in any order within a microsecond; one cluster in so many
/// is off by the epoch fault, and one in five times as many comes far too late.
std::vector<Hit> rows(Random& random, int clusters, double mean_gap, std::uint64_t one_off_in = 10) {
  std::vector<Hit> rows;
  double t = 1e7;
  for (int i = 0; i < clusters; ++i) {
    t += mean_gap * random.exponential();
    const auto pixel = static_cast<std::uint16_t>(random() % 65000);
    const ChipTime fault = random() % one_off_in == 0 ? kEpochFault : 0,
                   late = random() % (5 * one_off_in) == 0 ? 5000 : 0;
    for (std::uint64_t k = random() % 4 + 1; k > 0; --k) {
      rows.push_back({.t = static_cast<ChipTime>(t + random.uniform(0.0, 640.0)) + fault - late,
                      .pixel = static_cast<std::uint16_t>(pixel + k),
                      .tot = static_cast<std::uint16_t>(rows.size() % 1000 + 1)});
    }
  }
  return rows;
}

/// Mean gaps from a chip at its limit to a background.
constexpr double kMeanGaps[] = {300.0, 6e3, 4e4, 1e5, 4e5, 1e6, 1e7};

TEST(TimeOrder, IsThatOfASortThatKeepsTheOrderOfArrival) {
  Random random(31);
  for (const double mean_gap : kMeanGaps) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Hit> hits = rows(random, 200, mean_gap);
      for (Hit& hit : hits) hit.t -= hit.t % (trial % 2 == 0 ? 1 : 200);  // many at the same time
      TimeOrder order(200);
      std::vector<Hit> released;
      for (std::size_t at = 0, piece = 0; at < hits.size(); at += piece) {
        piece = std::min<std::size_t>(random() % 80, hits.size() - at);
        EXPECT_EQ(order.add(std::span(hits).subspan(at, piece)), 0);
        const auto part = order.release(hits[at].t - 2 * kEpochFault);
        released.insert(released.end(), part.begin(), part.end());
      }
      const auto rest = order.release(std::numeric_limits<ChipTime>::max());
      released.insert(released.end(), rest.begin(), rest.end());
      std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
      EXPECT_EQ(released, hits) << mean_gap << " " << trial;
    }
  }
}

TEST(TimeOrder, LeavesOutAndCountsWhatComesAfterItsTimeWasReleased) {
  TimeOrder order(10);
  const std::vector<Hit> early = {{.t = 100}, {.t = 300}, {.t = 500}},
                         late = {{.t = 90}, {.t = 450}, {.t = 80}, {.t = 600}};
  EXPECT_EQ(order.add(early), 0);
  EXPECT_EQ(order.release(400).size(), 2u);
  EXPECT_EQ(order.add(late), 2);
  const auto rest = order.release(1000);
  EXPECT_EQ(std::vector(rest.begin(), rest.end()), (std::vector<Hit>{{.t = 450}, {.t = 500}, {.t = 600}}));
}

/// Rows become the same at once and row by row, and more than so many are repaired.
void expect_the_same_row_by_row(std::span<const Hit> all, double mean_gap, std::int64_t repaired_min) {
  EpochRepair at_once, row_by_row;
  std::vector<Hit> whole, single;
  const auto append = [](std::vector<Hit>& to, std::span<const Hit> hits) {
    to.insert(to.end(), hits.begin(), hits.end());
  };
  append(whole, at_once.add(all));
  append(whole, at_once.flush());
  for (const Hit& row : all) append(single, row_by_row.add({&row, 1}));
  append(single, row_by_row.flush());
  EXPECT_EQ(whole, single) << mean_gap;
  EXPECT_EQ(whole.size(), all.size());
  EXPECT_GT(at_once.repaired(), repaired_min) << mean_gap;
}

TEST(EpochRepair, DecidesTheSameRowByRow) {
  Random random(32);
  for (const double mean_gap : kMeanGaps) {
    expect_the_same_row_by_row(rows(random, 3000, mean_gap), mean_gap, mean_gap < 1e6 ? 100 : 0);
  }
}

// Long calm stretches are taken several rows at once.
TEST(EpochRepair, DecidesTheSameRowByRowWhereFaultsAreSeldom) {
  constexpr std::uint64_t kOneOffIn = 300;
  Random random(33);
  for (const double mean_gap : kMeanGaps) {
    expect_the_same_row_by_row(rows(random, 20'000, mean_gap, kOneOffIn), mean_gap, mean_gap < 1e6 ? 10 : 0);
  }
}

}  // namespace
}  // namespace comptonaut
