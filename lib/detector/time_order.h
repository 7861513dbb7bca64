// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/hit.h"

namespace comptonaut {

/// Puts hits that are nearly in order of time in order. Hits of the same time stay in order of arrival.
class TimeOrder {
 public:
  /// Hits farther apart than `quiet` belong to different stretches: a stretch is released as a whole.
  explicit TimeOrder(ChipTime quiet) : quiet_(quiet) {}

  /// Returns how many of them are left out, because their time has been released.
  [[nodiscard]] std::int64_t add(std::span<const Hit> hits);

  /// All stretches before `horizon`, ordered; valid until the next call of any. A stretch beyond kMaxStretch hits is
  /// cut, so that memory stays bounded.
  [[nodiscard]] std::span<const Hit> release(ChipTime horizon);

  /// No hit before this is still to be released.
  [[nodiscard]] ChipTime until() const { return until_; }

  static constexpr std::size_t kMaxStretch = 65536;

 private:
  void drop_released();
  void insert(Hit* place);

  ChipTime quiet_;
  ChipTime until_ = 0;
  std::vector<Hit> hits_;
  std::size_t released_ = 0;  ///< so many at the beginning of hits_ have been
  bool sorted_ = true;
};

}  // namespace comptonaut
