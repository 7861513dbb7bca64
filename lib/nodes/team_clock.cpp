// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_clock.h"

#include <algorithm>
#include <vector>

namespace comptonaut {

void TeamClock::on_newest(std::int32_t sender, Utime end_utime, Utime duration_us) {
  Sender& s = senders_[sender];
  if (end_utime != s.end_utime) {
    s.end_utime = end_utime;
    s.sent_us = std::max(s.sent_us, is_silent(s) ? progress_us_ : progress_us_ - silence_us_) + duration_us;
    progress_us_ = std::max(progress_us_, s.sent_us);
  }
  s.heard_at = progress_us_;
  now_ = told_time();
}

void TeamClock::on_tick(Utime tick) {
  last_tick_ = tick;
  at_tick_ = std::max(now_.value_or(tick), tick);
  progress_at_tick_us_ = progress_us_;
  if (now_) now_ = told_time();
}

Utime TeamClock::told_time() const {
  std::vector<Utime> votes;
  for (const auto& [sender, s] : senders_) {
    const bool behind = last_tick_ && reading(s) < *last_tick_ - silence_us_;
    if (!is_silent(s) && !behind) votes.push_back(reading(s));
  }
  if (votes.empty()) return at_tick_ + progress_us_ - progress_at_tick_us_;
  const auto middle = votes.begin() + (std::ssize(votes) - 1) / 2;
  std::nth_element(votes.begin(), middle, votes.end());
  return *middle;
}

Utime TeamClock::ahead_us(std::int32_t sender) const {
  const auto found = senders_.find(sender);
  return found == senders_.end() ? 0 : reading(found->second) - *now_;
}

}  // namespace comptonaut
