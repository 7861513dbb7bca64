// SPDX-License-Identifier: BSD-3-Clause
// The command for people, from their files to the files it writes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/measured_field.h"
#include "report/reconstruction_files.h"
#include "report/recording_test.h"

namespace comptonaut {
namespace {

class Reconstruct : public Recording {
 protected:
  std::string reconstruct(const std::string& arguments) {
    return run("cd " + folder_.string() +
               " && timeout 120 " COMPTONAUT_BINARY_DIR "/bin/comptonaut reconstruct --config " +
               COMPTONAUT_SOURCE_DIR "/config/coordinator.yaml " + arguments);
  }
  std::filesystem::path log_ = write_measurements(measured_field(), folder_ / "field.lcm");
};

TEST_F(Reconstruct, ALogAndItsTwoCsvFilesHaveTheSameAnswer) {
  for (const std::string estimator : {"joint", "mlem"}) {
    const std::string options = " --grid 0:16:0:16:0.5 --estimator " + estimator;
    const std::string of_log = reconstruct(
        "field.lcm --cones-csv c.csv --viewpoints-csv v.csv --lambda l1.csv --sources s1.json --image i.svg" + options);
    ASSERT_EQ(exit_code_, 0) << of_log;
    const std::string of_csv = reconstruct("c.csv v.csv --lambda l2.csv --sources s2.json --image i.png" + options);
    ASSERT_EQ(exit_code_, 0) << of_csv;
    EXPECT_EQ(of_csv, of_log);
    const std::string map = bytes_of(folder_ / "l1.csv");
    EXPECT_TRUE(map.starts_with("x_m,y_m,z_m,lambda_Bq,sensitivity_s\n0.25,0.25,0,")) << map.substr(0, 80);
    EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 1 + 32 * 32);
    EXPECT_EQ(bytes_of(folder_ / "l2.csv"), map);
    EXPECT_EQ(bytes_of(folder_ / "s2.json"), bytes_of(folder_ / "s1.json"));
    EXPECT_NE(bytes_of(folder_ / "i.svg").find("<svg"), std::string::npos);
    EXPECT_TRUE(bytes_of(folder_ / "i.png").starts_with("\x89PNG"));
  }
}

TEST_F(Reconstruct, FindsBothSourcesAndSaysHowSureItIs) {
  const std::string said = reconstruct("field.lcm --sources s.json");
  ASSERT_EQ(exit_code_, 0) << said;
  EXPECT_NE(said.find("2 sources of Cs-137"), std::string::npos) << said;
  EXPECT_NE(said.find("converged after"), std::string::npos) << said;
  const auto answer = nlohmann::json::parse(bytes_of(folder_ / "s.json"));
  EXPECT_EQ(answer["estimator"], "joint");
  EXPECT_EQ(answer["converged"], true);
  ASSERT_EQ(answer["sources"].size(), 2u);
  const auto& strongest = answer["sources"][0];
  EXPECT_NEAR(strongest["x_m"].get<double>(), 11.6, 0.4);  // the field's pairs err otherwise than the shipped density
  EXPECT_NEAR(strongest["y_m"].get<double>(), 10.1, 0.4);
  EXPECT_LT(strongest["activity_95_low_Bq"], 4e9);
  EXPECT_GT(strongest["activity_95_high_Bq"], 4e9);
}

TEST_F(Reconstruct, HelpAnswers) {
  const std::string help = reconstruct("--help");
  EXPECT_EQ(exit_code_, 0);
  for (const char* word : {"x0:x1:y0:y1:cell", "--estimator", "--iterations", "--nuclide", "--lambda", "--sources",
                           "--image", "--z", "axis_x,axis_y,axis_z,beta_rad,weight", "live_s,singles"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
}

TEST_F(Reconstruct, WhatIsWrongIsOneLine) {
  write("empty", "");
  write("v.csv", "t_s,drone,x_m,y_m,z_m,qw,qx,qy,qz,live_s,singles\n1,1,0,0,2,0,1,0,0,1,5\n");
  write("c.csv", "t_s,drone,event,x_m,y_m,z_m,qw,qx,qy,qz,axis_x,axis_y,axis_z,beta_rad,weight\n");
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"", {"recording"}},
      {"nowhere.lcm", {"nowhere.lcm"}},
      {"empty", {"empty"}},
      {"v.csv", {"v.csv", "LCM log"}},
      {"v.csv c.csv", {"c.csv:1", "'event' is no column", "live_s,singles"}},
      {"c.csv v.csv v.csv", {"recording", "2"}},
      {"c.csv nowhere.csv", {"nowhere.csv"}},
      {"field.lcm --grid 0:16:0:16", {"--grid 0:16:0:16", "five numbers", "0:50:0:50:0.5"}},
      {"field.lcm --grid 0:16:0:16:x", {"--grid", "five numbers"}},
      {"field.lcm --grid 0:16:0:16:0.5:1", {"--grid", "five numbers"}},
      {"field.lcm --grid 16:0:0:16:1", {"x1 is not above x0"}},
      {"field.lcm --grid 0:16:0:nan:1", {"--grid"}},
      {"field.lcm --grid 0:16:0:16:0", {"0.01 at least"}},
      {"field.lcm --grid 0:0.1:0:16:1", {"no cell"}},
      {"field.lcm --grid 0:1e6:0:1e6:0.5", {"--grid", "the most"}},
      {"field.lcm --z 100", {"below the ground", "--z 100"}},
      {"field.lcm --estimator luck", {"luck"}},
      {"field.lcm --iterations 0", {"--iterations", "0"}},
      {"field.lcm --nuclide Xx-1", {"Xx-1", "xx-1.csv"}},
      {"field.lcm --nuclide Am-241", {"Am-241", "Cs-137"}},
      {"field.lcm --image map.gif", {"map.gif", ".png"}},
      {"field.lcm --lambda nowhere/l.csv", {"nowhere/l.csv"}},
  };
  for (const auto& [arguments, mentions] : cases) {
    const std::string said = reconstruct(arguments);
    EXPECT_EQ(exit_code_, 1) << arguments << ": " << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    for (const std::string& word : mentions) EXPECT_NE(said.find(word), said.npos) << arguments << ": " << said;
  }
}

TEST_F(Reconstruct, ANuclideWithoutPairsIsFoundBySinglesAlone) {
  std::vector<MeasurementBatch> batches = measured_field();
  for (MeasurementBatch& batch : batches) {
    batch.channels[1].nuclide = "Am-241";
    batch.cones.clear();
  }
  write_measurements(batches, folder_ / "am.lcm");
  const std::string said = reconstruct("am.lcm --nuclide Am-241 --image i.png");
  EXPECT_EQ(exit_code_, 0) << said;
  EXPECT_NE(said.find("sources of Am-241"), std::string::npos) << said;
}

TEST_F(Reconstruct, AQuietRecordingHasNoSource) {
  write("v.csv", "t_s,drone,x_m,y_m,z_m,qw,qx,qy,qz,live_s,singles\n1,1,-5,0,2,0,1,0,0,1,5\n2,1,5,0,2,0,1,0,0,1,4\n");
  write("c.csv", "t_s,drone,event,x_m,y_m,z_m,qw,qx,qy,qz,axis_x,axis_y,axis_z,beta_rad,weight\n");
  const std::string joint = reconstruct("c.csv v.csv --grid -20:20:-20:20:1 --lambda l.csv --image i.svg");
  EXPECT_EQ(exit_code_, 0) << joint;
  EXPECT_NE(joint.find("0 sources of Cs-137\n"), std::string::npos) << joint;
  const std::string mlem = reconstruct("c.csv v.csv --estimator mlem --image i.png");
  EXPECT_EQ(exit_code_, 0) << mlem;
  EXPECT_NE(mlem.find("0 maxima"), std::string::npos) << mlem;
}

TEST(ReconstructionFiles, IntervalsHoldNinetyFivePercent) {
  SourceEstimate source{.activity_Bq = 1e9};
  EXPECT_TRUE(std::isnan(interval_95(source).low_Bq));
  EXPECT_TRUE(std::isnan(ellipse_95(source).major_m));
  EXPECT_TRUE(std::isnan(ellipse_95(source).minor_m));
  source.activity_sigma_Bq = 1e7;
  EXPECT_NEAR(interval_95(source).high_Bq, 1e9 + 1.96e7, 3e5);
  EXPECT_NEAR(interval_95(source).low_Bq, 1e9 - 1.96e7, 3e5);
  source.position_sigma_m = {0.3, 0.1, 0.0};
  source.position_cov_xy_m2 = 0.015;
  const PositionEllipse ellipse = ellipse_95(source);
  Random random(5);
  int inside = 0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {  // Cholesky's factor of the covariance
    const double u = random.normal(), v = random.normal();
    const double x_m = 0.3 * u, y_m = 0.05 * u + std::sqrt(0.01 - 0.0025) * v;
    const double c = std::cos(ellipse.direction_rad), s = std::sin(ellipse.direction_rad);
    inside += std::hypot((c * x_m + s * y_m) / ellipse.major_m, (c * y_m - s * x_m) / ellipse.minor_m) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(inside / static_cast<double>(kDraws), 0.95, 0.006);
}

}  // namespace
}  // namespace comptonaut
