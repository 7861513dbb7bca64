// SPDX-License-Identifier: BSD-3-Clause
#include "detector/t3p.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "detector/make_hits.h"

namespace comptonaut {
namespace {

std::vector<StreamItem> items_of(const std::string& bytes, RowFaults* faults = nullptr) {
  return parse_all<T3pParser>(bytes, faults);
}

TEST(T3p, BytesMeanWhatTheColumnsOfT3paMean) {
  // 38688 = 0x9720, ToA 6655 = 0x19ff, no overflow, FToA 6, ToT 42
  const std::string record("\x20\x97\0\0\xff\x19\0\0\0\0\0\0\0\x06\x2a\0", 16);
  ASSERT_EQ(record, t3p_record(38688, 6655, 0, 6, 42));
  const auto items = items_of(record);
  ASSERT_EQ(items.size(), 1u);
  EXPECT_EQ(items[0].hit(), (Hit{.t = 16 * 6655 - 6, .pixel = 38688, .tot = 42}));
  EXPECT_EQ(items[0].line, 1u);
}

TEST(T3p, EachFaultIsCountedByKindWithItsRecord) {
  const std::vector<std::pair<std::string, RowFault>> planted = {
      {t3p_record(65536, 100, 0, 3, 9), RowFault::kPixel},
      {t3p_record(5, std::uint64_t{1} << 63, 0, 3, 9), RowFault::kToA},
      {t3p_record(5, ~std::uint64_t{0}, 0, 3, 9), RowFault::kToA},
      {t3p_record(5, 100, 0, 32, 9), RowFault::kFToA},
      {t3p_record(5, 100, 0, 3, 1024), RowFault::kToT},
      {t3p_record(5, 100, 0, 3, 0), RowFault::kZeroToT},
      {t3p_record(5, 100, 1, 3, 9), RowFault::kMarker},
      {t3p_record(0x74, 100, 2, 0, 0), RowFault::kMarker}};
  for (const auto& [record, fault] : planted) {
    RowFaults faults;
    const std::string right = t3p_record(5, 100, 0, 3, 9);
    const auto items = items_of(right + record + right, &faults);
    EXPECT_EQ(count_of(StreamItem::Kind::kHit, items), 2) << describe(fault);
    EXPECT_EQ(count_of(StreamItem::Kind::kLostHit, items), faults.hits_lost()) << describe(fault);
    EXPECT_EQ(faults.total(), 1) << describe(fault);
    EXPECT_EQ(faults.of(fault), 1) << describe(fault);
    EXPECT_EQ(faults.first_line[static_cast<std::size_t>(fault)], 2) << describe(fault);
  }
}

TEST(T3p, GapsAreRead) {
  const auto items = items_of(t3p_record(0x74, 50, 1, 0, 0) + t3p_record(0x75, 800, 1, 0, 0));
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].kind, StreamItem::Kind::kLostBegin);
  EXPECT_EQ(items[1].kind, StreamItem::Kind::kLostEnd);
  EXPECT_EQ(items[1].value, 16 * 800);
}

TEST(T3p, AnyCutGivesTheSameItemsAndAPartOfARecordIsCutShort) {
  const std::string data = t3p_record(5, 100, 0, 3, 9) + t3p_record(6, 100, 0, 3, 0) + t3p_record(7, 200, 0, 3, 9);
  for (std::size_t size = 0; size <= data.size(); ++size) {
    RowFaults whole;
    const auto expected = items_of(data.substr(0, size), &whole);
    EXPECT_EQ(whole.of(RowFault::kCutShort), size % 16 == 0 ? 0 : 1) << size;
    for (std::size_t cut = 0; cut <= size; ++cut) {
      T3pParser parser;
      std::size_t count = parser.parse(std::span(data).first(cut)).size();
      count += parser.parse(std::span(data).subspan(cut, size - cut)).size();
      count += parser.end().size();
      EXPECT_EQ(count, expected.size()) << size << " bytes cut at " << cut;
      EXPECT_EQ(parser.faults().first_line, whole.first_line) << size << " bytes cut at " << cut;
    }
  }
}

TEST(T3p, RandomBytesNeverThrow) {
  Random random(98);
  T3pParser parser;
  std::int64_t bytes = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string data(random() % 100, '\0');
    for (char& c : data) c = static_cast<char>(random() & 0xff);
    (void)parser.parse(data);
    bytes += std::ssize(data);
  }
  EXPECT_EQ(parser.rows(), bytes / 16);
}

}  // namespace
}  // namespace comptonaut
