// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/time.h"
#include "detector/clog.h"
#include "detector/epoch_repair.h"
#include "detector/hit.h"
#include "detector/hit_format.h"
#include "detector/hit_stream_counts.h"
#include "detector/live_time.h"
#include "detector/t3p.h"
#include "detector/t3pa.h"
#include "detector/time_order.h"

namespace comptonaut {

inline constexpr ChipTime kChipTimePerUs = 640;  ///< units of 25/16 ns in 1 us

struct HitStreamConfig {
  double reorder_us = 500.0;      ///< hits may be so much out of order
  double silence_max_ms = 500.0;  ///< of a live stream: a longer silence is dead time
  double jump_max_s = 10.0;       ///< a longer step in time needs three rows that agree on it
  double delay_max_ms = 100.0;    ///< rows without alive lines come within this, or are late; then such are waited for
                                  ///< as long as they took, for a minute, since some sources hand over blocks
  double quiet_max_ms = 5000.0;   ///< without alive lines: so long may nothing be hit where a detector lives, in a
                                  ///< recording as in a live stream

  bool operator==(const HitStreamConfig&) const = default;
};

/// What of a stream has become certain.
struct StreamPart {
  std::span<const Hit> hits;  ///< ordered by time, repaired; whole stretches between quiet times
  ChipTime until = 0;         ///< no hit before this is still to come
  bool ends_epoch = false;    ///< chip time starts again after this part
};

/// Hit data of any format as they arrive -> hits in order of time. An epoch is a stretch of the stream with one chip
/// time: a header, an Index that is 0 again or a ToA that restarts begins another one. What comes out depends on the
/// data alone, not on how they are cut. Memory stays bounded whatever they hold.
///
///   stream.feed(bytes);
///   while (const auto part = stream.next()) ...
class HitStream {
 public:
  /// Hits farther apart than `quiet` are of different stretches. A recording is alive from its chip time 0 to its end,
  /// but for what is beyond quiet_max_ms of each silence, or beyond jump_max_s where an alive line ends it, or five
  /// minutes within a frame; a live stream as long as rows or alive lines come.
  HitStream(const HitStreamConfig& config, ChipTime quiet, bool recording, HitFormat format = HitFormat::kT3pa);

  /// `bytes` must stay until next() returns nullopt.
  void feed(std::span<const char> bytes);
  /// Nothing has come for so long on a clock, though the source is still there: chip time goes on, the detector lives
  /// for quiet_max_ms, and rows are waited for delay_max_ms (which see) at most; next() then returns what that makes
  /// certain. Only of a live stream that has begun and has no alive lines: one with alive lines tells itself that time
  /// passes.
  void on_silence(double silent_ms);
  /// The stream has ended; next() then returns the rest.
  void end();
  [[nodiscard]] std::optional<StreamPart> next();

  /// Of the epoch that the latest part is of: time of its newest row, UTC of its chip time 0, where the stream tells,
  /// and its life.
  [[nodiscard]] ChipTime newest() const { return newest_; }
  [[nodiscard]] std::optional<Utime> start_utime() const { return start_utime_; }
  [[nodiscard]] const LiveTime& life() const { return life_; }
  void forget_life_before(ChipTime t) { life_.forget_before(t); }

  [[nodiscard]] HitStreamCounts counts() const;

 private:
  [[nodiscard]] bool begins_epoch(const StreamItem& item) const;
  void begin_epoch();
  [[nodiscard]] StreamPart end_epoch();
  [[nodiscard]] StreamPart release();
  void parse();
  [[nodiscard]] bool take_items();
  void take_run();
  void take(const StreamItem& item);
  void take_timed(const StreamItem& item);
  void take_lost(const StreamItem& item);
  void accept(const StreamItem& item);
  void doubt_silence(const StreamItem& item);
  void suspect(const StreamItem& item);
  void refuse_suspects();
  [[nodiscard]] bool restarts(const StreamItem& item) const;
  [[nodiscard]] bool follows(const StreamItem& item, ChipTime newest) const;
  void flush_run();
  void order(std::span<const Hit> hits);
  [[nodiscard]] double delay_ms() const;

  ChipTime quiet_;
  ChipTime reorder_;
  ChipTime jump_max_;
  ChipTime silence_max_;
  ChipTime quiet_max_;
  double delay_max_ms_;
  double quiet_max_ms_;
  bool recording_;

  std::variant<T3paParser, T3pParser, ClogParser> parser_;
  std::span<const char> bytes_;
  std::span<const StreamItem> items_;
  std::size_t at_ = 0;
  bool ending_ = false;
  bool silent_ = false;      ///< on_silence() has made something certain
  bool tells_time_ = false;  ///< there have been alive lines

  // Of the current epoch.
  bool epoch_over_ = false;
  bool has_data_ = false;
  ChipTime newest_ = 0;
  ChipTime passed_ = 0;            ///< chip time as a clock tells
  double silent_ms_ = 0.0;         ///< the latest silence
  double learned_delay_ms_ = 0.0;  ///< up to learned_until_: rows have come so late
  ChipTime learned_until_ = 0;
  std::uint32_t last_index_ = 0;
  std::optional<Utime> start_utime_;
  std::optional<ChipTime> lost_from_;
  ChipTime frame_to_ = 0;             ///< end of the latest frame of a shutter; 0: there are none
  std::vector<StreamItem> suspects_;  ///< rows that jump in time, until others agree or do not
  std::vector<Hit> run_;              ///< hits on their way to repair
  EpochRepair repair_;
  TimeOrder order_;
  LiveTime life_;

  HitStreamCounts counts_;
};

}  // namespace comptonaut
