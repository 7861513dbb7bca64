// SPDX-License-Identifier: BSD-3-Clause
#include "detector/clog.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/time.h"
#include "detector/hit_row.h"

namespace comptonaut {
namespace {

constexpr double kFirstUnix_s = 1e9;           // 2001
constexpr double kLastUnix_s = 4'102'444'800;  // 2100
constexpr double kMaxTime_ns = 25.0 * static_cast<double>(kMaxToA);
constexpr double kMaxEnergy_keV = 1e6;
constexpr std::ptrdiff_t kPlainLength = 15;
constexpr std::array kPowersOfTen{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};

/// Reads along a line.
struct Reader {
  const char* at;
  const char* last;

  void skip_blanks() {
    while (at != last && (*at == ' ' || *at == '\t')) ++at;
  }
  bool take(char c) {
    skip_blanks();
    if (at == last || *at != c) return false;
    ++at;
    return true;
  }
  bool take(std::string_view word) {
    if (!std::string_view(at, static_cast<std::size_t>(last - at)).starts_with(word)) return false;
    at += word.size();
    return true;
  }
  bool take(double& value) {
    skip_blanks();
    if (take_plain(value)) return true;
    const auto [end, error] = std::from_chars(at, last, value);
    if (error != std::errc() || !std::isfinite(value)) return false;
    at = end;
    return true;
  }
  bool at_end() {
    skip_blanks();
    return at == last;
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  /// A number of few digits without sign and exponent, as almost all are: the quotient of two whole numbers that a
  /// double holds, and so rounded like any other number.
  bool take_plain(double& value) {
    std::int64_t digits = 0;
    const char* p = at;
    const auto take_digits = [&] {
      const char* const first = p;
      for (; p != last && is_digit(*p) && p - at < kPlainLength; ++p) {
        digits = 10 * digits + *p - '0';
      }
      return p - first;
    };
    if (take_digits() == 0) return false;
    std::ptrdiff_t decimals = 0;
    if (p != last && *p == '.') {
      ++p;
      decimals = take_digits();
      if (decimals == 0) return false;
    }
    if (p != last && (is_digit(*p) || *p == '.' || *p == 'e' || *p == 'E')) return false;
    value = static_cast<double>(digits);
    if (decimals > 0) value /= kPowersOfTen[static_cast<std::size_t>(decimals)];
    at = p;
    return true;
  }
};

bool is_coordinate(double value) { return value >= 0.0 && value < kChipPixels && value == static_cast<int>(value); }

ChipTime chip_time(double ns) { return std::llround(ns / kChipTime_ns); }

}  // namespace

std::span<const StreamItem> ClogParser::parse(std::span<const char> bytes) {
  items_.clear();
  lines_.feed(bytes, [this](const char* first, const char* last) { parse_line(first, last); });
  return items_;
}

std::span<const StreamItem> ClogParser::end() {
  items_.clear();
  const std::int64_t wrong = faults_.of(RowFault::kNotACluster);
  lines_.end([this](const char* first, const char* last) { parse_line(first, last); });
  if (faults_.of(RowFault::kNotACluster) > wrong) faults_.move(RowFault::kNotACluster, RowFault::kCutShort, line_);
  close_frame();
  return items_;
}

void ClogParser::parse_line(const char* first, const char* last) {
  ++line_;
  Reader reader{first, last};
  if (reader.at_end()) return;
  (void)(line_ == 1 && reader.take("\xEF\xBB\xBF"));
  const std::size_t before = items_.size();
  std::optional<RowFault> fault;
  if (static_cast<std::size_t>(last - first) > kMaxLine) {
    fault = RowFault::kTooLong;
  } else if (reader.take("Frame")) {
    fault = parse_frame(reader.at, last);
    if (!fault) return;
    frame_.reset();
  } else {
    fault = parse_cluster(reader.at, last);
  }
  ++rows_;
  if (!fault) return;
  items_.resize(before);
  faults_.add(*fault, line_);
  if (loses_hit(*fault)) items_.push_back({.kind = StreamItem::Kind::kLostHit});
}

std::optional<RowFault> ClogParser::parse_frame(const char* first, const char* last) {
  Reader reader{first, last};
  double number = 0.0, start = 0.0, length_s = 0.0;
  if (!(reader.take(number) && reader.take('(') && reader.take(start) && reader.take(',') && reader.take(length_s) &&
        reader.take('s') && reader.take(')') && reader.at_end())) {
    return RowFault::kNotACluster;
  }
  if (!(start >= 0.0 && length_s >= 0.0)) return RowFault::kToA;
  const bool shutter = length_s > 0.0;
  const double from_ns = shutter ? 1e9 * (start - origin_s_.value_or(start)) : start;
  if (!(from_ns >= 0.0 && from_ns + 1e9 * length_s < kMaxTime_ns)) return RowFault::kToA;
  const Frame frame{chip_time(from_ns), chip_time(from_ns + 1e9 * length_s)};
  close_frame();
  frame_ = frame;
  if (!shutter) return std::nullopt;

  const auto add = [&](StreamItem::Kind kind, std::int64_t value) {
    items_.push_back({.value = value, .line = static_cast<std::uint32_t>(line_), .kind = kind});
  };
  const bool is_first = !origin_s_;
  if (is_first) {
    origin_s_ = start;
    const bool unix_time = start >= kFirstUnix_s && start < kLastUnix_s;
    if (unix_time) add(StreamItem::Kind::kStart, std::llround(static_cast<double>(kSecond_us) * start));
  }
  add(StreamItem::Kind::kShutter, frame.to + 1);  // as hits are rounded
  if (!is_first && shutter_end_ && frame.from > *shutter_end_) {
    add(StreamItem::Kind::kLostBegin, *shutter_end_);
    add(StreamItem::Kind::kLostEnd, frame.from - *shutter_end_);
  }
  add(StreamItem::Kind::kAlive, frame.from);
  shutter_end_ = frame.to;
  return std::nullopt;
}

std::optional<RowFault> ClogParser::parse_cluster(const char* first, const char* last) {
  Reader reader{first, last};
  while (!reader.at_end()) {
    double x = 0.0, y = 0.0, energy_keV = 0.0, toa_ns = 0.0;
    if (!(reader.take('[') && reader.take(x) && reader.take(',') && reader.take(y) && reader.take(',') &&
          reader.take(energy_keV) && reader.take(',') && reader.take(toa_ns) && reader.take(']'))) {
      return RowFault::kNotACluster;
    }
    if (!frame_) return RowFault::kNoFrame;
    if (!is_coordinate(x) || !is_coordinate(y)) return RowFault::kPixel;
    if (!(energy_keV >= 1e-3 && energy_keV <= kMaxEnergy_keV)) return RowFault::kEnergy;
    if (!(std::abs(toa_ns) < kMaxTime_ns)) return RowFault::kToA;
    const ChipTime t = frame_->from + chip_time(toa_ns);
    const ChipTime t_max = frame_->to > frame_->from ? frame_->to + 1 : kUnitsPerTick * kMaxToA;
    if (t < 0 || t > t_max) return RowFault::kToA;
    items_.push_back({.value = t,
                      .line = static_cast<std::uint32_t>(line_),
                      .pixel = static_cast<std::uint16_t>(kChipPixels * static_cast<int>(y) + static_cast<int>(x)),
                      .energy_keV = static_cast<float>(energy_keV)});
  }
  return std::nullopt;
}

/// The detector lived up to the end of a frame of a shutter.
void ClogParser::close_frame() {
  if (!frame_ || frame_->to == frame_->from) return;
  items_.push_back({.value = frame_->to, .line = static_cast<std::uint32_t>(line_), .kind = StreamItem::Kind::kAlive});
  frame_.reset();
}

}  // namespace comptonaut
