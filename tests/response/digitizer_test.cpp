// SPDX-License-Identifier: BSD-3-Clause
#include "response/digitizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "response/electron_range.h"

namespace comptonaut {
namespace {

const DigitizerConfig kNoiseless{.noise_sigma_keV = 0.0, .gain_rel_sigma = 0.0, .jitter_sigma_ns = 0.0};

std::vector<Hit> digitize(const Deposit& deposit, double t_ns = 0.0, const SensorConfig& sensor = {}) {
  Digitizer digitizer(kNoiseless, sensor, Calibration::uniform());
  Random random(1);
  std::vector<Hit> hits;
  digitizer.digitize(std::span(&deposit, 1), t_ns, random, hits);
  return hits;
}

double energy_keV(const std::vector<Hit>& hits) {
  static const Calibration calibration = Calibration::uniform();
  double sum = 0.0;
  for (const Hit& hit : hits) sum += calibration.energy_keV(hit.pixel, hit.tot).value();
  return sum;
}

/// Middle of a pixel, at a height above the pixel plane.
Eigen::Vector3d over_pixel(int x, int y, double height_m) {
  return {pixel_to_D_m(x), pixel_to_D_m(y), -1e-3 + height_m};
}

TEST(Digitizer, PutsASpotIntoThePixelBelowIt) {
  const Deposit spot{.p_D = over_pixel(100, 30, 1e-5), .energy_keV = 60.0};
  const auto hits = digitize(spot);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(pixel_x(hits[0].pixel), 100);
  EXPECT_EQ(pixel_y(hits[0].pixel), 30);
  const SensorConfig mirrored{.mirror_x = true};
  const auto seen = digitize(spot, 0.0, mirrored);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(pixel_x(seen[0].pixel), 155);
  EXPECT_NEAR(pixel_to_D(mirrored, pixel_x(seen[0].pixel), 30).x(), spot.p_D.x(), 1e-12);
}

TEST(Digitizer, GivesBackTheEnergyToHalfATick) {
  for (const double deposit_keV : {6.0, 20.0, 60.0, 120.0, 300.0, 500.0}) {
    const auto hits = digitize({.p_D = over_pixel(100, 30, 1e-5), .energy_keV = deposit_keV});
    EXPECT_NEAR(energy_keV(hits), deposit_keV, 0.5 / 1.15 + 0.003 * deposit_keV)
        << "rounding of ToT, tails of the cloud";
  }
  EXPECT_TRUE(digitize({.p_D = over_pixel(100, 30, 1e-5), .energy_keV = 4.9}).empty()) << "below the threshold";
}

TEST(Digitizer, DriftsForLongerFromHigherUp) {
  const SensorConfig sensor;
  EXPECT_NEAR(max_drift_ns(sensor), 86.0, 0.5);
  for (const double height_m : {0.0, 0.5e-3, 1.0e-3, 1.999e-3}) {
    const auto hits = digitize({.p_D = over_pixel(100, 30, height_m), .energy_keV = 60.0}, 5000.0);
    const auto main = std::max_element(hits.begin(), hits.end(), [](auto& a, auto& b) { return a.tot < b.tot; });
    ASSERT_NE(main, hits.end());
    const double pixel_keV = Calibration::uniform().energy_keV(main->pixel, main->tot).value();
    const double expected_ns = 5000.0 + height_m / 2e-3 * max_drift_ns(sensor) + time_walk_ns(sensor, pixel_keV);
    EXPECT_NEAR(static_cast<double>(main->t) * kChipTime_ns, expected_ns, 0.6 * kChipTime_ns) << height_m << " m";
  }
}

TEST(Digitizer, DelaysWeakHitsByTimeWalk) {
  const auto weak = digitize({.p_D = over_pixel(9, 9, 0.0), .energy_keV = 5.2});
  const auto strong = digitize({.p_D = over_pixel(9, 9, 0.0), .energy_keV = 50.0});
  ASSERT_EQ(weak.size() + strong.size(), 2u);
  const double expected_ns = time_walk_ns({}, 5.2) - time_walk_ns({}, 50.0);
  EXPECT_NEAR(static_cast<double>(weak[0].t - strong[0].t) * kChipTime_ns, expected_ns, kChipTime_ns);
  EXPECT_GT(expected_ns, 5.0);
}

TEST(Digitizer, SharesChargeAtABorderAndByDiffusion) {
  const Eigen::Vector3d border_D = 0.5 * (over_pixel(100, 30, 1e-5) + over_pixel(101, 30, 1e-5));
  const auto halves = digitize({.p_D = border_D, .energy_keV = 80.0});
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_NEAR(halves[0].tot, halves[1].tot, 1);
  const Eigen::Vector3d corner_D = border_D + Eigen::Vector3d(0, 27.5e-6, 1.9e-3);
  EXPECT_EQ(digitize({.p_D = corner_D, .energy_keV = 80.0}).size(), 4u);
}

TEST(Digitizer, MaskedPixelsNeverFire) {
  std::vector<PixelCalibration> pixels(Calibration::kPixels, {.a = 1.15, .b = 7.1, .c = 2.0, .t = 3.95});
  pixels[256 * 30 + 100] = {};
  Digitizer digitizer(kNoiseless, {}, Calibration(pixels));
  Random random(1);
  std::vector<Hit> hits;
  const Deposit deposit{.p_D = over_pixel(100, 30, 1e-5), .energy_keV = 60.0};
  digitizer.digitize(std::span(&deposit, 1), 0.0, random, hits);
  EXPECT_TRUE(hits.empty());
}

TEST(Digitizer, KeepsNothingOfEarlierPhotonsAndOrdersHits) {
  Digitizer digitizer(kNoiseless, {}, Calibration::uniform());
  const std::vector<Deposit> deposits{{.p_D = over_pixel(10, 10, 1.8e-3), .energy_keV = 100.0},
                                      {.p_D = over_pixel(90, 90, 1e-4), .energy_keV = 100.0}};
  Random random(1);
  std::vector<Hit> first, both;
  digitizer.digitize(deposits, 0.0, random, first);
  both = first;
  digitizer.digitize(deposits, 0.0, random, both);
  ASSERT_EQ(both.size(), 2 * first.size()) << "appended";
  EXPECT_TRUE(std::equal(first.begin(), first.end(), both.begin() + static_cast<std::ptrdiff_t>(first.size())));
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end(), [](auto& a, auto& b) { return a.t < b.t; }));
  EXPECT_EQ(pixel_x(first.front().pixel), 90) << "the lower charge arrives first";
}

