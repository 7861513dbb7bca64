// SPDX-License-Identifier: BSD-3-Clause
#include "detector/t3pa.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/random.h"
#include "detector/make_hits.h"
#include "scratch.h"

namespace comptonaut {
namespace {

std::vector<StreamItem> items_of(const std::string& bytes, RowFaults* faults = nullptr) {
  return parse_all<T3paParser>(bytes, faults);
}

TEST(T3pa, AHitsTimeIsToALessFToA) {
  const auto items = items_of(kT3paHeader + "7\t38688\t6655\t42\t6\t0\n");
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].kind, StreamItem::Kind::kHeader);
  EXPECT_EQ(items[1].hit(), (Hit{.t = 16 * 6655 - 6, .pixel = 38688, .tot = 42}));
  EXPECT_EQ(items[1].index, 7u);
  EXPECT_EQ(pixel_x(38688), 32);
  EXPECT_EQ(pixel_y(38688), 151);
}

TEST(T3pa, TabsSpacesLineEndsAndACompleteLastLineAreAllRead) {
  for (const char* text : {"0\t5\t100\t9\t3\t0\n", "0 5  100 9 3 0\n", " 0 5 100 9 3 0 \r\n", "0\t5\t100\t9\t3\t0\r\n",
                           "0\t5\t100\t9\t3\t0", "\r\n\n0 5 100 9 3 0\n"}) {
    const auto items = items_of(text);
    ASSERT_EQ(items.size(), 1u) << text;
    EXPECT_EQ(items[0].hit(), (Hit{.t = 1597, .pixel = 5, .tot = 9})) << text;
  }
}

// A row with single blanks is read in a quicker way than one with more: what both say is the same, right or wrong.
TEST(T3pa, TheQuickWayReadsWhatTheGeneralOneDoes) {
  Random random(12);
  for (int trial = 0; trial < 20'000; ++trial) {
    std::string quick, general;
    const int numbers = random.uniform() < 0.9 ? 6 : static_cast<int>(random() % 9);
    for (int k = 0; k < numbers; ++k) {
      std::string number = std::to_string(random() >> (random() % 64));
      if (random.uniform() < 0.02) number += number + number;
      if (random.uniform() < 0.02) number.insert(number.size() / 2, 1, static_cast<char>(33 + random() % 90));
      quick += (k > 0 ? "\t" : "") + number;
      general += (k > 0 ? " \t" : "") + number;
    }
    RowFaults quick_faults, general_faults;
    const auto quick_items = items_of(quick + "\n", &quick_faults);
    const auto general_items = items_of(general + "\n", &general_faults);
    EXPECT_EQ(quick_faults.count, general_faults.count) << quick;
    ASSERT_EQ(quick_items.size(), general_items.size()) << quick;
    for (std::size_t i = 0; i < quick_items.size(); ++i) {
      EXPECT_EQ(quick_items[i].hit(), general_items[i].hit()) << quick;
      EXPECT_EQ(quick_items[i].index, general_items[i].index) << quick;
    }
  }
}

TEST(T3pa, EachFaultIsCountedByKindWithItsLine) {
  const std::vector<std::pair<std::string, RowFault>> planted = {{"1 5 100 9 3", RowFault::kNotSixNumbers},
                                                                 {"1 5 100 9 3 0 7", RowFault::kNotSixNumbers},
                                                                 {"1 5 1x0 9 3 0", RowFault::kNotSixNumbers},
                                                                 {"1 -5 100 9 3 0", RowFault::kNotSixNumbers},
                                                                 {"garbage", RowFault::kNotSixNumbers},
                                                                 {"1 5 1\xC3\xA9 9 3 0", RowFault::kNonAscii},
                                                                 {std::string(400, '1'), RowFault::kTooLong},
                                                                 {"1 65536 100 9 3 0", RowFault::kPixel},
                                                                 {"1 5 999999999999999999999 9 3 0", RowFault::kToA},
                                                                 {"1 5 100 9 32 0", RowFault::kFToA},
                                                                 {"1 5 100 1024 3 0", RowFault::kToT},
                                                                 {"1 5 100 0 3 0", RowFault::kZeroToT},
                                                                 {"1 5 100 9 3 1", RowFault::kMarker},
                                                                 {"1 5 100 9 3 2", RowFault::kMarker},
                                                                 {"# alive soon", RowFault::kMarker}};
  for (const auto& [row, fault] : planted) {
    RowFaults faults;
    const auto items = items_of("0 5 100 9 3 0\n" + row + "\n2 6 100 9 3 0\n", &faults);
    EXPECT_EQ(count_of(StreamItem::Kind::kHit, items), 2) << row;
    EXPECT_EQ(count_of(StreamItem::Kind::kLostHit, items), faults.hits_lost()) << row;
    EXPECT_EQ(faults.total(), 1) << row;
    EXPECT_EQ(faults.of(fault), 1) << row;
    EXPECT_EQ(faults.first_line[static_cast<std::size_t>(fault)], 2) << row;
  }
}

