// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "detector/hit_format.h"
#include "fuzz/targets.h"
#include "nodes/detector_reader.h"

namespace comptonaut {
namespace {

bool is_cone(const ConeHypothesis& cone) {
  return std::abs(cone.axis_D.norm() - 1.0) < 1e-9 && std::abs(cone.cos_beta) <= 1.0 && cone.probability >= 0.0;
}

}  // namespace

/// Batches are 50 ms each, in order, and live no longer than they last, whatever comes and however the time passes.
void fuzz_reader(std::span<const char> bytes) {
  const unsigned choice = take_choice(bytes), cut = take_choice(bytes);
  static const DetectorReaderConfig kConfig;
  static const Calibration kTypical = Calibration::uniform();
  DetectorReader reader(kConfig, kTypical, {.mission = 1, .sender = 1, .boot_epoch = 1, .number = 0});
  if (choice & 0x80)
    reader.on_open(
        {.recording = bool(choice & 0x40), .start_utime = 1'700'000'000'000'000, .format = hit_format_of(choice)});
  Utime arrival = 1'700'000'000'000'000;
  std::int64_t number = 0;
  const auto take = [&](const std::vector<EventBatch>& batches) {
    for (const EventBatch& batch : batches) {
      require_law(batch.key.number == number++, "batches are numbered without a gap");
      require_law(batch.duration_us == kBatch_us && batch.utime % kBatch_us == 0, "batches are of 50 ms of UTC");
      require_law(batch.live_us >= 0 && batch.live_us <= batch.duration_us, "a batch lives no longer than it lasts");
      require_law(batch.channels.size() == 1 && batch.channels[0].singles >= 0, "a batch has its channels");
      require_law(std::ssize(batch.pairs) == batch.channels[0].pairs, "each pair that is counted is there");
      for (const PairEvent& pair : batch.pairs) {
        require_law(is_cone(pair.a) && is_cone(pair.b), "cones are cones");
        require_law(std::abs(pair.a.probability + pair.b.probability - 1.0) < 1e-9, "one of them is true");
      }
    }
  };
  in_pieces(bytes, cut, [&](const std::vector<char>& piece) {
    arrival += 10'000;
    take(choice & 0x20 ? reader.on_bytes(piece, arrival) : reader.on_bytes(piece));
    if (choice & 0x10) take(reader.on_silence(10.0 * (piece.back() & 0x7f)));
  });
  take(reader.on_end());
  (void)reader.counters();
}

}  // namespace comptonaut
