// SPDX-License-Identifier: BSD-3-Clause
// Real recordings, where they are at hand. They hold no pairs of 662 keV: those are tested on made hits.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "detector/events.h"
#include "detector/hit_stream.h"

namespace comptonaut {
namespace {

const std::filesystem::path kData = std::filesystem::path(COMPTONAUT_SHARED_DATA) / "tpx3";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Recording {
  std::vector<Hit> hits;
  HitStreamCounts counts;
  double live_s = 0.0;
};

Recording read(const std::string& name, ChipTime quiet) {
  Recording recording;
  const std::string text = text_of(kData / name);
  HitStream stream({}, quiet, true);
  stream.feed(text);
  const auto drain = [&] {
    while (const auto part = stream.next()) {
      recording.hits.insert(recording.hits.end(), part->hits.begin(), part->hits.end());
      if (part->ends_epoch)
        recording.live_s += 1e-9 * kChipTime_ns * static_cast<double>(stream.life().live(0, part->until));
    }
  };
  drain();
  stream.end();
  drain();
  recording.counts = stream.counts();
  return recording;
}

/// Pairs of neighbouring hits that are one fault apart, within a few rows of each other.
int torn_pairs(const std::vector<Hit>& hits) {
  int torn = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    for (std::size_t j = i > 20 ? i - 20 : 0; j < i; ++j) {
      const bool apart = std::abs(std::abs(hits[i].t - hits[j].t) - kEpochFault) <= 128;
      torn += apart && std::abs(pixel_x(hits[i].pixel) - pixel_x(hits[j].pixel)) <= 1 &&
              std::abs(pixel_y(hits[i].pixel) - pixel_y(hits[j].pixel)) <= 1;
    }
  }
  return torn;
}

#define SKIP_WITHOUT_RECORDINGS() \
  if (!std::filesystem::exists(kData)) GTEST_SKIP() << "no recordings at " << kData << " (COMPTONAUT_SHARED_DATA)"

TEST(Recording, AmericiumHasItsClustersLineAndFluorescence) {
  SKIP_WITHOUT_RECORDINGS();
  EventFinder finder(EventRules{}, Calibration::load(kData / "calibration-K08-W0060"));
  const Recording am = read("241Am_gamma_60sec.t3pa", finder.quiet());
  EXPECT_EQ(am.counts.rows, 98161);
  EXPECT_EQ(am.counts.faults.total(), 0);
  EXPECT_NEAR(am.live_s, 59.5, 0.1);

  const auto events = finder.find(am.hits);
  EXPECT_NEAR(static_cast<double>(finder.clusters().size()), 41000.0, 300.0);
  std::int64_t coincident = 0;
  for (const DetectorEvent& event : events) coincident += event.clusters > 1 ? event.clusters : 0;
  EXPECT_NEAR(static_cast<double>(coincident) / static_cast<double>(finder.clusters().size()), 0.31, 0.01);
  std::vector<int> spectrum(100);
  for (const DetectorEvent& event : events) {
    if (event.energy_keV < 100.0) ++spectrum[static_cast<std::size_t>(event.energy_keV)];
  }
  const auto peak = std::max_element(spectrum.begin() + 30, spectrum.end()) - spectrum.begin();
  EXPECT_NEAR(static_cast<double>(peak), 50.5, 2.5) << "59.5 keV, read with another chip's calibration";
}

TEST(Recording, TheEpochFaultIsGone) {
  SKIP_WITHOUT_RECORDINGS();
  T3paParser parser;
  const std::string text = text_of(kData / "241Am_gamma_60sec.t3pa");
  std::vector<Hit> arrived, repaired;
  EpochRepair repair;
  for (const StreamItem& item : parser.parse(text)) {
    if (item.kind != StreamItem::Kind::kHit) continue;
    arrived.push_back(item.hit());
    const auto settled = repair.add({&arrived.back(), 1});
    repaired.insert(repaired.end(), settled.begin(), settled.end());
  }
  const auto rest = repair.flush();
  repaired.insert(repaired.end(), rest.begin(), rest.end());
  ASSERT_EQ(repaired.size(), arrived.size());
  EXPECT_EQ(torn_pairs(arrived), 421);
  EXPECT_LE(torn_pairs(repaired), 2);

  std::size_t out_of_order = 0;
  for (std::size_t i = 1; i < repaired.size(); ++i) {
    out_of_order += repaired[i].t < repaired[i - 1].t - 960 ? 1 : 0;  // 1.5 us
  }
  EXPECT_LT(out_of_order, repaired.size() / 1000);
}

/// Of all events: whole numbers mixed into one, and the sums of the others.
struct Digest {
  std::uint64_t whole = 0;
  double energy_keV = 0.0, x_px = 0.0, y_px = 0.0, offset_ns = 0.0, cos_beta = 0.0, probability = 0.0;

  void add(const Cluster& cluster) {
    for (const std::int64_t n : {cluster.t, std::int64_t{cluster.tot_sum}, std::int64_t{cluster.size_px},
                                 std::int64_t{cluster.min_pixel}, std::int64_t{cluster.saturated}}) {
      add(n);
    }
    energy_keV += cluster.energy_keV;
    x_px += cluster.x_px;
    y_px += cluster.y_px;
    offset_ns += cluster.offset_ns;
  }
  void add(const DetectorEvent& event) {
    for (const std::int64_t n : {static_cast<std::int64_t>(event.kind), std::int64_t{event.channel},
                                 std::int64_t{event.clusters}, std::int64_t{event.hits}, event.tot_ticks}) {
      add(n);
    }
    add(event.first);
    add(event.second);
    if (!event.hypotheses) return;
    cos_beta += event.hypotheses->a.cos_beta;
    probability += event.hypotheses->a.probability;
  }
  void add(std::int64_t n) { whole = (whole ^ static_cast<std::uint64_t>(n)) * 0x9e3779b97f4a7c15 + (whole >> 29); }
};

// Whoever makes the chain quicker finds here whether it still says the same of every event.
TEST(Recording, EachEventIsWhatItWasWhenTheseNumbersWereWritten) {
  SKIP_WITHOUT_RECORDINGS();
  EventFinder finder(EventRules{}, Calibration::load(kData / "calibration-K08-W0060"));
  const Recording am = read("241Am_gamma_60sec.t3pa", finder.quiet());
  Digest digest;
  for (const DetectorEvent& event : finder.find(am.hits)) digest.add(event);
  EXPECT_EQ(digest.whole, 18077301679567103540u);
  EXPECT_NEAR(digest.energy_keV, 1590569.374412, 1e-3);
  EXPECT_NEAR(digest.x_px, 4592530.764404, 1e-3);
  EXPECT_NEAR(digest.y_px, 4505003.722895, 1e-3);
  EXPECT_NEAR(digest.offset_ns, 133334.688477, 1e-3);
  EXPECT_NEAR(digest.cos_beta, 0.865656012, 1e-6);  // readings of pairs are of single precision
  EXPECT_NEAR(digest.probability, 1.0, 1e-6);
}

TEST(Recording, BackgroundIsAboutThreeClustersASecond) {
  SKIP_WITHOUT_RECORDINGS();
  EventFinder finder(EventRules{}, Calibration::load(kData / "calibration-K08-W0060"));
  const Recording background = read("1_min_bkg.t3pa", finder.quiet());
  (void)finder.find(background.hits);
  EXPECT_NEAR(static_cast<double>(finder.clusters().size()) / background.live_s, 3.0, 0.3);
}

}  // namespace
}  // namespace comptonaut
