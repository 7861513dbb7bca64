// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "core/time.h"

namespace comptonaut {

/// What time it is for the team, told by the batches that come: the median of the senders' clocks, so that one wrong
/// clock neither drives the team nor stops it. No clock of its own: where nobody sends, time stands still.
///
/// A sender's clock reads the end of its newest batch and runs on while others send, by progress_us(). Who has sent
/// nothing for silence_us of that has no vote, nor has a clock that is so far behind the last tick: what is late or
/// wrong in the past is folded at once and must not hold the others up. Of an even number of clocks the earlier of the
/// two in the middle counts, so of two the earlier one: ticks that ran ahead could not come back. If no clock has a
/// vote, time runs on from the last tick by progress_us().
class TeamClock {
 public:
  explicit TeamClock(Utime silence_us) : silence_us_(silence_us) {}

  /// The newest batch of `sender` came; a second one of the same end is its continuation.
  void on_newest(std::int32_t sender, Utime end_utime, Utime duration_us);
  void on_tick(Utime tick);

  /// nullopt before the first batch.
  [[nodiscard]] std::optional<Utime> now() const { return now_; }
  /// How far a sender's clock is ahead of now(), negative where it is behind; 0 for one that was never heard.
  [[nodiscard]] Utime ahead_us(std::int32_t sender) const;
  /// Data time that the busiest sender has sent, whatever its clock says.
  [[nodiscard]] Utime progress_us() const { return progress_us_; }

 private:
  struct Sender {
    Utime end_utime = 0;  ///< of its newest batch
    Utime sent_us = 0;    ///< never further behind progress_us than silence_us
    Utime heard_at = 0;   ///< in progress_us
  };

  [[nodiscard]] bool is_silent(const Sender& s) const { return progress_us_ - s.heard_at >= silence_us_; }
  [[nodiscard]] Utime reading(const Sender& s) const { return s.end_utime + progress_us_ - s.heard_at; }
  [[nodiscard]] Utime told_time() const;

  Utime silence_us_;
  std::map<std::int32_t, Sender> senders_;
  Utime progress_us_ = 0;
  std::optional<Utime> last_tick_;
  Utime at_tick_ = 0;  ///< now_ when it ticked last
  Utime progress_at_tick_us_ = 0;
  std::optional<Utime> now_;
};

}  // namespace comptonaut
