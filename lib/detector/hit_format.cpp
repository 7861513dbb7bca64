// SPDX-License-Identifier: BSD-3-Clause
#include "detector/hit_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>

namespace comptonaut {
namespace {

constexpr std::size_t kLook = 256;  ///< bytes that tell text from binary

bool is_control(char c) { return c >= 0 && c < ' ' && c != '\t' && c != '\r' && c != '\n'; }

}  // namespace

HitFormat hit_format(const std::filesystem::path& name, std::span<const char> beginning) {
  std::string ending = name.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".t3pa") return HitFormat::kT3pa;
  if (ending == ".t3p") return HitFormat::kT3p;
  if (ending == ".clog") return HitFormat::kClog;
  std::string_view text(beginning.data(), std::min(beginning.size(), kLook));
  if (std::any_of(text.begin(), text.end(), is_control)) return HitFormat::kT3p;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text.starts_with("Frame") ? HitFormat::kClog : HitFormat::kT3pa;
}

HitFormat hit_format_of(const std::filesystem::path& file) {
  std::array<char, kLook> beginning{};
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data(), beginning.size());
  return hit_format(file, std::span(beginning).first(static_cast<std::size_t>(in.gcount())));
}

std::string_view describe_row(HitFormat format) {
  switch (format) {
    case HitFormat::kT3pa:
      return "a row must be Index, Matrix Index, ToA, ToT, FToA, Overflow";
    case HitFormat::kT3p:
      return "a record must be 16 bytes: matrix index, ToA, Overflow, FToA, ToT";
    case HitFormat::kClog:
      return "a cluster must be [x, y, E, ToA] ... after Frame N (start, length s)";
  }
  return {};
}

}  // namespace comptonaut
