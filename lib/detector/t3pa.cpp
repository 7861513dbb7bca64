// SPDX-License-Identifier: BSD-3-Clause
#include "detector/t3pa.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>

namespace comptonaut {
namespace {

constexpr std::size_t kMaxLine = 256;
constexpr std::int64_t kMaxToA = std::int64_t{1} << 47;  // ticks of 25 ns: 40 days
constexpr std::int64_t kMaxUtime = 4'102'444'800 * kSecond_us;
constexpr std::int64_t kGapBegins = 0x74;
constexpr std::int64_t kGapEnds = 0x75;
constexpr std::int64_t kUnitsPerTick = 16;

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads one whole number after blanks and steps behind it. Numbers beyond 18 digits stay at 10^18.
bool read_number(const char*& at, const char* last, std::int64_t& value) {
  while (at != last && is_blank(*at)) ++at;
  if (at == last || !is_digit(*at)) return false;
  value = 0;
  constexpr std::int64_t kEnough = 100'000'000'000'000'000;
  for (; at != last && is_digit(*at); ++at) value = value < kEnough ? 10 * value + (*at - '0') : 10 * kEnough;
  return true;
}

struct Row {
  std::int64_t index, pixel, toa, tot, ftoa, overflow;
};

bool read_row(const char* at, const char* last, Row& row) {
  for (std::int64_t* number : {&row.index, &row.pixel, &row.toa, &row.tot, &row.ftoa, &row.overflow}) {
    if (!read_number(at, last, *number)) return false;
    if (at != last && !is_blank(*at)) return false;
  }
  while (at != last && is_blank(*at)) ++at;
  return at == last;
}

std::optional<RowFault> fault_of(const Row& row) {
  if (row.pixel >= kChipPixels * kChipPixels) return RowFault::kPixel;
  if (row.toa > kMaxToA) return RowFault::kToA;
  if (row.overflow != 0) {
    const bool known = row.overflow == 1 && (row.pixel == kGapBegins || row.pixel == kGapEnds);
    return known ? std::nullopt : std::optional(RowFault::kMarker);
  }
  if (row.ftoa > 31) return RowFault::kFToA;
  if (row.tot > 1023) return RowFault::kToT;
  if (row.tot == 0) return RowFault::kZeroToT;
  return std::nullopt;
}

bool is_ascii(const char* first, const char* last) {
  return std::all_of(first, last, [](char c) { return c == '\t' || (c >= ' ' && c <= '~'); });
}

}  // namespace

std::span<const T3paItem> T3paParser::parse(std::span<const char> bytes) {
  items_.clear();
  const char* at = bytes.data();
  const char* const last = at + bytes.size();
  while (at != last) {
    const char* line_end = static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(last - at)));
    if (!line_end) {
      keep_tail(at, last);
      break;
    }
    if (tail_.empty() && !skipping_) {
      parse_line(at, line_end);
    } else {
      keep_tail(at, line_end);
      parse_line(tail_.data(), tail_.data() + tail_.size());
      tail_.clear();
      skipping_ = false;
    }
    at = line_end + 1;
  }
  return items_;
}

std::span<const T3paItem> T3paParser::end() {
  items_.clear();
  if (!tail_.empty() || skipping_) {
    const std::int64_t wrong = faults_.of(RowFault::kNotSixNumbers);
    parse_line(tail_.data(), tail_.data() + tail_.size());
    if (faults_.of(RowFault::kNotSixNumbers) > wrong)
      faults_.move(RowFault::kNotSixNumbers, RowFault::kCutShort, line_);
  }
  tail_.clear();
  skipping_ = false;
  return items_;
}

/// Keeps at most one byte more than a line may have.
void T3paParser::keep_tail(const char* first, const char* last) {
  const std::size_t room = kMaxLine + 1 - tail_.size();
  tail_.append(first, std::min(room, static_cast<std::size_t>(last - first)));
  skipping_ = tail_.size() > kMaxLine;
}

void T3paParser::parse_line(const char* first, const char* last) {
  ++line_;
  if (last != first && last[-1] == '\r') --last;
  while (first != last && is_blank(*first)) ++first;
  if (first == last) return;
  if (static_cast<std::size_t>(last - first) > kMaxLine) {
    ++rows_;
    return faults_.add(RowFault::kTooLong, line_);
  }
  if (is_digit(*first)) return parse_row(first, last);
  if (*first == '#') return parse_comment(first + 1, last);
  const std::string_view line(first, static_cast<std::size_t>(last - first));
  if (line.starts_with("Index") || line.starts_with("\xEF\xBB\xBFIndex")) return add(T3paItem::Kind::kHeader, 0);
  ++rows_;
  faults_.add(is_ascii(first, last) ? RowFault::kNotSixNumbers : RowFault::kNonAscii, line_);
}

void T3paParser::parse_row(const char* first, const char* last) {
  ++rows_;
  Row row;
  if (!read_row(first, last, row)) {
    return faults_.add(is_ascii(first, last) ? RowFault::kNotSixNumbers : RowFault::kNonAscii, line_);
  }
  if (const auto fault = fault_of(row)) return faults_.add(*fault, line_);
  if (row.overflow != 0) {
    const auto kind = row.pixel == kGapBegins ? T3paItem::Kind::kLostBegin : T3paItem::Kind::kLostEnd;
    return add(kind, kUnitsPerTick * row.toa);
  }
  items_.push_back({.value = kUnitsPerTick * row.toa - row.ftoa,
                    .line = static_cast<std::uint32_t>(line_),
                    .index = static_cast<std::uint32_t>(row.index),
                    .pixel = static_cast<std::uint16_t>(row.pixel),
                    .tot = static_cast<std::uint16_t>(row.tot),
                    .kind = T3paItem::Kind::kHit});
}

/// Comments that are not of the stream protocol are anybody's.
void T3paParser::parse_comment(const char* first, const char* last) {
  const auto keyed = [&](std::string_view key, std::int64_t max) -> std::optional<std::int64_t> {
    const char* at = first;
    while (at != last && is_blank(*at)) ++at;
    if (!std::string_view(at, static_cast<std::size_t>(last - at)).starts_with(key)) return std::nullopt;
    at += key.size();
    std::int64_t value = 0;
    if (at != last && !is_blank(*at)) return std::nullopt;
    if (read_number(at, last, value) && at == last && value <= max) return value;
    faults_.add(RowFault::kMarker, line_);
    return std::nullopt;
  };
  if (const auto utime = keyed("start_utime_us", kMaxUtime)) add(T3paItem::Kind::kStart, *utime);
  if (const auto toa = keyed("alive", kMaxToA)) add(T3paItem::Kind::kAlive, kUnitsPerTick * *toa);
}

void T3paParser::add(T3paItem::Kind kind, std::int64_t value) {
  items_.push_back({.value = value, .line = static_cast<std::uint32_t>(line_), .kind = kind});
}

}  // namespace comptonaut
