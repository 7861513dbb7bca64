// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "detector/hit_stream.h"
#include "detector/hot_pixels.h"
#include "fuzz/targets.h"

namespace comptonaut {
namespace {

constexpr ChipTime kQuiet = 200;

/// Everything that a stream of hits gives.
struct Chain {
  std::vector<Hit> hits;
  std::int64_t left_out = 0;
  HitStreamCounts counts;
};

class ChainRun {
 public:
  ChainRun(bool recording, HitFormat format) : stream_({}, kQuiet, recording, format), hot_pixels_({}) {}

  void feed(std::span<const char> bytes) {
    stream_.feed(bytes);
    drain();
  }
  Chain end() {
    stream_.end();
    drain();
    chain_.counts = stream_.counts();
    return chain_;
  }

 private:
  void drain() {
    while (const auto part = stream_.next()) take(*part);
  }
  void take(const StreamPart& part) {
    for (const Hit& hit : part.hits) {
      require_law(hit.t >= newest_, "hits come in order of time");
      require_law(hit.t < part.until + (part.ends_epoch ? 1 : 0), "a part's hits are before its end");
      newest_ = hit.t;
    }
    chain_.hits.insert(chain_.hits.end(), part.hits.begin(), part.hits.end());
    const auto [kept, left_out] = hot_pixels_.split(part.hits, part.until);
    require_law(kept.size() + left_out.size() == part.hits.size(), "a hit is kept or left out");
    chain_.left_out += std::ssize(left_out);
    newest_ = part.ends_epoch ? std::numeric_limits<ChipTime>::min() : part.until;
    const ChipTime live = stream_.life().live(0, std::max<ChipTime>(part.until, 0));
    require_law(live >= 0 && live <= std::max<ChipTime>(part.until, 0), "life is no longer than time");
  }

  HitStream stream_;
  HotPixels hot_pixels_;
  ChipTime newest_ = std::numeric_limits<ChipTime>::min();
  Chain chain_;
};

}  // namespace

/// Hits depend on the bytes alone, however they are cut, and every row is a hit or counted as something else.
void fuzz_hit_stream(std::span<const char> bytes) {
  const unsigned choice = take_choice(bytes), cut = take_choice(bytes);
  const HitFormat format = hit_format_of(choice);
  const bool recording = choice & 0x40;
  ChainRun at_once(recording, format), in_parts(recording, format);
  at_once.feed(bytes);
  const Chain whole = at_once.end();
  in_pieces(bytes, cut, [&](const std::vector<char>& piece) { in_parts.feed(piece); });
  const Chain parts = in_parts.end();
  require_law(whole.hits == parts.hits, "the same hits however cut");
  require_law(whole.left_out == parts.left_out, "the same hot pixels however cut");
  require_law(whole.counts.faults.count == parts.counts.faults.count, "the same faults however cut");
  const std::int64_t late = whole.counts.faults.of(RowFault::kLate);
  require_law(std::ssize(whole.hits) + late == whole.counts.hits, "accepted hits leave or are late");
}

}  // namespace comptonaut
