// SPDX-License-Identifier: BSD-3-Clause
#include "detector/hit_stream.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "detector/make_hits.h"
#include "detector/read_stream.h"

namespace comptonaut {
namespace {

/// Clusters of one to four pixels at random places, in order of time but for a microsecond.
std::vector<Hit> random_clusters(Random& random, int count, double mean_gap_us) {
  std::vector<Hit> hits;
  double t_us = 100.0;
  for (int i = 0; i < count; ++i) {
    t_us += mean_gap_us * random.exponential();
    const int x = static_cast<int>(random.uniform(1.0, 254.0)), y = static_cast<int>(random.uniform(1.0, 254.0));
    const int size = 1 + static_cast<int>(random.uniform(0.0, 4.0));
    for (int k = 0; k < size; ++k) {
      hits.push_back({.t = static_cast<ChipTime>(t_us * kMicrosecond + random.uniform(0.0, 60.0)),
                      .pixel = pixel_at(x + k % 2, y + k / 2),
                      .tot = 40});
    }
  }
  return hits;
}

std::vector<Hit> sorted(std::vector<Hit> hits) {
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return hits;
}

TEST(HitStream, RowsComeOutInOrderOfTimeAndNoneIsLost) {
  Random random(1);
  auto hits = random_clusters(random, 3000, 0.7);
  const auto expected = sorted(hits);
  for (std::size_t i = 1; i < hits.size(); ++i) {
    if (random.uniform() < 0.3) std::swap(hits[i - 1], hits[i]);
  }
  const Read result = read(t3pa_text(hits));
  ASSERT_EQ(result.epochs.size(), 1u);
  EXPECT_EQ(result.epochs[0].size(), expected.size());
  EXPECT_TRUE(std::is_sorted(result.epochs[0].begin(), result.epochs[0].end(),
                             [](const Hit& a, const Hit& b) { return a.t < b.t; }));
  EXPECT_EQ(result.counts.faults.total(), 0);
}

// A row in fifty comes 490 us after its time, among a few rows a millisecond.
TEST(HitStream, RowsThatComeLateWithinTheReorderWindowFindTheirPlace) {
  Random random(12);
  std::vector<std::pair<ChipTime, Hit>> arrivals;
  for (Hit hit : random_clusters(random, 2000, 150.0)) {
    const ChipTime late = random.uniform() < 0.02 ? 490 * kMicrosecond : 0;
    arrivals.emplace_back(hit.t + late, hit);
  }
  std::stable_sort(arrivals.begin(), arrivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Hit> hits;
  for (const auto& [arrival, hit] : arrivals) hits.push_back(hit);
  const Read result = read(t3pa_text(hits), true, 40);
  EXPECT_EQ(result.counts.faults.total(), 0);
  EXPECT_EQ(result.epochs[0].size(), hits.size());
  EXPECT_EQ(result.epochs[0], sorted(result.epochs[0]));
}

TEST(HitStream, HitsAndClustersThatAreOffByOneEpochAreRepaired) {
  Random random(2);
  for (const double gap_us : {1.0, 20.0, 200.0}) {
    auto hits = random_clusters(random, 4000, gap_us);
    const auto expected = sorted(hits);
    std::int64_t planted = 0;
    for (std::size_t i = 0; i < hits.size();) {  // whole clusters, and single hits of clusters
      std::size_t end = i + 1;
      while (end < hits.size() && hits[end].t - hits[i].t < 60) ++end;
      const std::size_t from = random.uniform() < 0.5 ? i : end - 1;
      if (random.uniform() < 0.03) {
        for (std::size_t k = from; k < end; ++k, ++planted) hits[k].t += kEpochFault;
      }
      i = end;
    }
    const Read result = read(t3pa_text(hits));
    const double share = static_cast<double>(result.counts.repaired) / static_cast<double>(planted);
    // At 200 us between clusters some faults leave everything in order and no torn cluster: nobody can tell.
    EXPECT_NEAR(share, 1.0, gap_us < 100.0 ? 0.03 : 0.2) << gap_us << " us";
    if (gap_us < 100.0) {
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) wrong += result.epochs[0][i].t != expected[i].t ? 1 : 0;
      EXPECT_LT(wrong, expected.size() / 200) << gap_us << " us";
    }
  }
}

TEST(HitStream, AnEpochEndsNoEarlierThanItsLastRepairedHit) {
  std::vector<Hit> hits;
  for (int i = 0; i < 200; ++i) hits.push_back({.t = kSecond + i, .pixel = pixel_at(10 + i, 10), .tot = 40});
  for (int i = 190; i < 200; ++i) hits[static_cast<std::size_t>(i)].t -= kEpochFault;
  HitStream stream({}, kQuiet, true);
  const std::string text = t3pa_text(hits);
  stream.feed(text);
  while (stream.next()) continue;  // all wait
  stream.end();
  const auto last = stream.next();
  ASSERT_TRUE(last && last->ends_epoch && last->hits.size() == hits.size());
  EXPECT_EQ(stream.counts().repaired, 10);
  EXPECT_EQ(last->hits.back().t, kSecond + 199);
  EXPECT_GE(last->until, last->hits.back().t);
}

TEST(HitStream, HitsInOrderAreNotRepaired) {
  Random random(3);
  for (const double gap_us : {0.5, 5.0, 50.0, 500.0}) {
    EXPECT_LE(read(t3pa_text(random_clusters(random, 5000, gap_us))).counts.repaired, 3) << gap_us << " us";
  }
}

TEST(HitStream, AnAppendedMeasurementIsANewEpoch) {
  Random random(4);
  const auto first = random_clusters(random, 500, 100.0), second = random_clusters(random, 300, 100.0);
  std::string rows;
  for (std::size_t i = 0; i < second.size(); ++i) rows += t3pa_row(static_cast<std::int64_t>(i), second[i]);
  for (const std::string& header : {std::string(), kT3paHeader}) {
    const Read result = read(t3pa_text(first) + header + rows);
    ASSERT_EQ(result.epochs.size(), 2u);
    EXPECT_EQ(result.counts.epochs, 2);
    EXPECT_EQ(result.epochs[0].size(), first.size());
    EXPECT_EQ(result.epochs[1].size(), second.size());
    EXPECT_EQ(result.counts.faults.total(), 0);
  }
}

TEST(HitStream, ARowThatJumpsInTimeIsRefusedWithItsLine) {
  Random random(5);
  const auto hits = random_clusters(random, 500, 100.0);
  const std::size_t at = hits.size() / 2;
  for (const ChipTime t : {hits[at].t + 60 * kSecond, ChipTime{160}}) {
    auto wrong = hits;
    wrong[at].t = t;
    const Read result = read(t3pa_text(wrong));
    ASSERT_EQ(result.epochs.size(), 1u) << t;
    EXPECT_EQ(result.counts.faults.of(RowFault::kOutOfSequence), 1) << t;
    EXPECT_EQ(result.counts.faults.first_line[static_cast<std::size_t>(RowFault::kOutOfSequence)],
              static_cast<std::int64_t>(at) + 2)
        << t;
    EXPECT_EQ(result.epochs[0].size(), hits.size() - 1) << t;
  }
}

TEST(HitStream, ALongPauseIsBelievedWhenRowsAgree) {
  Random random(6);
  auto hits = random_clusters(random, 500, 100.0);
  for (std::size_t i = hits.size() / 2; i < hits.size(); ++i) hits[i].t += 3600 * kSecond;
  const Read result = read(t3pa_text(hits));
  ASSERT_EQ(result.epochs.size(), 1u);
  EXPECT_EQ(result.epochs[0].size(), hits.size());
}

TEST(HitStream, AliveLinesReleaseWhatCameBefore) {
  HitStream stream({}, kQuiet, false);
  const std::string text = "0 5 40000 9 0 0\n# alive 400000\n";
  stream.feed(text);
  std::size_t hits = 0;
  ChipTime until = 0;
  while (const auto part = stream.next()) {
    hits += part->hits.size();
    until = part->until;
  }
  EXPECT_EQ(hits, 1u);
  EXPECT_GT(until, 16 * 400000 - 5000 * kMicrosecond);
}

TEST(HitStream, AnyCutOfTheBytesGivesTheSameHits) {
  Random random(8);
  auto hits = random_clusters(random, 400, 30.0);
  for (std::size_t i = 10; i < hits.size(); i += 50) hits[i].t += kEpochFault;
  const std::string text = t3pa_text(hits);
  const Read whole = read(text);
  for (const std::size_t cut : {1u, 7u, 33u, 1000u}) {
    const Read pieces = read(text, true, cut);
    ASSERT_EQ(pieces.epochs.size(), whole.epochs.size()) << cut;
    EXPECT_EQ(pieces.epochs[0], whole.epochs[0]) << cut;
  }
}

TEST(HitStream, RowsThatComeAsLateAsTheyMayAreNotLostHoweverCut) {
  std::string text;
  int index = 0;
  const auto add = [&](int first_toa, int last_toa) {
    for (int toa = first_toa; toa <= last_toa; toa += 4000)
      text += std::to_string(index++) + " 777 " + std::to_string(toa) + " 80 0 0\n";
  };
  add(2000, 38000);
  add(58000, 58000);
  add(22000, 38000);  // just believed, and taken for one fault less
  add(46000, 66000);
  add(40000, 40000);
  add(74000, 300000);
  for (const std::size_t cut : {text.size(), std::size_t{113}, std::size_t{1}}) {
    const Read result = read(text, false, cut);
    EXPECT_EQ(result.counts.faults.total(), 0) << cut;
    EXPECT_EQ(result.epochs[0].size(), static_cast<std::size_t>(index)) << cut;
  }
}

TEST(HitStream, MutatedTextNeverThrowsAndOrderHolds) {
  Random random(9);
  const std::string right = t3pa_text(random_clusters(random, 200, 50.0)) + "# alive 900000\n1 116 0 0 0 1\n";
  for (int trial = 0; trial < 300; ++trial) {
    std::string text = right;
    for (int k = 0; k < 1 + trial % 40; ++k) {
      const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(text.size())));
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random() & 0xff);
          break;
        case 1:
          text.erase(at, random() % 20);
          break;
        default:
          text.insert(at, std::to_string(random() % 1'000'000'000'000));
          break;
      }
    }
    const Read result = read(text, trial % 2 == 0, 1 + random() % 5000);
    for (const auto& epoch : result.epochs) {
      EXPECT_TRUE(std::is_sorted(epoch.begin(), epoch.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; }))
          << "trial " << trial;
    }
  }
}

}  // namespace
}  // namespace comptonaut
