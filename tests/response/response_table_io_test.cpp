// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/random.h"
#include "response/response_grid.h"
#include "response/response_table.h"
#include "scratch.h"

namespace comptonaut {
namespace {

class TableFile : public ::testing::Test {
 protected:
  std::filesystem::path file_ = scratch_file("table.csv");

  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }
  std::string message() const {
    try {
      static_cast<void>(ResponseTable::load(file_));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(TableFile, ReadsBackBitForBit) {
  const ResponseTable table(response_grid(30), {{"nuclide", "Cs-137"}, {"command", "comptonaut response --seed 1"}});
  table.save(file_);
  const ResponseTable read = ResponseTable::load(file_);
  EXPECT_EQ(read.facts(), table.facts());
  EXPECT_EQ(read.entries(), table.entries());
}

TEST_F(TableFile, NamesLineAndReasonOfAFault) {
  const std::string header = "# nuclide: Cs-137\nphi_rad,theta_rad,single,single_rel_sigma,pair,pair_rel_sigma\r\n";
  const auto expect = [&](const std::string& text, const std::string& expected) {
    write(text);
    EXPECT_NE(message().find(expected), std::string::npos) << message();
  };
  expect(header + "0,0,1e-6,0.01,1e-8,0.01\r\n", "no error");
  expect("theta,phi\n", ".csv:1: expected 'phi_rad");
  expect(header + "0,0,1e-6,0.01,1e-8\n", ".csv:3: not six numbers");
  expect(header + "0,0,1e-6,0.01,1e-8,1,7\n", ".csv:3: not six numbers");
  expect(header + "0,0,1e-6,0.01,1e-8,\n", ".csv:3: not six numbers");
  expect(header + "0,0,-1,0.01,1e-8,0\n", "not negative");
  expect(header, "0 entries");
  std::filesystem::remove(file_);
  EXPECT_NE(message().find("cannot be read"), std::string::npos) << message();
}

TEST_F(TableFile, AnyDamageGivesATableOrOneError) {
  ResponseTable(response_grid(90), {{"nuclide", "Cs-137"}}).save(file_);
  std::ifstream in(file_);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    std::string bad = good;
    for (int n = 0; n < 1 + round % 5; ++n) bad[random() % bad.size()] = static_cast<char>(random());
    write(bad.substr(0, random() % (bad.size() + 1)));
    static_cast<void>(message());
  }
}

TEST_F(TableFile, ThatCannotBeWrittenIsNamed) {
  const ResponseTable table(response_grid(90));
  EXPECT_THROW(table.save("/nonexistent/table.csv"), std::runtime_error);
}

}  // namespace
}  // namespace comptonaut
