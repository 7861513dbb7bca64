// SPDX-License-Identifier: BSD-3-Clause
#include "detector/clog.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/random.h"
#include "detector/hit_stream.h"
#include "detector/make_hits.h"

namespace comptonaut {
namespace {

using Kind = StreamItem::Kind;

std::vector<StreamItem> items_of(const std::string& bytes, RowFaults* faults = nullptr) {
  return parse_all<ClogParser>(bytes, faults);
}

TEST(Clog, PixelsAreHitsWithTheirEnergyAfterTheFramesStart) {
  const auto items =
      items_of("Frame 2 (273697060.937500, 0.000000 s)\n[214, 195, 43.1598, 0] [220, 191, 20.65, 7.8125]\n");
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].hit(), (Hit{.t = 175'166'119, .pixel = pixel_at(214, 195), .energy_keV = 43.1598F}));
  EXPECT_EQ(items[1].hit(), (Hit{.t = 175'166'124, .pixel = pixel_at(220, 191), .energy_keV = 20.65F}));
  EXPECT_EQ(items[1].line, 2u);
}

TEST(Clog, TabsSpacesLineEndsAndACompleteLastLineAreAllRead) {
  for (const char* text : {"Frame 1 (1000, 0 s)\n[1, 2, 30.5, 25]\n", "Frame 1 (1000.0, 0.0 s)\r\n[1, 2, 30.5, 25]\r\n",
                           "Frame\t1\t( 1000 ,0 s )\n\t[1,2,30.5,25]",
                           "\xEF\xBB\xBF"
                           "Frame 1 (1e3, 0s)\n\n[ 1 , 2 , 30.5 , 25 ] \n"}) {
    const auto items = items_of(text);
    ASSERT_EQ(items.size(), 1u) << text;
    EXPECT_EQ(items[0].hit(), (Hit{.t = 656, .pixel = pixel_at(1, 2), .energy_keV = 30.5F})) << text;
  }
}

TEST(Clog, NumbersAreReadAsTheStandardLibraryReadsThem) {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const int decimals = static_cast<int>(random.uniform(0.0, 16.0));
    const std::string energy = fmt::format("{:.{}f}", std::pow(10.0, random.uniform(-2.0, 5.9)), decimals);
    const double toa_ns = random.uniform(0.0, 1e12);
    const std::string toa =
        i % 5 == 0 ? fmt::format("{:.{}e}", toa_ns, decimals) : fmt::format("{:.{}f}", toa_ns, decimals);
    if (std::stod(energy) == 0.0) continue;
    const auto items = items_of(fmt::format("Frame 1 (0, 0 s)\n[1, 2, {}, {}]\n", energy, toa));
    ASSERT_EQ(items.size(), 1u) << energy << " " << toa;
    EXPECT_EQ(items[0].energy_keV, static_cast<float>(std::stod(energy))) << energy;
    EXPECT_EQ(items[0].value, std::llround(std::stod(toa) / kChipTime_ns)) << toa;
  }
}

TEST(Clog, EachFaultIsCountedByKindWithItsLine) {
  const std::vector<std::pair<std::string, RowFault>> planted = {{"[1, 2, 30, 25", RowFault::kNotACluster},
                                                                 {"[1, 2, 30]", RowFault::kNotACluster},
                                                                 {"[1, 2, 30, 25, 4]", RowFault::kNotACluster},
                                                                 {"1 2 30 25", RowFault::kNotACluster},
                                                                 {"[1, 2, nan, 25]", RowFault::kNotACluster},
                                                                 {"\x01\xff", RowFault::kNotACluster},
                                                                 {"[256, 2, 30, 25]", RowFault::kPixel},
                                                                 {"[1, -1, 30, 25]", RowFault::kPixel},
                                                                 {"[1.5, 2, 30, 25]", RowFault::kPixel},
                                                                 {"[1, 2, 0, 25]", RowFault::kEnergy},
                                                                 {"[1, 2, -3, 25]", RowFault::kEnergy},
                                                                 {"[1, 2, 1e9, 25]", RowFault::kEnergy},
                                                                 {"[1, 2, 30, 1e18]", RowFault::kToA},
                                                                 {"[1, 2, 30, -2000]", RowFault::kToA},
                                                                 {"[1, 2, 30, 25] [1, 3, 0, 25]", RowFault::kEnergy}};
  for (const auto& [line, fault] : planted) {
    RowFaults faults;
    const auto items = items_of("Frame 1 (1000, 0 s)\n[1, 2, 30, 25]\n" + line + "\n[1, 2, 30, 25]\n", &faults);
    EXPECT_EQ(count_of(StreamItem::Kind::kHit, items), 2) << line;
    EXPECT_EQ(count_of(StreamItem::Kind::kLostHit, items), faults.hits_lost()) << line;
    EXPECT_EQ(faults.total(), 1) << line;
    EXPECT_EQ(faults.of(fault), 1) << line << ": " << describe(fault);
    EXPECT_EQ(faults.first_line[static_cast<std::size_t>(fault)], 3) << line;
  }
}