TEST(T3pa, ALastLineThatIsCutShortIsNoHit) {
  RowFaults faults;
  EXPECT_EQ(count_of(StreamItem::Kind::kHit, items_of("0 5 100 9 3 0\n1 6 10", &faults)), 1);
  EXPECT_EQ(faults.of(RowFault::kCutShort), 1);
  EXPECT_EQ(faults.total(), 1);
}

TEST(T3pa, StreamCommentsAndGapsAreRead) {
  const auto items =
      items_of("# start_utime_us 1700000000000000\n# alive 4000\n# anything\n0 116 50 0 0 1\n1 117 800 0 0 1\n");
  ASSERT_EQ(items.size(), 4u);
  EXPECT_EQ(items[0].kind, StreamItem::Kind::kStart);
  EXPECT_EQ(items[0].value, 1'700'000'000'000'000);
  EXPECT_EQ(items[1].kind, StreamItem::Kind::kAlive);
  EXPECT_EQ(items[1].value, 16 * 4000);
  EXPECT_EQ(items[2].kind, StreamItem::Kind::kLostBegin);
  EXPECT_EQ(items[3].kind, StreamItem::Kind::kLostEnd);
  EXPECT_EQ(items[3].value, 16 * 800);
}

void expect_same_however_cut(const std::string& text) {
  RowFaults whole_faults;
  const auto whole = items_of(text, &whole_faults);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    T3paParser parser;
    std::size_t count = parser.parse(std::span(text).first(cut)).size();
    count += parser.parse(std::span(text).subspan(cut)).size();
    count += parser.end().size();
    EXPECT_EQ(count, whole.size()) << "cut at " << cut;
    EXPECT_EQ(parser.faults().count, whole_faults.count) << "cut at " << cut;
    EXPECT_EQ(parser.faults().first_line, whole_faults.first_line) << "cut at " << cut;
  }
}

TEST(T3pa, AnyCutOfTheTextGivesTheSameItems) {
  const std::string text = kT3paHeader + "0 5 100 9 3 0\r\nbad\n# alive 4000\n" + std::string(300, '7') +
                           "\n1\t6\t200\t10\t4\t0\n2 7 300 11 5 0";
  ASSERT_EQ(items_of(text).size(), 7u);
  expect_same_however_cut(text);
}

// With blanks before the row and CRLF after it.
TEST(T3pa, TheLongestLineIsARowAndALongerOneIsNoneHoweverCut) {
  for (const std::size_t size : {255, 256, 257, 258, 300}) {
    const std::string row = "0 5 100 9 3 0";
    const std::string text = std::string(size - row.size(), ' ') + row + "\r\n1 6 200 10 4 0\n";
    RowFaults faults;
    EXPECT_EQ(count_of(StreamItem::Kind::kHit, items_of(text, &faults)), size <= 256 ? 2 : 1) << size;
    EXPECT_EQ(faults.of(RowFault::kTooLong), size <= 256 ? 0 : 1) << size;
    expect_same_however_cut(text);
  }
}

TEST(T3pa, RandomBytesNeitherThrowNorPassForHits) {
  Random random(99);
  T3paParser parser;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bytes(200, '\0');
    for (char& c : bytes) c = static_cast<char>(random() & 0xff);
    EXPECT_EQ(count_of(StreamItem::Kind::kHit, parser.parse(bytes)), 0) << "trial " << trial;
  }
}

std::optional<T3paInfo> info_of(const std::string& text) {
  const auto recording = scratch_file("a.t3pa");
  scratch_file("a.t3pa.info", text);
  return read_t3pa_info(recording);
}

TEST(T3paInfo, HoldsTheStartTimeAndTheChip) {
  const auto info = info_of(
      "[FileInfo]\r\n\"ChipboardID\" (\"Chipboard ID\"):\r\nchar[9]\r\nJ09-W0139\r\n\r\n"
      "\"Start time\" (\"Acquisition start time\"):\r\ndouble[1]\r\n1759481716.827246 \r\n");
  ASSERT_TRUE(info && info->start_utime);
  EXPECT_EQ(*info->start_utime, 1'759'481'716'827'246);
  EXPECT_EQ(info->chip, "J09-W0139");
  EXPECT_FALSE(info_of("nothing")->start_utime);
  EXPECT_THROW(info_of("\"Start time\"\ndouble[1]\nyesterday\n"), std::runtime_error);
  EXPECT_FALSE(read_t3pa_info("/nowhere/at.t3pa"));
}

}  // namespace
}  // namespace comptonaut
