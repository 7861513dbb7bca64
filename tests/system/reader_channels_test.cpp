// SPDX-License-Identifier: BSD-3-Clause
// What the real detector-reader makes of standard input with a configuration of its own.
#include "system/command.h"
#include "system/live_reader.h"

namespace comptonaut {
namespace {

const std::string kNuclides = COMPTONAUT_SOURCE_DIR "/config/nuclides/";

/// A cluster of pixels in a row that share the energy.
std::string cluster(std::int64_t& index, int x, int y, double energy_keV, int pixels, double t_ns) {
  std::string rows;
  for (int i = 0; i < pixels; ++i) rows += t3pa_row(index++, make_hit(x + i, y, energy_keV / pixels, t_ns));
  return rows;
}

struct Output {
  std::vector<EventBatch> batches;
  Finished finished;
};

/// Runs it over the input, as --input and the shell name it, to its end.
Output run_reader_on(const std::string& input, const std::string& config) {
  const std::string url = loopback_url();
  Bus bus(url);
  Output output;
  bus.subscribe<EventBatch>("MAV1_EVENTS",
                            [&](const auto&, const EventBatch& batch) { output.batches.push_back(batch); });
  output.finished =
      run_command(std::string(COMPTONAUT_BINARY_DIR) + "/bin/comptonaut-detector-reader --mav 1 --lcm-url '" + url +
                  "' --config " + scratch_file("reader.yaml", config).string() + " --input " + input);
  while (bus.handle(100)) {
  }
  return output;
}
Output run_reader(const std::string& config, const std::string& text) {
  return run_reader_on("- < " + scratch_file("rows.t3pa", text).string(), config);
}

TEST(ReaderChannels, TwoNuclidesAreCountedApart) {
  const std::string config =
      "mission: 1\nnuclides:\n  - {file: " + kNuclides + "co-60.yaml}\n  - {file: " + kNuclides + "co-60-1332.yaml}\n";
  std::string text = kT3paHeader + "# start_utime_us 1700000000000000\n";
  std::int64_t index = 0;
  double t_ns = 0.0;
  const auto next_ns = [&] { return t_ns += 200e3; };
  for (int i = 0; i < 70; ++i) text += cluster(index, 100, i, 500.0, 3, next_ns());         // below both edges
  for (int i = 0; i < 30; ++i) text += cluster(index, 100, 100 + i, 1100.0, 6, next_ns());  // of the upper line alone
  for (int i = 0; i < 20; ++i) text += cluster(index, 100, 200 + i, 1700.0, 9, next_ns());  // of neither
  int y = 50;
  const auto pair = [&](double first_keV, double second_keV) {
    ++y;
    const double at_ns = next_ns();
    text += cluster(index, 50, y, first_keV, 4, at_ns) + cluster(index, 120, y, second_keV, 4, at_ns + 20.0);
  };
  for (int i = 0; i < 11; ++i) pair(600.0, 573.228);
  for (int i = 0; i < 7; ++i) pair(700.0, 632.492);
  for (int i = 0; i < 5; ++i) pair(750.0, 700.0);  // 1450 keV: of no line
  const Output output = run_reader(config, text);
  ASSERT_EQ(output.finished.exit_code, 0) << output.finished.output;
  ASSERT_FALSE(output.batches.empty());
  std::int64_t singles[2] = {}, pairs[2] = {}, others = 0;
  for (const EventBatch& batch : output.batches) {
    ASSERT_EQ(batch.channels.size(), 2u);
    EXPECT_EQ(batch.channels[0].nuclide, "Co-60");
    EXPECT_EQ(batch.channels[1].nuclide, "Co-60-1332");
    for (std::size_t c = 0; c < 2; ++c) {
      singles[c] += batch.channels[c].singles;
      pairs[c] += batch.channels[c].pairs;
    }
    others += batch.others;
    for (const PairEvent& p : batch.pairs) EXPECT_EQ(p.channel, p.e1_keV + p.e2_keV < 1250.0 ? 0 : 1);
  }
  EXPECT_EQ(singles[0], 70);
  EXPECT_EQ(singles[1], 30);
  EXPECT_EQ(pairs[0], 11);
  EXPECT_EQ(pairs[1], 7);
  EXPECT_EQ(others, 25);
}

TEST(ReaderChannels, KeepOutIsSaidOnceInTheJournal) {
  const std::string config = "mission: 1\nnuclides: [{file: " + kNuclides + "cs-137.yaml}]\n";
  std::string text = kT3paHeader + "# start_utime_us 1700000000000000\n";
  std::int64_t index = 0;
  const auto add = [&](double from_s, double to_s, double hits_s) {
    for (double t_s = from_s; t_s < to_s; t_s += 1.0 / hits_s) {
      text += cluster(index, static_cast<int>(index % 250), 100, 300.0, 1, 1e9 * t_s);
    }
  };
  add(0.00, 0.10, 0.1e6);
  add(0.10, 0.20, 1.9e6);
  add(0.20, 0.25, 1.4e6);  // between both edges
  add(0.25, 0.30, 1.9e6);
  add(0.30, 0.40, 0.1e6);
  const Output output = run_reader(config, text);
  ASSERT_EQ(output.finished.exit_code, 0) << output.finished.output;
  const std::string& said = output.finished.output;
  const std::string kLine = "<4>comptonaut-detector-reader: keep out";
  ASSERT_NE(said.find(kLine), std::string::npos) << said;
  EXPECT_EQ(said.find("keep out", said.find(kLine) + kLine.size()), std::string::npos) << "twice: " << said;
  EXPECT_NE(said.find("<4>comptonaut-detector-reader: no longer"), std::string::npos) << said;
}

TEST(ReaderHotPixels, AreToldInTheJournalOnceEachTime) {
  std::string text = kT3paHeader + "# start_utime_us 1700000000000000\n";
  std::int64_t index = 0;
  const auto fire = [&](double from_s) {
    for (int i = 0; i < 100; ++i) text += t3pa_row(index++, make_hit(200, 9, 300.0, 1e9 * from_s + 1e5 * i));
  };
  fire(1.0);
  for (int i = 0; i < 5600; ++i) text += t3pa_row(index++, make_hit_anywhere(i, 300.0, 2e9 + 5e6 * i));
  fire(31.0);
  for (int column = 0; column < 15; ++column) {
    const double from_ns = 32e9 + 1e8 * column;
    for (int i = 0; i < 30; ++i) text += t3pa_row(index++, make_hit(10 + 9 * column, 50, 300.0, from_ns + 1e5 * i));
  }
  text += t3pa_row(index++, make_hit_anywhere(1, 300.0, 36e9));
  const std::string config = "mission: 1\nnuclides:\n  - {file: " + kNuclides + "cs-137.yaml}\n";
  const Output output = run_reader(config, text);
  ASSERT_EQ(output.finished.exit_code, 0) << output.finished.output;
  const std::string& said = output.finished.output;
  const auto lines = [&](const std::string& line) {
    int count = 0;
    for (auto at = said.find(line); at != std::string::npos; at = said.find(line, at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(lines("pixel x 200, y 9 is hot, its hits are left out: 24 where 0.0 were expected"), 2) << said;
  EXPECT_EQ(lines("pixel x 200, y 9 is quiet again"), 1) << said;
  EXPECT_EQ(lines(" is hot"), 2 + 9) << said;
  EXPECT_EQ(lines("6 more pixels are hot"), 1) << said << "ten lines at a time";
}

TEST(ReaderPlayback, AClusterLogOfAShutterTellsItsUtcItself) {
  const std::string config = "mission: 1\nnuclides: [{file: " + kNuclides + "cs-137.yaml}]\ninput: {speed: 1000}\n";
  const auto play = [&](const std::string& frame) {
    return run_reader_on("file:" + scratch_file("r.clog", frame + "\n[1, 2, 300, 1e8]\n").string(), config);
  };
  const Output shutter = play("Frame 1 (1700000000.5, 20 s)");
  ASSERT_EQ(shutter.finished.exit_code, 0) << shutter.finished.output;
  ASSERT_EQ(shutter.batches.size(), 401u) << "20 s, and what begins with their end";
  EXPECT_EQ(shutter.batches[300].live_us, 50'000);
  EXPECT_EQ(shutter.batches.front().utime, 1'700'000'000'500'000);
  EXPECT_EQ(shutter.batches[2].channels[0].singles, 1);
  const Output without = play("Frame 1 (5000, 0 s)");
  EXPECT_EQ(without.finished.exit_code, 1);
  EXPECT_NE(without.finished.output.find("r.clog.info"), std::string::npos) << without.finished.output;
}

TEST(ReaderRefusedRows, AreToldInTheJournalOnceOfEachKindWithTheirLine) {
  std::string text = kT3paHeader + "# start_utime_us 1700000000000000\n";
  text += t3pa_row(0, make_hit(10, 10, 300.0, 1e6));
  text += "nonsense\n2\t70000\t99999\t9\t0\t0\nagain\n";
  text += t3pa_row(3, make_hit(20, 10, 300.0, 2e8));
  const Output output = run_reader("mission: 1\nnuclides: [{file: " + kNuclides + "cs-137.yaml}]\n", text);
  ASSERT_EQ(output.finished.exit_code, 0) << output.finished.output;
  EXPECT_EQ(output.finished.output,
            "<4>comptonaut-detector-reader: -:4: row refused: not six whole numbers; all such rows are counted as "
            "rows_not_six_numbers\n"
            "<4>comptonaut-detector-reader: -:5: row refused: pixel is not on the matrix of 256 x 256; all such rows "
            "are counted as rows_pixel_range\n");
}

}  // namespace
}  // namespace comptonaut
