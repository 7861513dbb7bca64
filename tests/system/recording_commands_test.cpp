// SPDX-License-Identifier: BSD-3-Clause
// comptonaut detect and spectrum on recordings whose content is known.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "core/random.h"
#include "detector/make_hits.h"
#include "scratch.h"
#include "system/command.h"
#include "system/write_calibration.h"

namespace comptonaut {
namespace {

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string row(std::int64_t index, int x, int y, int keV, double t_us) {
  return t3pa_row(index,
                  {.t = chip_time_ns(1e3 * t_us), .pixel = pixel_at(x, y), .tot = static_cast<std::uint16_t>(keV)});
}

class RecordingCommands : public testing::Test {
 protected:
  void SetUp() override { write_calibration(); }

  /// Runs a subcommand on the recording.
  Finished run(const std::string& subcommand, const std::string& text, const std::string& options) {
    const auto file = scratch_file("recording.t3pa", text);
    return run_command(std::string(COMPTONAUT_BINARY_DIR) + "/bin/comptonaut " + subcommand + " " + file.string() +
                       " --calibration " + scratch_folder().string() + " " + options);
  }
  static std::string in_scratch(const std::string& name) { return scratch_file(name).string(); }
};

/// 400 clusters of 60 keV, 30 pairs of 100 and 200 keV far apart, 20 such side by side in time but 10 pixels apart.
std::string known_text() {
  std::string text = kT3paHeader;
  std::int64_t index = 0;
  double t_us = 100.0;
  const auto add = [&](int x, int y, int keV, double later_us) { text += row(index++, x, y, keV, t_us + later_us); };
  for (int i = 0; i < 400; ++i, t_us += 100.0) add(3 + i % 240, 3 + 7 * i % 240, 60, 0.0);
  for (int i = 0; i < 50; ++i, t_us += 100.0) {
    add(20, 5 * i, 100, 0.0);
    add(i < 30 ? 120 : 30, 5 * i, 200, 0.02);
  }
  return text;
}

TEST_F(RecordingCommands, SpectrumCountsClustersAndPairSumsInTheirBins) {
  const Finished finished =
      run("spectrum", known_text(),
          "--bin-keV 10 --max-keV 400 --csv " + in_scratch("s.csv") + " --image " + in_scratch("s.png"));
  ASSERT_EQ(finished.exit_code, 0) << finished.output;
  std::map<std::pair<double, double>, std::pair<int, int>> bins;
  std::istringstream csv(read_file(scratch_file("s.csv")));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "from_keV,to_keV,clusters,pair_sums");
  for (double from, to, clusters, pairs; std::getline(csv, line);) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &from, &to, &clusters, &pairs), 4) << line;
    bins[{from, to}] = {clusters, pairs};
  }
  ASSERT_EQ(bins.size(), 40u);
  for (const auto& [edges, counts] : bins) {
    const double from = edges.first;
    EXPECT_EQ(counts.first, from == 60 ? 400 : from == 100 || from == 200 ? 50 : 0) << from;
    EXPECT_EQ(counts.second, from == 300 ? 30 : 0) << from;
  }
  EXPECT_EQ(read_file(scratch_file("s.png")).substr(1, 3), "PNG");
  ASSERT_EQ(run("spectrum", known_text(), "--image " + in_scratch("s.svg")).exit_code, 0);
  EXPECT_NE(read_file(scratch_file("s.svg")).find("<svg"), std::string::npos);
}

