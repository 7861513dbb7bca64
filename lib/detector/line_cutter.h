// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>

namespace comptonaut {

/// Text that comes in any pieces -> its lines, without their ends (LF or CRLF). A line that came in several pieces is
/// handed on with at most two bytes more than `max`, so that memory stays bounded. The byte behind a line can be read
/// and is a line end or 0.
class LineCutter {
 public:
  explicit LineCutter(std::size_t max) : max_(max) {}

  /// Calls line(first, last) for each line that `bytes` completes.
  template <class Line>
  void feed(std::span<const char> bytes, Line&& line) {
    const char* at = bytes.data();
    const char* const last = at + bytes.size();
    while (at != last) {
      const char* end = static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(last - at)));
      if (!end) return keep(at, last);
      if (!inside_) {
        line(at, without_return(at, end));
      } else {
        keep(at, end);
        finish(line);
      }
      at = end + 1;
    }
  }

  /// The text has ended: calls line(first, last) for a last line without an end, and says whether there was one.
  template <class Line>
  bool end(Line&& line) {
    if (!inside_) return false;
    finish(line);
    return true;
  }

  /// Within a line whose end has not come.
  [[nodiscard]] bool inside() const { return inside_; }

 private:
  void keep(const char* first, const char* last) {
    inside_ = true;
    tail_.append(first, std::min(max_ + 2 - tail_.size(), static_cast<std::size_t>(last - first)));
  }
  template <class Line>
  void finish(Line&& line) {
    inside_ = false;
    line(tail_.data(), without_return(tail_.data(), tail_.data() + tail_.size()));
    tail_.clear();
  }
  static const char* without_return(const char* first, const char* last) {
    return last != first && last[-1] == '\r' ? last - 1 : last;
  }

  std::size_t max_;
  std::string tail_;  ///< what has come of a line whose end has not
  bool inside_ = false;
};

}  // namespace comptonaut
