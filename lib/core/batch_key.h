// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace comptonaut {

/// Names one batch of one sender for ever. Numbers run 0, 1, 2, ... and start again only with a new boot epoch.
struct BatchKey {
  std::int64_t mission = 0;
  std::int32_t sender = 0;      ///< MAV number (1..); 0 is the ground station
  std::int64_t boot_epoch = 0;  ///< start of the sending process, us since the Unix epoch
  std::int64_t number = 0;

  auto operator<=>(const BatchKey&) const = default;
};

/// What of one sender has been folded in: everything up to `number` but what was given up as lost. `skipped` names what
/// was given up since the tick before: first and last number of each run, ascending, so {3, 3, 7, 9} is 3, 7, 8, 9.
struct BasisEntry {
  std::int32_t sender = 0;
  std::int64_t boot_epoch = 0;
  std::int64_t number = -1;
  std::vector<std::int64_t> skipped;

  bool operator==(const BasisEntry&) const = default;
};

/// The inputs that a state of the coordinator is a function of, ordered by sender, then boot epoch. A boot epoch that
/// its sender has left is named until another one of that sender is and nothing more comes of it: what was folded of it
/// stays, what still comes is left out.
using Basis = std::vector<BasisEntry>;

}  // namespace comptonaut
