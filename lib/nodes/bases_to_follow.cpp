// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/bases_to_follow.h"

namespace comptonaut {

void BasesToFollow::on_state(const CoordinatorState& state) {
  if (state.utime <= last_followed_ || waiting_.contains(state.utime)) return;
  if (waiting_.size() >= kMaxWaiting) {
    ++forgotten_;
    return;
  }
  waiting_.emplace(state.utime, state);
}

std::optional<Coordinator::Tick> BasesToFollow::next(Coordinator& coordinator) {
  if (waiting_.empty()) return {};
  const auto& [utime, announced] = *waiting_.begin();
  auto tick = coordinator.follow(utime, announced.basis);
  if (!tick) return {};
  ++followed_;
  if (tick->state.lambda_hash != announced.lambda_hash) ++different_;
  last_followed_ = utime;
  waiting_.erase(waiting_.begin());
  return tick;
}

std::vector<Counter> BasesToFollow::counters() const {
  return {{"ticks_followed", followed_},
          {"ticks_different", different_},
          {"ticks_waiting", static_cast<std::int64_t>(waiting_.size())},
          {"ticks_forgotten", forgotten_}};
}

}  // namespace comptonaut
