// SPDX-License-Identifier: BSD-3-Clause
#include "team/duplicates.h"

#include <gtest/gtest.h>

#include <set>

#include "core/random.h"

namespace comptonaut {
namespace {

TEST(Duplicates, AgreeWithASetThatForgetsNothing) {
  Random random(3);
  Duplicates duplicates;
  std::set<TeamNumber> seen;
  std::uint64_t newest = 0;
  for (int i = 0; i < 200'000; ++i) {
    newest += random() % 3;
    const std::uint64_t back = std::min<std::uint64_t>(newest, random() % (Duplicates::kWindow - 1));
    const TeamNumber number{.sender = static_cast<std::int32_t>(random() % 3),
                            .boot_epoch = static_cast<std::int64_t>(random() % 2),
                            .counter = random() % 4 == 0 ? newest - back : newest};
    ASSERT_EQ(duplicates.first_time(number), seen.insert(number).second) << "message " << i;
  }
}

TEST(Duplicates, RefuseWhatIsTooOldToTell) {
  Duplicates duplicates;
  constexpr std::uint64_t kNewest = 10'000;
  EXPECT_TRUE(duplicates.first_time({.counter = kNewest}));
  EXPECT_TRUE(duplicates.first_time({.counter = kNewest + 1 - Duplicates::kWindow}));
  EXPECT_FALSE(duplicates.first_time({.counter = kNewest - Duplicates::kWindow}));
  EXPECT_FALSE(duplicates.first_time({.counter = 0}));
}

TEST(Duplicates, SurviveTheLargestCounters) {
  Duplicates duplicates;
  constexpr std::uint64_t kLast = (std::uint64_t{1} << 63) - 1;
  EXPECT_TRUE(duplicates.first_time({.counter = 5}));
  EXPECT_TRUE(duplicates.first_time({.counter = kLast}));
  EXPECT_FALSE(duplicates.first_time({.counter = kLast}));
  EXPECT_TRUE(duplicates.first_time({.counter = kLast - 1}));
}

TEST(Duplicates, ForgetTheProcessThatWasSilentLongest) {
  Duplicates duplicates;
  const auto process = [](std::size_t epoch) {
    return TeamNumber{.sender = 1, .boot_epoch = static_cast<std::int64_t>(epoch), .counter = 0};
  };
  for (std::size_t epoch = 0; epoch < Duplicates::kMaxProcesses; ++epoch) {
    EXPECT_TRUE(duplicates.first_time(process(epoch)));
  }
  EXPECT_FALSE(duplicates.first_time(process(0))) << "heard again, so process 1 is the one to forget";
  EXPECT_TRUE(duplicates.first_time(process(1'000)));
  EXPECT_FALSE(duplicates.first_time(process(0)));
  EXPECT_TRUE(duplicates.first_time(process(1)));
}

}  // namespace
}  // namespace comptonaut
