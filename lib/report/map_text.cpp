// SPDX-License-Identifier: BSD-3-Clause
#include "report/map_text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "report/map_history.h"

namespace comptonaut {
namespace {

constexpr int kLastLetter = static_cast<int>(std::string_view(kLetters).size()) - 1;

char letter_of(std::uint8_t level, const LevelScale& scale) {
  if (level == kNoCell) return '-';
  const int above = std::clamp(level - (scale.top - scale.levels), 0, scale.levels);
  return kLetters[(above * kLastLetter + scale.levels / 2) / scale.levels];
}

}  // namespace

double level_lambda_Bq(int level) { return std::pow(10.0, static_cast<double>(level - 1) / kLevelsPerDecade); }

std::string lambda_text(std::span<const std::uint8_t> levels, const LevelScale& scale) {
  std::string text;
  for (std::size_t i = 0; i < levels.size();) {
    const char letter = letter_of(levels[i], scale);
    std::size_t end = i + 1;
    while (end < levels.size() && letter_of(levels[end], scale) == letter) ++end;
    text += letter;
    if (end - i > 1) text += std::to_string(end - i);
    i = end;
  }
  return text;
}

std::string run_lengths(const std::vector<bool>& values) {
  std::string text;
  bool current = false;
  std::size_t run = 0;
  for (const bool value : values) {
    if (value != current) {
      text += std::to_string(run) + ",";
      run = 0;
      current = value;
    }
    ++run;
  }
  return text + std::to_string(run);
}

std::string base64(std::span<const float> values) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes(values.size_bytes());
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t b = 0; b < 3; ++b) word = word << 8 | (b < n ? bytes[i + b] : 0u);
    for (std::size_t d = 0; d < 4; ++d) text += d <= n ? kDigits[word >> (18 - 6 * d) & 63] : '=';
  }
  return text;
}

}  // namespace comptonaut
