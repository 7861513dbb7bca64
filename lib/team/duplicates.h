// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "team/trailer.h"

namespace comptonaut {

/// Tells the first arrival of each number from the others, in memory that has a bound.
class Duplicates {
 public:
  /// How far behind the newest of its sender a message may come and still be told from a repeated one.
  static constexpr std::uint64_t kWindow = 4096;
  /// Processes that are kept apart; the one that was heard longest ago is forgotten for the next.
  static constexpr std::size_t kMaxProcesses = 256;

  /// True exactly once per number. Also false for one further behind than kWindow. Counters stay below 2^63.
  [[nodiscard]] bool first_time(const TeamNumber& number);

 private:
  struct Window {
    std::uint64_t next = 0;     ///< one more than the newest counter
    std::bitset<kWindow> seen;  ///< of counters next - kWindow .. next - 1, at counter modulo kWindow
    std::uint64_t last_heard = 0;
    void advance_to(std::uint64_t new_next);
  };
  [[nodiscard]] Window& window_of(const TeamNumber& number);

  std::map<std::pair<std::int32_t, std::int64_t>, Window> windows_;  // by sender and boot epoch
  std::uint64_t now_ = 0;                                            // counts messages
};

}  // namespace comptonaut
