// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "detector/hit_format.h"

namespace comptonaut {

/// What reads bytes that others wrote. run() throws std::logic_error where a law of the reader does not hold; bytes
/// that are wrong are no fault of the reader's.
struct FuzzTarget {
  std::string_view name;  ///< also of its folder of first inputs in tests/fuzz/corpus
  void (*run)(std::span<const char>);
};

void fuzz_t3pa(std::span<const char> bytes);
void fuzz_t3p(std::span<const char> bytes);
void fuzz_clog(std::span<const char> bytes);
void fuzz_info(std::span<const char> bytes);
void fuzz_calibration(std::span<const char> bytes);
void fuzz_hit_stream(std::span<const char> bytes);
void fuzz_csv(std::span<const char> bytes);
void fuzz_mavlink(std::span<const char> bytes);
void fuzz_lc02(std::span<const char> bytes);
void fuzz_reader(std::span<const char> bytes);
void fuzz_response(std::span<const char> bytes);
void fuzz_cones(std::span<const char> bytes);
void fuzz_measurements(std::span<const char> bytes);
void fuzz_config(std::span<const char> bytes);
void fuzz_scenario(std::span<const char> bytes);
void fuzz_points(std::span<const char> bytes);
void fuzz_terrain(std::span<const char> bytes);

/// What needs no more than lib/core, the parsers of lib/detector, lib/mavlink and lib/team: quick to build.
inline constexpr FuzzTarget kParserTargets[] = {
    {"t3pa", fuzz_t3pa},
    {"t3p", fuzz_t3p},
    {"clog", fuzz_clog},
    {"info", fuzz_info},
    {"calibration", fuzz_calibration},
    {"hit_stream", fuzz_hit_stream},
    {"csv", fuzz_csv},
    {"mavlink", fuzz_mavlink},
    {"lc02", fuzz_lc02},
};
inline constexpr FuzzTarget kOtherTargets[] = {
    {"reader", fuzz_reader}, {"response", fuzz_response}, {"cones", fuzz_cones},   {"measurements", fuzz_measurements},
    {"config", fuzz_config}, {"scenario", fuzz_scenario}, {"points", fuzz_points}, {"terrain", fuzz_terrain},
};

inline void require_law(bool holds, const char* law) {
  if (!holds) throw std::logic_error(law);
}

/// Takes the first byte off as a choice of the fuzzer's; 0 where there is none.
inline unsigned take_choice(std::span<const char>& bytes) {
  if (bytes.empty()) return 0;
  const auto choice = static_cast<unsigned char>(bytes.front());
  bytes = bytes.subspan(1);
  return choice;
}

/// One of the three.
[[nodiscard]] constexpr HitFormat hit_format_of(unsigned choice) { return static_cast<HitFormat>(choice % 3); }

/// `bytes` in pieces of 1 to 17 and more: each piece in memory of its own that ends where it ends.
template <class Take>
void in_pieces(std::span<const char> bytes, unsigned choice, Take&& take) {
  const std::size_t step = choice % 4 == 0 ? 1 + choice / 4 : 1 + choice * 16;
  for (std::size_t i = 0; i < bytes.size(); i += step) {
    const auto piece = bytes.subspan(i, std::min(step, bytes.size() - i));
    take(std::vector<char>(piece.begin(), piece.end()));
  }
}

}  // namespace comptonaut