TEST(Clog, ClustersOfAFrameThatCannotBeReadAreLeftOut) {
  for (const char* frame : {"Frame 1 (1000)", "Frame 1 (-5, 0 s)", "Frame 1 (1e30, 0 s)", "Frame", ""}) {
    RowFaults faults;
    const auto items = items_of(std::string(frame) + "\n[1, 2, 30, 25]\n", &faults);
    EXPECT_EQ(count_of(StreamItem::Kind::kHit, items), 0) << frame;
    EXPECT_EQ(faults.of(RowFault::kNoFrame), 1) << frame;
  }
}

TEST(Clog, ALastLineThatIsCutShortIsNoCluster) {
  RowFaults faults;
  const auto items = items_of("Frame 1 (1000, 0 s)\n[1, 2, 30, 25]\n[1, 2, 3", &faults);
  EXPECT_EQ(count_of(StreamItem::Kind::kHit, items), 1);
  EXPECT_EQ(faults.of(RowFault::kCutShort), 1);
  EXPECT_EQ(faults.total(), 1);
}

struct Shuttered {
  std::vector<Hit> hits;
  std::optional<Utime> start_utime;
  double live_s = 0.0;
  RowFaults faults;
};

Shuttered read_shuttered(const std::string& text) {
  HitStream stream({}, 150, true, HitFormat::kClog);
  Shuttered read;
  const auto drain = [&] {
    while (const auto part = stream.next()) {
      read.hits.insert(read.hits.end(), part->hits.begin(), part->hits.end());
      read.start_utime = stream.start_utime();
      read.live_s = 1e-9 * kChipTime_ns * static_cast<double>(stream.life().live(0, part->until));
    }
  };
  stream.feed(text);
  drain();
  stream.end();
  drain();
  read.faults = stream.counts().faults;
  return read;
}

TEST(Clog, FramesOfAShutterTellUtcAndWhenTheDetectorWasBlind) {
  const Shuttered read = read_shuttered(
      "Frame 1 (1700000000.5, 0.1 s)\n[1, 2, 30, 1000]\nFrame 2 (1700000000.8, 0.2 s)\n[1, 2, 30, 2000]\n");
  ASSERT_EQ(read.hits.size(), 2u);
  EXPECT_EQ(read.hits[0].t, 640);
  EXPECT_NEAR(static_cast<double>(read.hits[1].t) * kChipTime_ns, 0.3e9 + 2000.0, 200.0)
      << "a double holds Unix time to 0.2 us";
  EXPECT_EQ(read.start_utime, Utime{1'700'000'000'500'000});
  EXPECT_NEAR(read.live_s, 0.3, 1e-6);
  EXPECT_EQ(read.faults.total(), 0);
}

TEST(Clog, LongFramesAndLongPausesBetweenFramesAreBelieved) {
  const auto frames = [](double length_s, double hit_s) {
    std::string text;
    for (int i = 0; i < 10; ++i) {
      text += "Frame " + std::to_string(i + 1) + " (" + std::to_string(1'700'000'000 + 60 * i) + ", " +
              std::to_string(length_s) + " s)\n[1, 2, 30, " + std::to_string(1e9 * hit_s) + "]\n";
    }
    return text;
  };
  for (const double length_s : {3.0, 60.0}) {
    const Shuttered read = read_shuttered(frames(length_s, 0.5 * length_s));
    EXPECT_EQ(read.hits.size(), 10u) << length_s;
    EXPECT_EQ(read.faults.total(), 0) << length_s;
    EXPECT_NEAR(read.live_s, 10.0 * length_s, 1e-3) << length_s;
  }
  EXPECT_NEAR(read_shuttered("Frame 1 (1700000000, 3600 s)\n[1, 2, 30, 1e9]\n").live_s, 301.0, 1e-3)
      << "nothing vouches for an hour without a hit";
}

TEST(Clog, AnyCutOfTheTextGivesTheSameItems) {
  const std::string text =
      "Frame 1 (1000, 0 s)\r\n[1, 2, 30, 25] [2, 2, 31, 25]\nbad\nFrame 2 (9000, 0.5 s)\n[3, 4, 5, 6]";
  RowFaults whole_faults;
  const auto whole = items_of(text, &whole_faults);
  ASSERT_EQ(whole.size(), 7u);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    ClogParser parser;
    std::size_t count = parser.parse(std::span(text).first(cut)).size();
    count += parser.parse(std::span(text).subspan(cut)).size();
    count += parser.end().size();
    EXPECT_EQ(count, whole.size()) << "cut at " << cut;
    EXPECT_EQ(parser.faults().first_line, whole_faults.first_line) << "cut at " << cut;
  }
}

TEST(Clog, ALineThatNeverEndsTakesNoMoreMemoryThanTheLongest) {
  ClogParser parser;
  const std::string piece(100'000, '[');
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(parser.parse(piece).empty());
  (void)parser.parse(std::string("\n"));
  EXPECT_EQ(parser.faults().of(RowFault::kTooLong), 1);
}

}  // namespace
}  // namespace comptonaut