TEST_F(RecordingCommands, TheDetectorMayBeConfigured) {
  const std::string config = scratch_file("detector.yaml",
                                          "mission: 1\n"
                                          "calibration: " +
                                              scratch_folder().string() +
                                              "\n"
                                              "events: {pair_distance_min_px: 5}\n"
                                              "nuclides: [{file: " COMPTONAUT_SOURCE_DIR
                                              "/config/nuclides/am-241.yaml}]\n"
                                              "input: {speed: 2}\n")
                                 .string();
  const auto file = scratch_file("recording.t3pa", known_text()).string();
  const std::string program = std::string(COMPTONAUT_BINARY_DIR) + "/bin/comptonaut ";
  const Finished spectrum = run_command(program + "spectrum " + file + " --config " + config);
  EXPECT_NE(spectrum.output.find(" 50 pairs"), std::string::npos)
      << "10 pixels are far enough here: " << spectrum.output;
  const Finished detect = run_command(program + "detect " + file + " --config " + config);
  EXPECT_NE(detect.output.find("of Am-241"), std::string::npos) << detect.output;
  EXPECT_EQ(detect.output.find("of Cs-137"), std::string::npos) << detect.output;
  const Finished neither = run_command(program + "detect " + file);
  EXPECT_EQ(neither.exit_code, 1);
  EXPECT_NE(neither.output.find("--calibration"), std::string::npos) << neither.output;
}

TEST_F(RecordingCommands, DetectFindsTheHotPixelsAndDrawsThem) {
  std::string text = kT3paHeader;
  std::int64_t index = 0;
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const int x = static_cast<int>(random.uniform(0.0, 256.0)), y = static_cast<int>(random.uniform(0.0, 256.0));
    text += row(index++, x, y, 60, 100.0 * (i + 1));
  }
  std::string hot = text;
  for (int i = 0; i < 500; ++i) {
    hot += row(index++, 200, 100, 5, 2e6 + 100.0 * (i + 1));
    hot += row(index++, 201, 100, 5, 2e6 + 100.0 * (i + 1) + 50.0);  // two side by side
  }
  const Finished clean = run("detect", text, "");
  EXPECT_NE(clean.output.find(" 0 hot\n"), std::string::npos) << clean.output;
  const Finished finished = run("detect", hot, "--image " + in_scratch("hits.png"));
  ASSERT_EQ(finished.exit_code, 0) << finished.output;
  EXPECT_NE(finished.output.find(" 2 hot"), std::string::npos) << finished.output;
  for (const char* line : {" 47[78]  x 200, y 100\n", " 47[78]  x 201, y 100\n"}) {
    EXPECT_TRUE(std::regex_search(finished.output, std::regex(line))) << line << finished.output;
  }
  EXPECT_EQ(read_file(scratch_file("hits.png")).substr(1, 3), "PNG");
}

TEST_F(RecordingCommands, SayWhichRowsTheyRefusedAndWhere) {
  const std::string text =
      kT3paHeader + row(0, 1, 1, 60, 100) + "nonsense\n" + "2\t70000\t9\t9\t0\t0\n" + row(3, 1, 1, 60, 900);
  for (const std::string command : {"detect", "spectrum"}) {
    const Finished finished = run(command, text, "");
    ASSERT_EQ(finished.exit_code, 0) << finished.output;
    EXPECT_NE(finished.output.find("recording.t3pa:3"), std::string::npos) << finished.output;
    EXPECT_NE(finished.output.find("recording.t3pa:4"), std::string::npos) << finished.output;
  }
  EXPECT_NE(run("detect", text, "").output.find("of them 2 refused"), std::string::npos);
}

TEST_F(RecordingCommands, EveryShippedNuclideIsKnownByItsNameInLettersOfAnySize) {
  for (const std::string name :
       {"Cs-137", "co-60", "CO-60-1332", "Ir-192", "Ir-192-468", "Ba-133", "I-131", "Am-241"}) {
    const Finished finished = run("detect", known_text(), "--nuclide " + name);
    EXPECT_EQ(finished.exit_code, 0) << finished.output;
  }
  const Finished two = run("detect", known_text(), "--nuclide Co-60 --nuclide Co-60-1332");
  EXPECT_NE(two.output.find("/s of Co-60\n"), std::string::npos) << two.output;
  EXPECT_NE(two.output.find("/s of Co-60-1332\n"), std::string::npos) << two.output;
  const Finished overlap = run("detect", known_text(), "--nuclide Co-60 --nuclide Cs-137");
  EXPECT_EQ(overlap.exit_code, 1) << overlap.output;
  EXPECT_NE(overlap.output.find("Cs-137"), std::string::npos) << overlap.output;
}

}  // namespace
}  // namespace comptonaut
