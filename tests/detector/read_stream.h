// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "detector/hit_stream.h"

namespace comptonaut {

inline constexpr ChipTime kQuiet = 150;
inline constexpr ChipTime kMicrosecond = kChipTimePerUs;
inline constexpr ChipTime kSecond = 1'000'000 * kChipTimePerUs;

/// What a stream held, epoch by epoch.
struct Read {
  std::vector<std::vector<Hit>> epochs = {{}};
  double live_s = 0.0;
  HitStreamCounts counts;
};

inline Read read(const std::string& text, bool recording = true, std::size_t cut = 1 << 20) {
  Read result;
  HitStream stream({}, kQuiet, recording);
  const auto drain = [&] {
    while (const auto part = stream.next()) {
      result.epochs.back().insert(result.epochs.back().end(), part->hits.begin(), part->hits.end());
      if (!part->ends_epoch) continue;
      result.live_s += static_cast<double>(stream.life().live(0, part->until)) / kSecond;
      result.epochs.emplace_back();
    }
  };
  for (std::size_t at = 0; at < text.size(); at += cut) {
    stream.feed(std::span(text).subspan(at, std::min(cut, text.size() - at)));
    drain();
  }
  stream.end();
  drain();
  result.epochs.pop_back();
  result.counts = stream.counts();
  return result;
}

}  // namespace comptonaut
