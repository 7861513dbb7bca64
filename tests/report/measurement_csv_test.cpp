// SPDX-License-Identifier: BSD-3-Clause
#include "report/measurement_csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/measured_field.h"
#include "report/recorded_measurements.h"
#include "scratch.h"

namespace comptonaut {
namespace {

constexpr const char* kNuclide = "Cs-137";
const std::string kConeHeader = std::string(kConeColumns) + "\n";
const std::string kViewpointHeader = std::string(kViewpointColumns) + "\n";
const std::string kCone = "10.5,1,3,1,2,2,0,1,0,0,0,0,-1,0.5,0.6\n";
const std::string kOther = "10.5,1,3,1,2,2,0,1,0,0,0,0,1,0.7,0.4\n";
const std::string kViewpoint = "10.5,1,1,2,2,0,1,0,0,0.05,7\n";

std::vector<MeasurementBatch> cones(const std::string& rows) {
  return read_cones_csv(scratch_file("cones.csv", kConeHeader + rows), kNuclide);
}
std::vector<MeasurementBatch> viewpoints(const std::string& rows) {
  return read_viewpoints_csv(scratch_file("viewpoints.csv", kViewpointHeader + rows), kNuclide);
}

template <class Read>
std::string complaint(const Read& read) {
  try {
    (void)read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing is wrong";
}

std::string replaced(std::string row, const std::string& what, const std::string& by) {
  return row.replace(row.find(what), what.size(), by);
}

TEST(MeasurementCsv, RowsOfOneEventAreTheHypothesesOfOnePhoton) {
  const auto photons = cones(kCone + "11,2,3,1,2,2,0,1,0,0,0,0,-1,0.5,1\n" + kOther);
  ASSERT_EQ(photons.size(), 2u) << "events of another drone have numbers of their own";
  ASSERT_EQ(photons[0].cones.size(), 2u);
  EXPECT_EQ(photons[0].key.sender, 1);
  EXPECT_EQ(photons[0].utime, 10'500'000);
  EXPECT_EQ(photons[0].live_us, 0);
  EXPECT_EQ(photons[0].cones[1].axis_W, Eigen::Vector3d(0, 0, 1));
  EXPECT_DOUBLE_EQ(photons[0].cones[1].cos_beta, std::cos(0.7));
  EXPECT_EQ(photons[0].cones[1].p_WS, Eigen::Vector3d(1, 2, 2));
  EXPECT_EQ(photons[0].q_WD.coeffs(), Eigen::Quaterniond(0, 1, 0, 0).coeffs());
  EXPECT_EQ(photons[1].cones.size(), 1u);
}

TEST(MeasurementCsv, AViewpointIsTheMiddleOfItsLiveTime) {
  const auto batches = viewpoints(kViewpoint + "0,250,-1,2,2,1,0,0,0,0,0\n");
  ASSERT_EQ(batches.size(), 2u);
  EXPECT_EQ(batches[0].live_us, 50'000);
  EXPECT_EQ(batches[0].utime + batches[0].duration_us / 2, 10'500'000);
  EXPECT_EQ(batches[0].channels[0].singles, 7);
  EXPECT_EQ(batches[1].live_us, 0) << "no live time is no error, and no measurement";
}

TEST(MeasurementCsv, WhatIsNearlyOfLengthOneIsScaledToIt) {
  const auto photon = cones(replaced(kCone, "0,0,-1,", "0,0,-1.0009,"))[0];
  EXPECT_DOUBLE_EQ(photon.cones[0].axis_W.norm(), 1.0);
  EXPECT_DOUBLE_EQ(viewpoints("1,1,0,0,2,0,0.9991,0,0,1,0\n")[0].q_WD.norm(), 1.0);
}

TEST(MeasurementCsv, NamesWhatIsWrongWithACone) {
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {replaced(kCone, "10.5", "nan"), {"cones.csv:2", "t_s 'nan'"}},
      {replaced(kCone, "10.5", "-1"), {"t_s '-1'", "0 to"}},
      {replaced(kCone, ",1,3,", ",0,3,"), {"drone '0'", "1 to 250"}},
      {replaced(kCone, ",1,3,", ",1.5,3,"), {"drone '1.5'"}},
      {replaced(kCone, ",3,", ",-3,"), {"event '-3'"}},
      {replaced(kCone, ",1,2,2,", ",inf,2,2,"), {"x_m 'inf'"}},
      {replaced(kCone, ",1,2,2,", ",1,2,2e7,"), {"z_m '2e7'", "1e+06"}},
      {replaced(kCone, "0,1,0,0,", "0,1,0,0.1,"), {"cones.csv:2", "quaternion", "1.00499", "within 0.001"}},
      {replaced(kCone, "0,1,0,0,", "0,0,0,0,"), {"quaternion", "length 0"}},
      {replaced(kCone, "0,0,-1,", "0,0,-0.99,"), {"axis", "0.99"}},
      {replaced(kCone, "0,0,-1,", "0,NAN,-1,"), {"axis_y 'NAN'"}},
      {replaced(kCone, "0.5,0.6", "3.2,0.6"), {"beta_rad '3.2'", "0 to 3.14159"}},
      {replaced(kCone, "0.5,0.6", "-0.1,0.6"), {"beta_rad '-0.1'"}},
      {replaced(kCone, "0.6\n", "0\n"), {"weight '0'", "above 0"}},
      {replaced(kCone, "0.6\n", "1.2\n"), {"weight '1.2'"}},
      {kCone + replaced(kOther, "0.4\n", "0.6\n"), {"cones.csv:3", "weight '0.6'", "0.4 at most"}},
      {kCone + kOther + kOther, {"cones.csv:4", "event '3'", "two rows at most"}},
      {kCone + replaced(kOther, "10.5", "10.6"), {"cones.csv:3", "event '3'", "same time"}},
      {kCone + replaced(kOther, ",1,2,2,", ",1,2,3,"), {"event '3'", "position"}},
      {kCone + replaced(kOther, "0,1,0,0,", "1,0,0,0,"), {"event '3'", "attitude"}},
  };
  for (const auto& [rows, mentions] : cases) {
    const std::string said = complaint([&rows = rows] { return cones(rows); });
    EXPECT_EQ(said.find('\n'), said.npos) << said;
    for (const std::string& word : mentions) EXPECT_NE(said.find(word), said.npos) << rows << "-> " << said;
  }
}

TEST(MeasurementCsv, NamesWhatIsWrongWithAViewpoint) {
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {replaced(kViewpoint, "0.05", "-0.05"), {"viewpoints.csv:2", "live_s '-0.05'", "0 to 2000"}},
      {replaced(kViewpoint, "0.05", "2001"), {"live_s '2001'"}},
      {replaced(kViewpoint, "0.05", "nan"), {"live_s 'nan'"}},
      {replaced(kViewpoint, ",7\n", ",7.5\n"), {"singles '7.5'", "whole"}},
      {replaced(kViewpoint, ",7\n", ",-7\n"), {"singles '-7'"}},
      {replaced(kViewpoint, ",7\n", ",99999999999\n"), {"singles '99999999999'"}},
      {replaced(kViewpoint, ",7\n", "\n"), {"10 fields", "must be 11"}},
      {replaced(kViewpoint, "0,1,0,0", "0,2,0,0"), {"quaternion", "length 2"}},
  };
  for (const auto& [rows, mentions] : cases) {
    const std::string said = complaint([&rows = rows] { return viewpoints(rows); });
    for (const std::string& word : mentions) EXPECT_NE(said.find(word), said.npos) << rows << "-> " << said;
  }
}

TEST(MeasurementCsv, TheTwoFilesMustFit) {
  const auto read = [](const std::string& cone_rows, const std::string& viewpoint_rows) {
    return read_measurements(scratch_file("cones.csv", kConeHeader + cone_rows),
                             scratch_file("viewpoints.csv", kViewpointHeader + viewpoint_rows), kNuclide);
  };
  EXPECT_TRUE(read(kCone, kViewpoint).remarks.empty());
  EXPECT_TRUE(read("", kViewpoint).remarks.empty()) << "a recording may have no pairs";
  EXPECT_NE(complaint([&] { return read(kCone, ""); }).find("no viewpoint"), std::string::npos);
  const std::string blind = complaint([&] { return read(kCone, replaced(kViewpoint, "0.05", "0")); });
  EXPECT_NE(blind.find("drone 1 has no live_s above 0"), std::string::npos) << blind;
  EXPECT_NE(complaint([&] { return read(kCone, "10.5,2,1,2,2,0,1,0,0,0.05,7\n"); }).find("drone 1"), std::string::npos);
  const auto apart = read(kCone, replaced(kViewpoint, "10.5", "8")).remarks;
  ASSERT_EQ(apart.size(), 1u) << "the photon came 2.5 s after the drone's only viewpoint";
  EXPECT_NE(apart[0].find("1 photons"), std::string::npos) << apart[0];
  EXPECT_TRUE(read(kCone, replaced(replaced(kViewpoint, "10.5", "8"), "0.05", "4")).remarks.empty());
}

TEST(MeasurementCsv, ALogThatIsWrittenOutReadsBackToTheSameBits) {
  const auto log = write_measurements(measured_field(), scratch_file("field.lcm"));
  const RecordedMeasurements there = read_measurements(log, kNuclide);
  const RecordedMeasurements back =
      read_measurements(scratch_file("cones.csv", cones_csv(there.batches, kNuclide)),
                        scratch_file("viewpoints.csv", viewpoints_csv(there.batches, kNuclide)), kNuclide);
  const JointData first = data_of(there.batches), second = data_of(back.batches);
  ASSERT_GT(first.viewpoints.size(), 300u);
  ASSERT_GT(first.pairs.size(), 50u);
  EXPECT_EQ(second.senders, first.senders);
  EXPECT_EQ(second.live_s, first.live_s);
  EXPECT_EQ(second.viewpoints.x_m, first.viewpoints.x_m);
  EXPECT_EQ(second.viewpoints.z_m, first.viewpoints.z_m);
  EXPECT_EQ(second.viewpoints.R_DW, first.viewpoints.R_DW);
  EXPECT_EQ(second.viewpoints.live_s, first.viewpoints.live_s);
  EXPECT_EQ(second.viewpoints.singles, first.viewpoints.singles);
  EXPECT_EQ(second.viewpoints.drone, first.viewpoints.drone);
  ASSERT_EQ(second.pairs.size(), first.pairs.size());
  for (std::size_t i = 0; i < first.pairs.size(); ++i) {
    const Pair &a = first.pairs[i], &b = second.pairs[i];
    EXPECT_EQ(a.p_WS, b.p_WS) << i;
    EXPECT_EQ(a.R_DW, b.R_DW) << i;
    EXPECT_EQ(a.drone, b.drone) << i;
    ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size()) << i;
    for (std::size_t k = 0; k < a.hypotheses.size(); ++k) {
      EXPECT_EQ(a.hypotheses[k].axis_W, b.hypotheses[k].axis_W) << i;
      EXPECT_NEAR(a.hypotheses[k].beta_rad, b.hypotheses[k].beta_rad, 1e-12) << i;
      EXPECT_EQ(a.hypotheses[k].weight, b.hypotheses[k].weight) << i;
    }
  }
}

TEST(RecordedMeasurements, TakesEachBatchOnceInTheOrderOfTime) {
  const auto field = measured_field();
  std::vector<MeasurementBatch> mixed = {field[3], field[0], field[2], field[0], field[1]};
  const auto recorded = read_measurements(write_measurements(mixed, scratch_file("mixed.lcm")), kNuclide);
  ASSERT_EQ(recorded.batches.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(recorded.batches[i].key.number, static_cast<std::int64_t>(i));
  ASSERT_EQ(recorded.remarks.size(), 1u);
  EXPECT_NE(recorded.remarks[0].find("1 batches stand twice"), std::string::npos) << recorded.remarks[0];
}

TEST(RecordedMeasurements, SaysWhatNuclidesThereAre) {
  const auto log = write_measurements({measured_field()[0]}, scratch_file("one.lcm"));
  const std::string said = complaint([&] { return read_measurements(log, "Am-241"); });
  for (const char* word : {"one.lcm", "Am-241", "--nuclide Co-60 or Cs-137"}) {
    EXPECT_NE(said.find(word), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace comptonaut
