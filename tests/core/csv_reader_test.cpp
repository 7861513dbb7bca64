// SPDX-License-Identifier: BSD-3-Clause
#include "core/csv_reader.h"

#include <gtest/gtest.h>

#include "scratch.h"

namespace comptonaut {
namespace {

constexpr double kAny = 1e300;

std::filesystem::path file_of(const std::string& text) { return scratch_file("table.csv", text); }

/// What reading all of the columns a (-10..10) and n (whole, 0..9) throws; empty where nothing is wrong.
std::string complaint(const std::string& text) {
  try {
    CsvReader csv(file_of(text), {"a", "n"});
    while (csv.next()) {
      (void)csv.number(0, -10.0, 10.0);
      (void)csv.whole(1, 0, 9);
    }
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CsvReader, FindsColumnsByNameInAnyOrderAndPassesOverWhatSaysNothing) {
  CsvReader csv(file_of("\xef\xbb\xbf# made by hand\n\n n , a\r\n3,-1.5e0\r\n\n# a remark\n 4 ,\t2 \n5,0"), {"a", "n"});
  std::vector<double> a;
  std::vector<std::int64_t> n;
  while (csv.next()) {
    a.push_back(csv.number(0, -kAny, kAny));
    n.push_back(csv.whole(1, 0, 9));
  }
  EXPECT_EQ(a, (std::vector<double>{-1.5, 2.0, 0.0}));
  EXPECT_EQ(n, (std::vector<std::int64_t>{3, 4, 5}));
}

TEST(CsvReader, NamesFileLineColumnValueAndWhatWouldBeRight) {
  const struct {
    const char* text;
    std::vector<std::string> mentions;
  } cases[] = {
      {"", {"table.csv", "empty", "a,n"}},
      {"# nothing\n", {"empty"}},
      {"a\n", {"table.csv:1", "'n' is missing"}},
      {"a,n,surprise\n", {":1", "'surprise'"}},
      {"a,a,n\n", {":1", "'a' stands twice"}},
      {"1,2\n", {":1", "'1' is no column", "a,n"}},
      {"a,n\n1,2\n1,2,3\n", {"table.csv:3", "3 fields", "must be 2"}},
      {"a,n\n1\n", {":2", "1 fields"}},
      {"a,n\n\n#\nnan,2\n", {":4", "a 'nan'", "-10 to 10"}},
      {"a,n\ninf,2\n", {":2", "a 'inf'"}},
      {"a,n\n1e999,2\n", {"a '1e999'"}},
      {"a,n\n10.001,2\n", {"a '10.001'"}},
      {"a,n\n1 2,2\n", {"a '1 2'"}},
      {"a,n\n,2\n", {"a ''"}},
      {"a,n\n1,2.5\n", {"n '2.5'", "whole number from 0 to 9"}},
      {"a,n\n1,-1\n", {"n '-1'"}},
      {"a,n\n1,\"2\"\n", {"n '\"2\"'"}},
  };
  for (const auto& [text, mentions] : cases) {
    const std::string said = complaint(text);
    EXPECT_EQ(said.find('\n'), said.npos) << said;
    for (const std::string& word : mentions) EXPECT_NE(said.find(word), said.npos) << text << " -> " << said;
  }
  EXPECT_EQ(complaint("n,a\n9,-10\n"), "") << "the ends of a range belong to it";
}

TEST(CsvReader, SaysSoWhereThereIsNoFile) {
  for (const auto& file : {scratch_file("nowhere.csv"), scratch_folder()}) {
    EXPECT_THROW(CsvReader(file, {"a"}), std::runtime_error) << file;
  }
}

}  // namespace
}  // namespace comptonaut
