// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace comptonaut {

/// Where Debian's python-fisx-common keeps NIST's XCOM and LLNL's EADL97 as text.
inline constexpr std::string_view kFisxFolder = "/usr/share/fisx";

/// One scan (`#S number title`) of a text file in SPEC's format: named columns of numbers.
struct SpecScan {
  std::filesystem::path file;
  std::vector<std::string> columns;       ///< of the `#L` line
  std::vector<std::vector<double>> rows;  ///< each as long as `columns`

  /// Place of a column. Throws std::runtime_error that names the file if there is none.
  [[nodiscard]] std::size_t column(std::string_view name) const;
};

/// Throws std::runtime_error with file, line and reason: file unreadable, scan missing, a row that is not numbers.
[[nodiscard]] SpecScan read_spec_scan(const std::filesystem::path& file, int number);

}  // namespace comptonaut
