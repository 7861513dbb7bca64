// SPDX-License-Identifier: BSD-3-Clause
#include "sim/arrivals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sim/emitters.h"

namespace comptonaut {
namespace {

struct Row {
  ChipTime t = 0;
  int pixel = 0;
  int overflow = 0;
};

struct Stream {
  std::vector<Row> rows;
  std::vector<std::string> comments;
};

Stream parsed(const std::string& text) {
  Stream result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) {
      result.comments.push_back(line);
      continue;
    }
    std::istringstream fields(line);
    std::int64_t index = 0, toa = 0, tot = 0, ftoa = 0;
    Row row;
    if (fields >> index >> row.pixel >> toa >> tot >> ftoa >> row.overflow) {
      row.t = 16 * toa - ftoa;
      result.rows.push_back(row);
    }
  }
  return result;
}

/// `n` hits, one every 200 ns, sent in 10 pieces.
std::string sent(const Traps& traps, int n) {
  Arrivals arrivals(traps, 1, 1);
  std::string text = arrivals.start(5);
  for (int i = 0; i < n; ++i) {
    const Hit hit{.t = 128 * i, .pixel = static_cast<std::uint16_t>(i), .tot = 10};
    arrivals.add({&hit, 1});
    if ((i + 1) % (n / 10) == 0) text += arrivals.send(128 * (i + 1));
  }
  return text;
}

TEST(Arrivals, EveryHitComesOnceWithItsTimeAndPixel) {
  const Stream stream = parsed(sent({}, 50'000));
  ASSERT_EQ(stream.rows.size(), 50'000u);
  std::vector<Row> rows = stream.rows;
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.t < b.t; });
  for (int i = 0; i < 50'000; ++i) {
    ASSERT_EQ(rows[i].t, 128 * i);
    ASSERT_EQ(rows[i].pixel, i);
  }
  EXPECT_EQ(stream.comments.front(), "# start_utime_us 5");
  EXPECT_EQ(stream.comments.back(), "# alive 400000");
}

TEST(Arrivals, RowsAreAboutAsDisorderedAsInRealFiles) {
  const Stream stream = parsed(sent({}, 50'000));
  ChipTime latest = 0;
  int late = 0, disordered = 0;
  for (const Row& row : stream.rows) {
    latest = std::max(latest, row.t);
    late += latest - row.t > 960;  // 1.5 us
    disordered += latest > row.t;
  }
  EXPECT_LT(late, 60);
  EXPECT_GT(late, 0);
  EXPECT_GT(disordered, 5000);
}

TEST(Arrivals, NoHitOfAPieceComesAfterItsAliveLine) {
  std::istringstream lines(sent({}, 1000));
  ChipTime alive = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# alive ")) alive = 16 * std::stoll(line.substr(8));
    const Stream row = parsed(line);
    if (!row.rows.empty()) {
      EXPECT_GE(row.rows[0].t, alive);
    }
  }
}

TEST(Arrivals, EpochFaultsAreExactlyOneEpochLate) {
  const Stream stream = parsed(sent({.epoch_fault_share = 0.03}, 10'000));
  int faults = 0;
  for (const Row& row : stream.rows) faults += row.t == 128 * row.pixel + 16'384 * 16;
  EXPECT_NEAR(faults, 300, 60);
}

TEST(Arrivals, AnnouncedGapsHoldNoHits) {
  const Stream whole = parsed(sent({}, 50'000));
  const Stream gappy = parsed(sent({.lost_data_per_s = 300.0, .lost_data_s = 0.0005}, 50'000));
  const auto gaps = std::count_if(gappy.rows.begin(), gappy.rows.end(),
                                  [](const Row& row) { return row.pixel == 0x75 && row.overflow; });
  ASSERT_GT(gaps, 0);
  const std::size_t hits = gappy.rows.size() - 2 * static_cast<std::size_t>(gaps);
  EXPECT_EQ(hits, whole.rows.size() - 2500 * static_cast<std::size_t>(gaps)) << gaps << " gaps";
}

TEST(Arrivals, RepeatedPixelsAndHotPixelsAddRows) {
  EXPECT_NEAR(static_cast<double>(parsed(sent({.repeated_pixel_share = 0.1}, 10'000)).rows.size()), 11'000, 150);
  // 2 ms with 3 pixels of 1e5 hits a second.
  EXPECT_NEAR(static_cast<double>(parsed(sent({.hot_pixels = 3, .hot_pixel_hits_per_s = 1e5}, 10'000)).rows.size()),
              10'600, 100);
}

TEST(Emitters, ASourceSendsOutTheLinesOfItsNuclide) {
  const std::vector<TrueSource> sources = {{"Co-60", {1, 2, 0}, 1e9}, {"Cs-137", {3, 4, 0}, 2e9}};
  const Lines lines = {{"Cs-137", {{661.657, 0.85}}}, {"Co-60", {{1173.228, 0.9985}, {1332.492, 0.9998}}}};
  const std::vector<Emitter> points = emitters(sources, {}, "Cs-137", lines);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].p_W, sources[0].p_W);
  EXPECT_EQ(points[1].energy_keV, 1332.492);
  EXPECT_EQ(points[1].photons_per_s, 0.9998 * 1e9);
  EXPECT_EQ(points[2].energy_keV, 661.657);
  EXPECT_THROW((void)emitters(sources, {}, "Cs-137", {}), std::out_of_range);
}

TEST(Emitters, APatchIsAnEvenDiscOfItsWholeActivity) {
  const Patch patch{.x_m = 10, .y_m = 20, .radius_m = 5, .activity_Bq = 4e9};
  const std::vector<Emitter> points = emitters({}, patch, "Cs-137", {{"Cs-137", {{661.657, 0.85}}}});
  double photons_per_s = 0.0, inner_per_s = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Emitter& point : points) {
    const double r_m = (point.p_W - Eigen::Vector3d(10, 20, 0)).norm();
    EXPECT_LE(r_m, 5.0);
    photons_per_s += point.photons_per_s;
    if (r_m < 5.0 / std::sqrt(2.0)) inner_per_s += point.photons_per_s;
    centre += point.p_W / points.size();
  }
  EXPECT_NEAR(photons_per_s, 0.85 * 4e9, 1.0);
  EXPECT_NEAR(inner_per_s / photons_per_s, 0.5, 0.01);
  EXPECT_LT((centre - Eigen::Vector3d(10, 20, 0)).norm(), 0.05);
}

}  // namespace
}  // namespace comptonaut
