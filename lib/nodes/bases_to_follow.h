// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "nodes/coordinator.h"
#include "nodes/map_tile.h"
#include "nodes/status.h"

namespace comptonaut {

/// The ticks that another coordinator announced, kept until their batches are there: each is followed in its turn.
class BasesToFollow {
 public:
  /// An announcement of a tick that was followed already, or that is known, changes nothing.
  void on_state(const CoordinatorState& state);

  /// Makes `coordinator` follow the oldest tick that waits; nullopt while batches of it are missing. A map that is not
  /// the announced one is counted: announcements were lost, or the programs differ.
  [[nodiscard]] std::optional<Coordinator::Tick> next(Coordinator& coordinator);

  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  static constexpr std::size_t kMaxWaiting = 3600;  // an hour of ticks
  std::map<Utime, CoordinatorState> waiting_;
  Utime last_followed_ = -1;
  std::int64_t followed_ = 0;
  std::int64_t different_ = 0;
  std::int64_t forgotten_ = 0;
};

}  // namespace comptonaut
