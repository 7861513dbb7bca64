// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "detector/hit.h"

namespace comptonaut {

/// The largest ToT that is a measurement: the counter stops there.
inline constexpr std::uint16_t kSaturatedTot = 1022;

/// Energy calibration of one pixel: ToT = a E + b - c / (E - t), E in keV                   [Jakubek 2011].
struct PixelCalibration {
  double a = 0.0;  ///< ticks per keV
  double b = 0.0;  ///< ticks
  double c = 0.0;  ///< ticks keV
  double t = 0.0;  ///< keV
};

/// One of the four matrices: 256 lines of 256 numbers each, line y, column x, in the order of the matrix index. Throws
/// std::runtime_error that names `file` and the line where one is wrong.
[[nodiscard]] std::vector<double> read_calibration_matrix(std::istream& in, const std::string& file);

/// Energy calibration of one chip. Immutable. A pixel whose formula has no positive energy for some ToT from 1 to
/// 1022 is masked: it gives no energies and, read backwards, never fires.
class Calibration {
 public:
  static constexpr std::size_t kPixels = std::size_t{kChipPixels} * kChipPixels;

  /// From 65,536 pixels in the order of the matrix index. Throws std::invalid_argument on another number.
  explicit Calibration(std::vector<PixelCalibration> pixels);

  /// From a folder with the matrices a.txt, b.txt, c.txt and t.txt. Throws std::runtime_error that names the file, and
  /// the line where one is wrong; also where every pixel is masked.
  static Calibration load(const std::filesystem::path& folder);

  /// The same for each pixel; the defaults are the typical pixel of a real 2 mm CdTe chip.
  static Calibration uniform(const PixelCalibration& pixel = {.a = 1.15, .b = 7.1, .c = 2.0, .t = 3.95});

  /// nullopt where the pixel is masked or tot is 0.
  [[nodiscard]] std::optional<double> energy_keV(std::uint16_t pixel, std::uint16_t tot) const;

  /// Of each hit: the energy that it was given, else energy_keV of its pixel and ToT; 0 where there is none.
  void energies_keV(std::span<const Hit> hits, std::span<double> energies_keV) const;

  /// What the pixel reads for a deposit, rounded, at most kSaturatedTot; 0 where it would not fire: below t or masked.
  [[nodiscard]] std::uint16_t tot(std::uint16_t pixel, double energy_keV) const;

  [[nodiscard]] bool masked(std::uint16_t pixel) const { return masked_[pixel]; }
  [[nodiscard]] int masked_pixels() const { return masked_pixels_; }

 private:
  /// The formula turned round, of a pixel that is not masked; of a masked one it gives 0. In single precision, so that
  /// a chip's fits the nearer caches and four hits go at once: that costs 2e-4 ticks at most.
  struct alignas(16) Inverse {
    float b_minus_at = 0.0F;                                 ///< ticks
    float b_plus_at = 0.0F;                                  ///< ticks
    float ac4 = 0.0F;                                        ///< ticks^2
    float half_per_a = 0.0F;                                 ///< keV per tick
    [[nodiscard]] inline float energy_keV(float tot) const;  ///< 0: none
  };
  inline void four_energies_keV(const Hit* hits, double* energies_keV) const;

  std::vector<PixelCalibration> pixels_;
  std::vector<Inverse> inverse_;
  std::vector<bool> masked_;
  int masked_pixels_ = 0;
};

}  // namespace comptonaut
