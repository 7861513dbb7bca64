// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "core/batch_key.h"

namespace comptonaut {

/// Which batches of one sender have been seen. Numbers are contiguous within a boot epoch.
class SeenBatches {
 public:
  /// False: seen before.
  bool add(const BatchKey& key) { return numbers_[{key.mission, key.boot_epoch}].insert(key.number).second; }

  /// Numbers between the first and the last of each boot epoch that were not seen.
  [[nodiscard]] std::int64_t missing() const {
    std::uint64_t missing = 0;
    for (const auto& [epoch, numbers] : numbers_) {
      missing += static_cast<std::uint64_t>(*numbers.rbegin()) - static_cast<std::uint64_t>(*numbers.begin());
      missing -= numbers.size() - 1;
    }
    return static_cast<std::int64_t>(missing);
  }

 private:
  std::map<std::pair<std::int64_t, std::int64_t>, std::set<std::int64_t>> numbers_;
};

}  // namespace comptonaut
