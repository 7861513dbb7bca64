// SPDX-License-Identifier: BSD-3-Clause
#include "team/trailer.h"

#include <gtest/gtest.h>

namespace comptonaut {
namespace {

using Bytes = std::vector<std::uint8_t>;
const TeamNumber kNumber{.sender = 3, .boot_epoch = 1'700'000'000'000'000, .counter = 0x0102030405060708};

TEST(Trailer, GivesBackMessageAndNumber) {
  for (const Bytes& message : {Bytes{}, Bytes{1}, Bytes(1100, 9)}) {
    Bytes bytes = message;
    append_trailer(bytes, kNumber);
    EXPECT_EQ(bytes.size(), message.size() + kTrailerBytes);
    const auto numbered = split_trailer(bytes);
    ASSERT_TRUE(numbered) << message.size();
    EXPECT_EQ(numbered->number, kNumber);
    EXPECT_EQ(Bytes(numbered->message.begin(), numbered->message.end()), message);
  }
}

TEST(Trailer, StaysWhereItIsForThoseWhoReadItLater) {
  Bytes bytes;
  append_trailer(bytes, kNumber);
  const Bytes head = {0, 0, 0, 3, 0, 6, 0x0a, 0x24, 0x18, 0x1e, 0x40, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 20), head);
  EXPECT_EQ(Bytes(bytes.begin() + 20, bytes.begin() + 56), Bytes(36, 0)) << "key id and tag";
  EXPECT_EQ(Bytes(bytes.begin() + 56, bytes.end()), (Bytes{1, 0, 0, 0, 'C', 'N', 'T', 'T'}));
}

TEST(Trailer, RefusesOthers) {
  Bytes bytes = {1, 2, 3};
  append_trailer(bytes, kNumber);
  EXPECT_FALSE(split_trailer(Bytes(bytes.begin() + 4, bytes.end()))) << "too short";
  EXPECT_FALSE(split_trailer(Bytes(200, 0))) << "no trailer";
  for (std::size_t i = 20; i < kTrailerBytes; ++i) {
    Bytes spoiled = bytes;
    spoiled[3 + i] ^= 1;
    EXPECT_FALSE(split_trailer(spoiled)) << "byte " << i << " of the trailer";
  }
  for (const TeamNumber& number : {TeamNumber{.sender = -1}, TeamNumber{.sender = 251}, TeamNumber{.boot_epoch = -1},
                                   TeamNumber{.counter = std::uint64_t{1} << 63}}) {
    Bytes impossible;
    append_trailer(impossible, number);
    EXPECT_FALSE(split_trailer(impossible)) << number.sender << " " << number.boot_epoch << " " << number.counter;
  }
}

}  // namespace
}  // namespace comptonaut
