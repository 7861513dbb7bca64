// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace comptonaut {

/// A map as short text for the page. Private to lib/report.

/// Letters for levels of lambda: 'a' at or below the bottom of the scale, then up to 'Z' at its top.
inline constexpr char kLetters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// Which of lambda_level()'s levels the letters cover: `levels` of them up to `top`.
struct LevelScale {
  int top = 1;
  int levels = 1;
};

/// The lambda of a level, Bq; the inverse of lambda_level() at a level's middle.
[[nodiscard]] double level_lambda_Bq(int level);

/// One letter per cell, '-' where there is none; a letter that repeats is followed by how often it stands: "aab12-3".
[[nodiscard]] std::string lambda_text(std::span<const std::uint8_t> levels, const LevelScale& scale);

/// Lengths of the runs of equal values, the first run being of false: "12,3,40".
[[nodiscard]] std::string run_lengths(const std::vector<bool>& values);

/// The bytes of the floats.
[[nodiscard]] std::string base64(std::span<const float> values);

}  // namespace comptonaut
