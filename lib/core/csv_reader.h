// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace comptonaut {

/// A table of numbers in a CSV file, read strictly, row by row. The header names the columns, in any order, each once
/// and no others. Empty lines and lines that begin with '#' are passed over, blanks around fields and CRLF too; there
/// are no quotes. What is wrong throws std::runtime_error: one line with the file, the line, the column, what stands
/// there and what would be right.
class CsvReader {
 public:
  /// The columns by name; below they are known by their place in this list.
  CsvReader(const std::filesystem::path& file, std::vector<std::string> columns);

  /// Goes to the next row; false at the end.
  [[nodiscard]] bool next();

  /// Of the current row; both ends of the range included.
  [[nodiscard]] double number(std::size_t column, double min, double max) const;
  [[nodiscard]] std::int64_t whole(std::size_t column, std::int64_t min, std::int64_t max) const;

  /// To be thrown where the current row, or the field in it, is wrong.
  [[nodiscard]] std::runtime_error error(const std::string& what) const;
  [[nodiscard]] std::runtime_error error(std::size_t column, const std::string& must_be) const;

 private:
  [[nodiscard]] bool read_line();
  void split();
  void read_header();
  [[nodiscard]] std::string_view field(std::size_t column) const { return fields_[field_of_[column]]; }

  std::string file_;
  std::ifstream in_;
  std::vector<std::string> columns_;
  std::vector<std::size_t> field_of_;  ///< where each column stands in a row
  std::string text_;                   ///< the line
  std::vector<std::string_view> fields_;
  std::int64_t line_ = 0;
};

}  // namespace comptonaut