struct Electrons {
  double mean_keV = 0.0;
  double rel_fwhm = 0.0;
  double extent_um = 0.0;  ///< mean distance of the two farthest pixels
  double pixels = 0.0;     ///< mean
};

double extent_um(const std::vector<Hit>& hits) {
  double longest_px = 0.0;
  for (const Hit& a : hits) {
    for (const Hit& b : hits) {
      const double dx = pixel_x(a.pixel) - pixel_x(b.pixel), dy = pixel_y(a.pixel) - pixel_y(b.pixel);
      longest_px = std::max(longest_px, std::hypot(dx, dy));
    }
  }
  return kPixelPitch_um * longest_px;
}

/// Electrons of one energy somewhere in the middle of the block, in all directions.
Electrons measure_electrons(double electron_keV) {
  constexpr int kElectrons = 2000;
  Digitizer digitizer({}, {}, Calibration::uniform());
  Random random(4);
  Electrons result;
  double sum2 = 0.0;
  for (int i = 0; i < kElectrons; ++i) {
    const Eigen::Vector3d jitter_m = 55e-6 * Eigen::Vector3d(random.uniform(), random.uniform(), 0.0);
    const Deposit deposit{.p_D = over_pixel(128, 128, random.uniform(6e-4, 14e-4)) + jitter_m,
                          .direction_D = random.unit_vector(),
                          .energy_keV = electron_keV};
    std::vector<Hit> hits;
    digitizer.digitize(std::span(&deposit, 1), 0.0, random, hits);
    const double read_keV = energy_keV(hits);
    result.mean_keV += read_keV / kElectrons;
    sum2 += read_keV * read_keV / kElectrons;
    result.extent_um += extent_um(hits) / kElectrons;
    result.pixels += static_cast<double>(hits.size()) / kElectrons;
  }
  result.rel_fwhm = 2.355 * std::sqrt(sum2 - result.mean_keV * result.mean_keV) / result.mean_keV;
  return result;
}

// Tracks of fast electrons are long but crooked; what they leave in the pixels has the detector's resolution.
TEST(Digitizer, MakesClustersOfTheRightExtentAndResolution) {
  const Electrons slow = measure_electrons(100.0), middle = measure_electrons(400.0), fast = measure_electrons(630.0);
  EXPECT_NEAR(middle.mean_keV, 400.0, 0.05 * 400.0) << "charge below the threshold is lost";
  EXPECT_TRUE(middle.extent_um > 150.0 && middle.extent_um < 300.0) << middle.extent_um;
  EXPECT_TRUE(fast.extent_um > 200.0 && fast.extent_um < 400.0) << fast.extent_um;
  EXPECT_NEAR(fast.rel_fwhm, 0.03, 0.005);
  EXPECT_LT(slow.extent_um, middle.extent_um);
  EXPECT_LT(middle.pixels, fast.pixels);
}

TEST(Digitizer, RefusesConfigurationsThatAreNone) {
  DigitizerConfig wrong;
  wrong.noise_sigma_keV = -1.0;
  EXPECT_THROW(Digitizer(wrong, {}, Calibration::uniform()), std::invalid_argument);
  EXPECT_THROW(Digitizer({}, {.thickness_um = 0.0}, Calibration::uniform()), std::invalid_argument);
}

TEST(ElectronRange, IsKanayaAndOkayamasAndInvertible) {
  EXPECT_NEAR(electron_range_um(400.0), 390.0, 10.0);
  for (const double electron_keV : {5.0, 30.0, 100.0, 477.0, 630.0}) {
    EXPECT_NEAR(energy_of_range_keV(electron_range_um(electron_keV)), electron_keV, 1e-9);
  }
  EXPECT_GT(multiple_scattering_rad(100.0, 20.0), multiple_scattering_rad(400.0, 20.0));
  EXPECT_NEAR(multiple_scattering_rad(400.0, 20.0), 0.59, 0.02);
}

}  // namespace
}  // namespace comptonaut
