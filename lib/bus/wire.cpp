// SPDX-License-Identifier: BSD-3-Clause
#include "bus/wire.h"

#include <stdexcept>

#include "team/big_endian.h"

namespace comptonaut {
namespace {

/// Length of the first item of a layout: a letter, or a struct with its braces.
std::size_t item_length(std::string_view layout) {
  int depth = 0;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    depth += layout[i] == '{' ? 1 : layout[i] == '}' ? -1 : 0;
    if (depth == 0) return i + 1;
  }
  throw std::logic_error("message layout with an open brace: " + std::string(layout));
}

/// Walks over a message without keeping anything of it.
class Walk {
 public:
  explicit Walk(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool members(std::string_view layout) {
    std::int32_t count = 0;
    while (!layout.empty()) {
      const bool repeated = layout.front() == '*';
      if (repeated || layout.front() == ' ') layout.remove_prefix(1);
      if (layout.empty() || layout.front() == ' ') continue;
      const std::string_view item = layout.substr(0, item_length(layout));
      layout.remove_prefix(item.size());
      if (item == "n" ? !read_count(count) : !items(item, repeated ? count : 1)) return false;
    }
    return true;
  }

 private:
  bool items(std::string_view item, std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) {
      if (!one(item)) return false;
    }
    return true;
  }

  bool one(std::string_view item) {
    switch (item.front()) {
      case '1':
        return skip(1);
      case '?':
        return !rest_.empty() && rest_.front() <= 1 && skip(1);
      case '4':
        return skip(4);
      case '8':
        return skip(8);
      case 's':
        return text();
      case '{':
        return members(item.substr(1, item.size() - 2));
      default:
        throw std::logic_error("message layout with an unknown item: " + std::string(item));
    }
  }

  bool skip(std::size_t n) {
    if (n > rest_.size()) return false;
    rest_ = rest_.subspan(n);
    return true;
  }

  bool read_count(std::int32_t& count) {
    if (rest_.size() < 4) return false;
    count = read_big_endian<std::int32_t>(rest_);
    return skip(4) && count >= 0;
  }

  /// An int32_t length that counts the closing zero, the characters, the zero.
  bool text() {
    std::int32_t length = 0;
    if (!read_count(length) || length < 1) return false;
    const auto last = static_cast<std::size_t>(length) - 1;
    return last < rest_.size() && rest_[last] == 0 && skip(last + 1);
  }

  std::span<const std::uint8_t> rest_;
};

}  // namespace

bool well_formed(std::span<const std::uint8_t> bytes, std::int64_t fingerprint, std::string_view layout) {
  if (bytes.size() < 8 || read_big_endian<std::int64_t>(bytes) != fingerprint) return false;
  return Walk(bytes.subspan(8)).members(layout);
}

}  // namespace comptonaut
