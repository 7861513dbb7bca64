// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/batch_key.h"
#include "detector/event_batch.h"
#include "detector/events.h"
#include "detector/hit_stream.h"
#include "detector/hot_pixels.h"
#include "detector/lost_hits.h"
#include "detector/rate_loss.h"
#include "nodes/arrival_fit.h"
#include "nodes/detector_reader_config.h"
#include "nodes/saturation.h"
#include "nodes/status.h"

namespace comptonaut {

/// Where a stream comes from: tells UTC and life where the stream itself does not.
struct StreamOrigin {
  bool recording = false;            ///< a whole file: alive from its start to its end
  std::optional<Utime> start_utime;  ///< of chip time 0, from a recording's side file
  HitFormat format = HitFormat::kT3pa;
};

/// Makes a detector's hits, as .t3pa text (or another HitFormat) in any pieces, into batches of events of 50 ms,
/// aligned to UTC, complete.
///
/// UTC of chip time 0 is what the stream says ("# start_utime_us"), else what its origin says, else what ArrivalFit
/// makes of the times at which rows arrive, followed by half a per cent at most. An epoch within a stream that says
/// nothing goes on where the one before ended. Rows before any of these are counted and left out.
/// A batch leaves once chip time has passed its end by the time within which rows may be out of order (3.0 ms). Its
/// live time is that in which the detector showed life and lost nothing, times the share of photons that are seen at
/// that rate (rate_loss) and of the pixels that are not masked; hits of hot pixels (HotPixels) are left out of events,
/// not of the rate. A silence leaves batches without live time behind it, a long one only the first. No LCM, no
/// threads, no clock of its own: replaying the same inputs gives the same outputs. Of a stream that tells its own time
/// (start and alive lines) and of a recording the inputs are the bytes alone, however cut and whenever they come; else
/// also the arrival times and silences, which the caller takes from its clocks.
class DetectorReader {
 public:
  /// `first_key` names the mission, the MAV and this process; batches are numbered from first_key.number on.
  DetectorReader(const DetectorReaderConfig& config, Calibration calibration, const BatchKey& first_key);

  /// A stream begins. Not needed for one that tells its start itself.
  void on_open(const StreamOrigin& origin);
  /// `arrival_utime`: now, on the clock that tells UTC.
  [[nodiscard]] std::vector<EventBatch> on_bytes(std::span<const char> bytes,
                                                 std::optional<Utime> arrival_utime = std::nullopt);
  /// The source is there, but nothing has come from it for so long on a monotonic clock: see HitStream::on_silence.
  [[nodiscard]] std::vector<EventBatch> on_silence(double silent_ms);
  /// The stream has ended: everything that it held leaves, its last batch with the live time up to its end.
  [[nodiscard]] std::vector<EventBatch> on_end();

  /// End of the newest batch, 0 before the first.
  [[nodiscard]] Utime utime() const { return newest_utime_; }
  [[nodiscard]] HitStreamCounts counts() const;
  [[nodiscard]] std::vector<Counter> counters() const;
  [[nodiscard]] const Saturation& saturation() const { return saturation_; }
  [[nodiscard]] const HotPixels& hot_pixels() const { return hot_pixels_; }

 private:
  /// How chip time becomes UTC.
  struct TimeBase {
    Utime start_utime = 0;  ///< of chip time 0
    std::int32_t sigma_us = 0;
    bool fitted = false;  ///< to arrivals, which go on

    [[nodiscard]] Utime utime(ChipTime t) const;
    [[nodiscard]] ChipTime chip_time(Utime utime) const { return (utime - start_utime) * kChipTimePerUs; }
  };

  std::vector<EventBatch> drain();
  void take(const StreamPart& part);
  [[nodiscard]] std::optional<TimeBase> time_base() const;
  void begin_epoch(const StreamPart& part);
  void end_epoch(const StreamPart& part);
  void find_events(const StreamPart& part);
  void add(const DetectorEvent& event);
  void add_left_out(const Hit& hit);
  [[nodiscard]] double masked_share() const;
  [[nodiscard]] bool follow_arrivals();
  void open_batch(Utime utime, ChipTime from);
  void close_batches_before(ChipTime t);
  void close_batch();

  DetectorReaderConfig config_;
  EventFinder finder_;
  HotPixels hot_pixels_;
  StreamOrigin origin_;
  HitStream stream_;
  HitStreamCounts counts_;  ///< of streams that have ended

  std::optional<Utime> arrival_utime_;  ///< of the bytes that are being taken
  ArrivalFit arrivals_;                 ///< of the current epoch
  std::optional<TimeBase> base_;        ///< of the current epoch
  std::optional<Utime> epoch_end_;      ///< of the epoch before, in this stream
  EventBatch batch_;                    ///< the one that is being filled, while there is a time base
  ChipTime batch_from_ = 0;
  ChipTime batch_to_ = 0;
  std::vector<EventBatch> ready_;

  Saturation saturation_;
  RateTotals batch_totals_;
  LostHits lost_hits_;
  BatchKey next_key_;
  Utime newest_utime_ = 0;
  std::int64_t hits_without_time_ = 0;
  std::int64_t singles_ = 0;
  std::int64_t pairs_ = 0;
  std::int64_t others_ = 0;
  std::int64_t live_us_ = 0;
  std::int64_t dead_us_ = 0;
  std::int64_t clock_steps_ = 0;
};

}  // namespace comptonaut
