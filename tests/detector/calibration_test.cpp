// SPDX-License-Identifier: BSD-3-Clause
#include "detector/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <vector>

#include "core/random.h"
#include "detector/make_hits.h"
#include "scratch.h"

namespace comptonaut {
namespace {

namespace fs = std::filesystem;

Calibration one_pixel(const PixelCalibration& pixel) { return Calibration::uniform(pixel); }

TEST(Calibration, EnergyOfAToTGivesThatToT) {
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const PixelCalibration pixel{.a = random.uniform(0.5, 2.0),
                                 .b = random.uniform(-5.0, 30.0),
                                 .c = random.uniform(0.1, 200.0),
                                 .t = random.uniform(0.0, 5.0)};
    const Calibration calibration = one_pixel(pixel);
    for (const std::uint16_t tot : {1, 2, 5, 10, 50, 300, 1000}) {
      const auto energy_keV = calibration.energy_keV(9, tot);
      if (!energy_keV) continue;  // a pixel of negative b has energies from some ToT on
      const double E = *energy_keV;
      EXPECT_NEAR(pixel.a * E + pixel.b - pixel.c / (E - pixel.t), tot, 2e-4) << "trial " << trial;
      EXPECT_EQ(calibration.tot(9, E), tot) << "trial " << trial;
    }
    EXPECT_TRUE(calibration.energy_keV(9, 1000).has_value()) << "trial " << trial;
  }
}

TEST(Calibration, EnergiesOfManyHitsAreThoseOfEach) {
  Random random(8);
  std::vector<PixelCalibration> pixels(Calibration::kPixels);
  for (PixelCalibration& pixel : pixels) {
    pixel = {.a = random.uniform(-0.1, 2.0), .b = random.uniform(-30.0, 30.0), .c = 2.0, .t = 4.0};  // some are masked
  }
  const Calibration calibration(pixels);
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<Hit> hits(count);
    for (Hit& hit : hits) {
      hit = {.t = 0,
             .pixel = static_cast<std::uint16_t>(random() % Calibration::kPixels),
             .tot = static_cast<std::uint16_t>(random() % 4 == 0 ? 0 : random() % 1024),
             .energy_keV = random() % 4 == 0 ? static_cast<float>(random.uniform(1.0, 100.0)) : 0.0F};
    }
    std::vector<double> energies_keV(count);
    calibration.energies_keV(hits, energies_keV);
    for (std::size_t i = 0; i < count; ++i) {
      const double own_keV = calibration.energy_keV(hits[i].pixel, hits[i].tot).value_or(0.0);
      ASSERT_EQ(energies_keV[i], hits[i].energy_keV > 0.0F ? double{hits[i].energy_keV} : own_keV) << count << ' ' << i;
    }
  }
}

TEST(Calibration, APixelWithoutASolutionIsMaskedAndNeverFires) {
  for (const PixelCalibration pixel : {PixelCalibration{},
                                       {.a = -1.0, .b = 5.0, .c = 2.0, .t = 4.0},
                                       {.a = 1.0, .b = 5.0, .c = -1e7, .t = 4.0},
                                       {.a = std::nan(""), .b = 5.0, .c = 2.0, .t = 4.0}}) {
    const Calibration calibration = one_pixel(pixel);
    EXPECT_EQ(calibration.masked_pixels(), static_cast<int>(Calibration::kPixels));
    EXPECT_FALSE(calibration.energy_keV(0, 50).has_value());
    EXPECT_EQ(calibration.tot(0, 100.0), 0);
  }
}

TEST(Calibration, ZeroAndNegativeOffsetsAreNoReasonToMask) {
  EXPECT_EQ(one_pixel({.a = 1.15, .b = 0.0, .c = 2.0, .t = 3.9}).masked_pixels(), 0);
  EXPECT_EQ(one_pixel({.a = 1.15, .b = -30.0, .c = 2.0, .t = 3.9}).masked_pixels(), 0);
}

TEST(Calibration, ReadsNothingBelowThresholdAndStopsAtTheCountersEnd) {
  EXPECT_EQ(typical_calibration().tot(0, 3.9), 0);
  EXPECT_EQ(typical_calibration().tot(0, 5000.0), kSaturatedTot);
}

/// A folder with a calibration whose `file` holds `text` instead.
std::string refusal(const std::string& file, const std::string& text) {
  const fs::path folder = scratch_folder();
  std::string row, matrix;
  for (int x = 0; x < kChipPixels; ++x) row += "2.0 ";
  for (int y = 0; y < kChipPixels; ++y) matrix += row + "\r\n";
  for (const char* name : {"a.txt", "b.txt", "c.txt", "t.txt"}) std::ofstream(folder / name) << matrix;
  if (text == "absent") {
    fs::remove(folder / file);
  } else if (!file.empty()) {
    std::ofstream(folder / file) << text;
  }
  try {
    (void)Calibration::load(folder);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Calibration, RefusalsNameFileAndLine) {
  EXPECT_EQ(refusal("", ""), "accepted");
  EXPECT_NE(refusal("b.txt", "absent").find("b.txt: cannot be read"), std::string::npos);
  EXPECT_NE(refusal("t.txt", "1 2 3\n").find("t.txt:1: 3 numbers; must be 256"), std::string::npos);
  EXPECT_NE(refusal("c.txt", "1 2 x\n").find("c.txt:1: must hold numbers only"), std::string::npos);
  EXPECT_NE(refusal("a.txt", "").find("a.txt:0: 0 rows; must be 256"), std::string::npos);
}

}  // namespace
}  // namespace comptonaut
