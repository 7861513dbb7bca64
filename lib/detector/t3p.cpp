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

/// The bits of a record's two halves that are 0 in each hit: a pixel beyond the matrix, ToA of kMaxToA and more,
/// Overflow, FToA above 31.
constexpr std::uint64_t kNotInFirst = 0x0000'0000'ffff'0000, kNotInSecond = 0x0000'e0ff'ffff'8000;

/// Any record.
HitRow row_of(const char* record) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  return {.pixel = static_cast<std::int64_t>(number_at<4>(record)),
          .toa = static_cast<std::int64_t>(std::min(number_at<8>(record + 4), kLargest)),
          .tot = static_cast<std::int64_t>(number_at<2>(record + 14)),
          .ftoa = static_cast<std::int64_t>(number_at<1>(record + 13)),
          .overflow = static_cast<std::int64_t>(number_at<1>(record + 12))};
}

}  // namespace

std::span<const StreamItem> T3pParser::parse(std::span<const char> bytes) {
  items_.resize(std::max(items_.size(), bytes.size() / kRecord + 1));
  StreamItem* out = items_.data();
  if (tail_size_ > 0) {
    const std::size_t missing = std::min(kRecord - tail_size_, bytes.size());
    std::copy_n(bytes.data(), missing, tail_.data() + tail_size_);
    tail_size_ += missing;
    bytes = bytes.subspan(missing);
    if (tail_size_ < kRecord) return {};
    out = parse_records(tail_, out);
  }
  out = parse_records(bytes, out);
  tail_size_ = bytes.size() % kRecord;
  std::copy(bytes.end() - static_cast<std::ptrdiff_t>(tail_size_), bytes.end(), tail_.begin());
  return {items_.data(), out};
}

std::span<const StreamItem> T3pParser::end() {
  if (tail_size_ > 0) faults_.add(RowFault::kCutShort, ++rows_);
  tail_size_ = 0;
  return {};
}

/// Writes what the complete records say, and returns where it ends.
StreamItem* T3pParser::parse_records(std::span<const char> bytes, StreamItem* out) {
  std::int64_t line = rows_;
  for (; bytes.size() >= kRecord; bytes = bytes.subspan(kRecord)) {
    ++line;
    const std::uint64_t first = number_at<8>(bytes.data()), second = number_at<8>(bytes.data() + 8);
    const std::uint64_t toa = first >> 32 | second << 32, ftoa = second >> 40 & 31, tot = second >> 48;
    if (((first & kNotInFirst) | (second & kNotInSecond)) == 0 && tot - 1 < 1023) [[likely]] {
      *out++ = {.value = static_cast<std::int64_t>(kUnitsPerTick * toa - ftoa),
                .line = static_cast<std::uint32_t>(line),
                .pixel = static_cast<std::uint16_t>(first),
                .tot = static_cast<std::uint16_t>(tot)};
    } else if (const HitRow row = row_of(bytes.data()); const auto fault = fault_of(row)) {
      faults_.add(*fault, line);
      if (loses_hit(*fault)) *out++ = {.kind = StreamItem::Kind::kLostHit};
    } else {
      *out++ = item_of(row, line);
    }
  }
  rows_ = line;
  return out;
}

}  // namespace comptonaut
