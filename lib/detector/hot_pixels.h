// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/hit.h"

namespace comptonaut {

struct HotPixelConfig {
  double window_s = 10.0;      ///< of chip time, over which hits are compared
  double times_around = 10.0;  ///< a hot pixel has so many times the hits of those around it
  int hits_min = 20;           ///< and at least so many

  bool operator==(const HotPixelConfig&) const = default;
};

/// Throws std::invalid_argument that names the value unless window_s is from 0.01 to 3600, times_around at least 2 and
/// hits_min at least 16.
void check(const HotPixelConfig& config);

/// A pixel that is masked, and what it was found by.
struct HotPixel {
  std::uint16_t pixel = 0;
  int hits = 0;         ///< of it within the window
  double around = 0.0;  ///< as many as it was expected to have, by the others

  bool operator==(const HotPixel&) const = default;
};

/// Finds pixels that fire far more often than the others while hits come, leaves their hits out, and takes them back
/// when they are quiet again.
///
/// Hot is a pixel whose hits n within the window are at least hits_min and times_around m, where m is the larger of the
/// median of the pixels within 2 px that are not masked (a source that lights the chip lights those too, and a few hot
/// ones side by side do not hide each other) and the mean of the chip (where hits are rare that median is 0). By chance
/// a pixel like the others gets there less often than exp(-n (ln k - 1 + 1/k)), k = times_around [Chernoff's bound of
/// the Poisson distribution], 7e-13 with the defaults: once in 10^7 windows of a chip. One cluster, however large,
/// gives each of its pixels one hit. A pixel is released once a whole window has less than half of what makes it hot.
/// The window is the half that goes on and the one before it.
///
/// The first hits of a hot pixel pass, at most 7 beyond those that tell. What is decided depends on the hits alone, not
/// on how they are cut; memory is bounded. Where chip time starts again a new half begins, and a pause longer than the
/// window releases all.
class HotPixels {
 public:
  explicit HotPixels(const HotPixelConfig& config);

  struct Split {
    std::span<const Hit> kept;
    std::span<const Hit> left_out;
  };
  /// Hits in order of time, after which no hit before `until` is to come. Valid until the next call.
  [[nodiscard]] Split split(std::span<const Hit> hits, ChipTime until);

  /// In the order in which they were found.
  [[nodiscard]] std::span<const HotPixel> masked() const { return masked_; }
  [[nodiscard]] std::int64_t hits() const { return hits_; }    ///< left out so far
  [[nodiscard]] std::int64_t times() const { return times_; }  ///< that a pixel was masked

 private:
  [[nodiscard]] std::size_t count_kept(std::span<const Hit> hits);
  [[nodiscard]] std::size_t count_kept_of_half(std::span<const Hit> hits);
  [[nodiscard]] bool in_half(ChipTime t) const;
  void pass_to(ChipTime t);
  void end_half();
  void find_hot(std::uint16_t pixel);
  [[nodiscard]] int hits_of(std::size_t pixel) const { return before_[pixel] + now_[pixel]; }
  [[nodiscard]] double chip_mean() const;
  [[nodiscard]] double expected(std::uint16_t pixel) const;

  HotPixelConfig config_;
  ChipTime half_;
  ChipTime from_ = 0;                                        ///< of the half that goes on
  std::vector<std::uint16_t> now_, before_;                  ///< hits of each pixel in it and in the one before
  std::int64_t now_hits_ = 0, before_hits_ = 0;              ///< the same of all pixels that were not masked
  std::bitset<std::size_t{kChipPixels} * kChipPixels> hot_;  ///< the masked ones again
  std::vector<HotPixel> masked_;
  std::vector<Hit> kept_, left_out_;
  std::int64_t hits_ = 0;
  std::int64_t times_ = 0;
};

}  // namespace comptonaut
