// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <sstream>

#include "detector/calibration.h"
#include "detector/t3pa.h"
#include "fuzz/check_read.h"
#include "fuzz/targets.h"

namespace comptonaut {
namespace {

void check_pixel(const Calibration& calibration, std::uint16_t pixel) {
  for (const std::uint16_t tot : {0, 1, 2, 30, 500, 1022, 1023}) {
    const auto energy_keV = calibration.energy_keV(pixel, tot);
    require_law(!energy_keV || (*energy_keV > 0.0 && std::isfinite(*energy_keV)), "an energy is positive");
  }
  for (const double energy_keV : {-1.0, 0.0, 3.0, 60.0, 662.0, 1e9}) {
    require_law(calibration.tot(pixel, energy_keV) <= kSaturatedTot, "the counter stops");
  }
}

/// The text so many times over, as a matrix of many equal rows.
void fuzz_matrix(std::span<const char> bytes, unsigned times) {
  std::string text;
  for (unsigned i = 0; i < times && text.size() < 300'000; ++i) text.append(bytes.begin(), bytes.end());
  std::istringstream in(text);
  check_read("file", [&] {
    require_law(read_calibration_matrix(in, "file").size() == Calibration::kPixels, "a whole matrix");
  });
}

/// The bytes from each place on as a pixel's four numbers, whatever they are.
void fuzz_pixels(std::span<const char> bytes) {
  if (bytes.size() < sizeof(PixelCalibration)) return;
  std::vector<PixelCalibration> pixels(Calibration::kPixels);
  const std::size_t places = bytes.size() - sizeof(PixelCalibration) + 1;
  for (std::size_t i = 0; i < std::min(places, pixels.size()); ++i) {
    std::memcpy(&pixels[i], bytes.data() + i, sizeof(PixelCalibration));
  }
  const Calibration calibration(std::move(pixels));
  for (std::uint16_t pixel = 0; pixel < std::min<std::size_t>(places, 1000); ++pixel) check_pixel(calibration, pixel);
}

}  // namespace

void fuzz_info(std::span<const char> bytes) {
  std::istringstream in(std::string(bytes.begin(), bytes.end()));
  check_read("file", [&] {
    const T3paInfo info = read_t3pa_info(in, "file");
    require_law(!info.start_utime || (*info.start_utime >= 0 && *info.start_utime < 4'102'444'800'000'000),
                "a start time is one");
  });
}

void fuzz_calibration(std::span<const char> bytes) {
  const unsigned choice = take_choice(bytes);
  if (choice == 0) return fuzz_pixels(bytes);
  fuzz_matrix(bytes, choice + 1);
}

}  // namespace comptonaut
