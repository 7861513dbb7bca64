// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace comptonaut {

/// How pixel hits are written down.
enum class HitFormat {
  kT3pa,  ///< text, a hit a row: T3paParser
  kT3p,   ///< binary: T3pParser
  kClog,  ///< text, a cluster a line: ClogParser
};

/// By the name's ending, .t3pa, .t3p or .clog in letters of any size; else by the first bytes: "Frame" begins a cluster
/// log, a byte that no text holds binary data, and all else is .t3pa.
[[nodiscard]] HitFormat hit_format(const std::filesystem::path& name, std::span<const char> beginning = {});

/// The same of a file, looking into it where the name does not tell.
[[nodiscard]] HitFormat hit_format_of(const std::filesystem::path& file);

/// What a row must be, for people.
[[nodiscard]] std::string_view describe_row(HitFormat format);

}  // namespace comptonaut
