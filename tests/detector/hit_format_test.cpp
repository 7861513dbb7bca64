// SPDX-License-Identifier: BSD-3-Clause
// The same hits in every format.
#include "detector/hit_format.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "detector/events.h"
#include "detector/hit_stream.h"
#include "detector/make_hits.h"
#include "scratch.h"

namespace comptonaut {
namespace {

std::vector<Hit> read(const std::string& data, HitFormat format, ChipTime quiet) {
  HitStream stream({}, quiet, true, format);
  std::vector<Hit> hits;
  const auto drain = [&] {
    while (const auto part = stream.next()) hits.insert(hits.end(), part->hits.begin(), part->hits.end());
  };
  stream.feed(data);
  drain();
  stream.end();
  drain();
  EXPECT_EQ(stream.counts().faults.total(), 0);
  EXPECT_EQ(stream.counts().epochs, 1);
  return hits;
}

/// Deposits of one to four pixels, in order of time, a few of them one epoch late.
std::vector<Hit> some_hits() {
  Random random(31);
  std::vector<Hit> hits;
  double t_ns = 1e6;
  for (int i = 0; i < 3000; ++i) {
    t_ns += 20e3 * random.exponential();
    const int x = static_cast<int>(random.uniform(0.0, 254.0)), y = static_cast<int>(random.uniform(0.0, 254.0));
    const double late_ns = random.uniform() < 0.02 ? kChipTime_ns * static_cast<double>(kEpochFault) : 0.0;
    for (int k = 0; k < 1 + i % 4; ++k) {
      hits.push_back(make_hit(x + k % 2, y + k / 2, random.uniform(6.0, 200.0), t_ns + late_ns + 5.0 * k));
    }
  }
  return hits;
}

TEST(HitFormat, EveryFormatGivesTheSameHits) {
  const auto hits = some_hits();
  const auto text = read(t3pa_text(hits), HitFormat::kT3pa, 150);
  ASSERT_EQ(text.size(), hits.size());
  EXPECT_EQ(read(t3p_data(hits), HitFormat::kT3p, 150), text);

  const auto clusters = read(clog_text(hits), HitFormat::kClog, 150);
  ASSERT_EQ(clusters.size(), text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    EXPECT_EQ(clusters[i].t, text[i].t) << i;
    EXPECT_EQ(clusters[i].pixel, text[i].pixel) << i;
    EXPECT_NEAR(clusters[i].energy_keV, *typical_calibration().energy_keV(text[i].pixel, text[i].tot), 2e-5) << i;
  }
}

TEST(HitFormat, EnergiesThatAreGivenNeedNoCalibration) {
  const auto hits = some_hits();
  EventFinder finder(EventRules{}, Calibration::uniform());
  EventFinder without(EventRules{}, Calibration(std::vector<PixelCalibration>(Calibration::kPixels)));
  const auto text = read(t3pa_text(hits), HitFormat::kT3pa, finder.quiet());
  const auto given = read(clog_text(hits), HitFormat::kClog, finder.quiet());
  const auto expected = finder.find(text);
  const auto events = without.find(given);
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].kind, expected[i].kind) << i;
    EXPECT_NEAR(events[i].energy_keV, expected[i].energy_keV, 1e-4) << i;
  }
}

TEST(HitFormat, TheNameTellsElseTheBeginning) {
  EXPECT_EQ(hit_format("a.t3pa"), HitFormat::kT3pa);
  EXPECT_EQ(hit_format("/b/a.T3P"), HitFormat::kT3p);
  EXPECT_EQ(hit_format("a.t3pa.clog"), HitFormat::kClog);
  EXPECT_EQ(hit_format("a.txt", kT3paHeader), HitFormat::kT3pa);
  EXPECT_EQ(hit_format("pipe", std::string("\xEF\xBB\xBF"
                                           "Frame 1 (0, 0 s)")),
            HitFormat::kClog);
  EXPECT_EQ(hit_format("a.dat", t3p_record(5, 100, 0, 3, 9)), HitFormat::kT3p);
  EXPECT_EQ(hit_format("a.t3p", std::string("Frame")), HitFormat::kT3p) << "the name goes first";
  EXPECT_EQ(hit_format(""), HitFormat::kT3pa);
  EXPECT_EQ(hit_format_of(scratch_file("clusters", "Frame 1 (0, 0 s)\n")), HitFormat::kClog);
}

}  // namespace
}  // namespace comptonaut
