// SPDX-License-Identifier: BSD-3-Clause
#include "team/duplicates.h"

#include <algorithm>

namespace comptonaut {

void Duplicates::Window::advance_to(std::uint64_t new_next) {
  if (new_next > next + kWindow) {
    seen.reset();
  } else {
    for (std::uint64_t counter = next; counter < new_next; ++counter) seen.reset(counter % kWindow);
  }
  next = std::max(next, new_next);
}

bool Duplicates::first_time(const TeamNumber& number) {
  Window& window = window_of(number);
  window.last_heard = ++now_;
  if (number.counter + kWindow < window.next) return false;
  window.advance_to(number.counter + 1);
  auto seen = window.seen[number.counter % kWindow];
  if (seen) return false;
  seen = true;
  return true;
}

Duplicates::Window& Duplicates::window_of(const TeamNumber& number) {
  const std::pair process(number.sender, number.boot_epoch);
  if (windows_.size() >= kMaxProcesses && !windows_.contains(process)) {
    windows_.erase(std::min_element(windows_.begin(), windows_.end(), [](const auto& a, const auto& b) {
      return a.second.last_heard < b.second.last_heard;
    }));
  }
  return windows_[process];
}

}  // namespace comptonaut
