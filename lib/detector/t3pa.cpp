// SPDX-License-Identifier: BSD-3-Clause
#include "detector/t3pa.h"

#include <algorithm>
#include <string_view>

#include "detector/hit_row.h"

namespace comptonaut {
namespace {

constexpr std::int64_t kMaxUtime = 4'102'444'800 * kSecond_us;

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return static_cast<unsigned char>(c - '0') <= 9; }

/// Reads one whole number after blanks and steps behind it. Numbers beyond 18 digits stay at 10^18.
bool read_number(const char*& at, const char* last, std::int64_t& value) {
  while (at != last && is_blank(*at)) ++at;
  if (at == last || !is_digit(*at)) return false;
  value = 0;
  constexpr std::int64_t kEnough = 100'000'000'000'000'000;
  for (; at != last && is_digit(*at); ++at) value = value < kEnough ? 10 * value + (*at - '0') : 10 * kEnough;
  return true;
}

bool read_row(const char* at, const char* last, HitRow& row) {
  for (std::int64_t* number : {&row.index, &row.pixel, &row.toa, &row.tot, &row.ftoa, &row.overflow}) {
    if (!read_number(at, last, *number)) return false;
    if (at != last && !is_blank(*at)) return false;
  }
  while (at != last && is_blank(*at)) ++at;
  return at == last;
}

/// The same for the usual case alone: numbers of 18 digits at most with one blank between them. The byte behind
/// a line can be read and is no digit.
bool read_usual_row(const char* at, const char* last, HitRow& row) {
  for (std::int64_t* number : {&row.index, &row.pixel, &row.toa, &row.tot, &row.ftoa, &row.overflow}) {
    const char* const first = at;
    std::uint64_t value = 0;
    for (; is_digit(*at); ++at) value = 10 * value + static_cast<std::uint64_t>(*at - '0');
    if (at == first || at - first > 18) return false;
    *number = static_cast<std::int64_t>(value);
    if (at == last) return number == &row.overflow;
    if (!is_blank(*at)) return false;
    ++at;
  }
  return false;
}

bool is_ascii(const char* first, const char* last) {
  return std::all_of(first, last, [](char c) { return c == '\t' || (c >= ' ' && c <= '~'); });
}

}  // namespace

std::span<const StreamItem> T3paParser::parse(std::span<const char> bytes) {
  items_.clear();
  lines_.feed(bytes, [this](const char* first, const char* last) { parse_line(first, last); });
  return items_;
}

std::span<const StreamItem> T3paParser::end() {
  items_.clear();
  const std::int64_t wrong = faults_.of(RowFault::kNotSixNumbers);
  lines_.end([this](const char* first, const char* last) { parse_line(first, last); });
  if (faults_.of(RowFault::kNotSixNumbers) > wrong) faults_.move(RowFault::kNotSixNumbers, RowFault::kCutShort, line_);
  return items_;
}

void T3paParser::parse_line(const char* first, const char* last) {
  ++line_;
  if (static_cast<std::size_t>(last - first) > kMaxLine) {
    ++rows_;
    return refuse(RowFault::kTooLong);
  }
  while (first != last && is_blank(*first)) ++first;
  if (first == last) return;
  if (is_digit(*first)) return parse_row(first, last);
  if (*first == '#') return parse_comment(first + 1, last);
  const std::string_view line(first, static_cast<std::size_t>(last - first));
  if (line.starts_with("Index") || line.starts_with("\xEF\xBB\xBFIndex")) return add(StreamItem::Kind::kHeader, 0);
  ++rows_;
  refuse(is_ascii(first, last) ? RowFault::kNotSixNumbers : RowFault::kNonAscii);
}

void T3paParser::refuse(RowFault fault) {
  faults_.add(fault, line_);
  if (loses_hit(fault)) add(StreamItem::Kind::kLostHit, 0);
}

void T3paParser::parse_row(const char* first, const char* last) {
  ++rows_;
  HitRow row;
  if (!read_usual_row(first, last, row) && !read_row(first, last, row)) {
    return refuse(is_ascii(first, last) ? RowFault::kNotSixNumbers : RowFault::kNonAscii);
  }
  if (const auto fault = fault_of(row)) return refuse(*fault);
  items_.push_back(item_of(row, line_));
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
  if (const auto utime = keyed("start_utime_us", kMaxUtime)) add(StreamItem::Kind::kStart, *utime);
  if (const auto toa = keyed("alive", kMaxToA)) add(StreamItem::Kind::kAlive, kUnitsPerTick * *toa);
}

void T3paParser::add(StreamItem::Kind kind, std::int64_t value) {
  items_.push_back({.value = value, .line = static_cast<std::uint32_t>(line_), .kind = kind});
}

}  // namespace comptonaut
