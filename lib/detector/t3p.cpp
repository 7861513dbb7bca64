// SPDX-License-Identifier: BSD-3-Clause
#include "detector/t3p.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "detector/hit_row.h"

namespace comptonaut {
namespace {

/// An unsigned little-endian number.
template <std::size_t kBytes>
std::uint64_t number_at(const char* at) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t value = 0;
  std::memcpy(&value, at, kBytes);
  return value;
}

}  // namespace

std::span<const StreamItem> T3pParser::parse(std::span<const char> bytes) {
  items_.clear();
  if (tail_size_ > 0) {
    const std::size_t missing = std::min(kRecord - tail_size_, bytes.size());
    std::copy_n(bytes.data(), missing, tail_.data() + tail_size_);
    tail_size_ += missing;
    bytes = bytes.subspan(missing);
    if (tail_size_ < kRecord) return items_;
    tail_size_ = 0;
    parse_record(tail_.data());
  }
  for (; bytes.size() >= kRecord; bytes = bytes.subspan(kRecord)) parse_record(bytes.data());
  std::copy(bytes.begin(), bytes.end(), tail_.begin());
  tail_size_ = bytes.size();
  return items_;
}

std::span<const StreamItem> T3pParser::end() {
  items_.clear();
  if (tail_size_ > 0) faults_.add(RowFault::kCutShort, ++rows_);
  tail_size_ = 0;
  return items_;
}

void T3pParser::parse_record(const char* record) {
  ++rows_;
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  const HitRow row{.pixel = static_cast<std::int64_t>(number_at<4>(record)),
                   .toa = static_cast<std::int64_t>(std::min(number_at<8>(record + 4), kLargest)),
                   .tot = static_cast<std::int64_t>(number_at<2>(record + 14)),
                   .ftoa = static_cast<std::int64_t>(number_at<1>(record + 13)),
                   .overflow = static_cast<std::int64_t>(number_at<1>(record + 12))};
  if (const auto fault = fault_of(row)) return faults_.add(*fault, rows_);
  items_.push_back(item_of(row, rows_));
}

}  // namespace comptonaut
