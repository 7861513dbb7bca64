// SPDX-License-Identifier: BSD-3-Clause
// The first inputs of each fuzz target and so many mutations of them, the same in each run: what is left of fuzzing
// where libFuzzer is not there. scripts/fuzz.sh is the real thing.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/random.h"
#include "fuzz/targets.h"

namespace comptonaut {
namespace {

constexpr int kMutations = 1500;
constexpr std::size_t kLargest = 8192;

std::vector<std::string> first_inputs(std::string_view target) {
  const auto folder = std::filesystem::path(COMPTONAUT_SOURCE_DIR) / "tests/fuzz/corpus" / target;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return inputs;
}

std::size_t below(Random& random, std::size_t end) { return end == 0 ? 0 : random() % end; }

/// A few changes: bytes, numbers, pieces that go, come twice or come from another input.
std::string mutated(std::string input, const std::vector<std::string>& others, Random& random) {
  static const std::string kPieces[] = {"0",
                                        "-1",
                                        "16384",
                                        "18446744073709551616",
                                        "1e308",
                                        "nan",
                                        "\n",
                                        "\r\n",
                                        "\t",
                                        "[",
                                        "\xff\xff\xff\xff\xff\xff\xff\xff",
                                        std::string(9, '\0'),
                                        "# alive ",
                                        ","};
  for (std::size_t changes = 1 + below(random, 6); changes-- > 0;) {
    const std::size_t at = below(random, input.size() + 1), size = below(random, 24);
    const std::string& other = others[below(random, others.size())];
    switch (below(random, 6)) {
      case 0:
        if (at < input.size()) input[at] = static_cast<char>(random());
        break;
      case 1:
        input.erase(at, size);
        break;
      case 2:
        input.insert(at, kPieces[below(random, std::size(kPieces))]);
        break;
      case 3:
        input.insert(at, input.substr(below(random, input.size() + 1), 4 * size));
        break;
      case 4:
        input.insert(at, other.substr(below(random, other.size() + 1), 8 * size));
        break;
      default:
        input.replace(at, std::min(size, input.size() - at), kPieces[below(random, std::size(kPieces))]);
    }
  }
  return input.substr(0, kLargest);
}

class Fuzz : public testing::TestWithParam<FuzzTarget> {};

TEST_P(Fuzz, TheFirstInputsAndMutationsOfThemBreakNoLaw) {
  const FuzzTarget& target = GetParam();
  const std::vector<std::string> inputs = first_inputs(target.name);
  ASSERT_FALSE(inputs.empty());
  for (const std::string& input : inputs) EXPECT_NO_THROW(target.run(input)) << input;
  target.run({});
  Random random(1);
  for (int i = 0; i < kMutations; ++i) {
    const std::string input = mutated(inputs[below(random, inputs.size())], inputs, random);
    ASSERT_NO_THROW(target.run(input)) << "mutation " << i << ": " << testing::PrintToString(input);
  }
}

std::string name_of(const testing::TestParamInfo<FuzzTarget>& target) { return std::string(target.param.name); }
INSTANTIATE_TEST_SUITE_P(Parsers, Fuzz, testing::ValuesIn(kParserTargets), name_of);
INSTANTIATE_TEST_SUITE_P(Others, Fuzz, testing::ValuesIn(kOtherTargets), name_of);

}  // namespace
}  // namespace comptonaut
