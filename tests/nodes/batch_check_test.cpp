// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/batch_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace comptonaut {
namespace {

const Area kArea{0, 50, 0, 50};

MeasurementBatch sane_batch() {
  MeasurementBatch batch{.utime = 1'700'000'000'000'000, .live_us = 50'000, .p_WD = {10, 20, 2}};
  batch.channels = {{.nuclide = "Cs-137", .pairs = 1}};
  batch.cones = {{.p_WS = {10.1, 20, 2}, .axis_W = {0, 0, -1}, .cos_beta = 0.7, .weight = 0.6}};
  return batch;
}

TEST(IsSane, AcceptsWhatAMapperSends) {
  EXPECT_TRUE(is_sane(sane_batch(), kArea));
  MeasurementBatch no_pose{.utime = 1'700'000'000'000'000, .live_us = 0};
  no_pose.p_WD.setConstant(NAN);
  no_pose.v_WD.setConstant(NAN);
  EXPECT_TRUE(is_sane(no_pose, kArea)) << "nothing was measured, but the number is needed";
  MeasurementBatch dead_detector = no_pose;
  dead_detector.v_WD.setZero();
  EXPECT_FALSE(is_sane(dead_detector, kArea)) << "it claims to know where it is";
  dead_detector.p_WD = {10, 20, 2};
  EXPECT_TRUE(is_sane(dead_detector, kArea));
}

TEST(IsSane, RefusesEachAbsurdity) {
  using Change = std::function<void(MeasurementBatch&)>;
  const std::pair<const char*, Change> changes[] = {
      {"time before 1970", [](auto& b) { b.utime = -1; }},
      {"time after 2100", [](auto& b) { b.utime = INT64_MAX; }},
      {"no duration", [](auto& b) { b.duration_us = 0; }},
      {"an hour's duration", [](auto& b) { b.duration_us = 2'000'000'000; }},
      {"more live than lasting", [](auto& b) { b.live_us = b.duration_us + 1; }},
      {"negative live time", [](auto& b) { b.live_us = -1; }},
      {"negative number", [](auto& b) { b.key.number = -1; }},
      {"nowhere", [](auto& b) { b.p_WD.x() = NAN; }},
      {"far away", [](auto& b) { b.p_WD.y() = 5000; }},
      {"in space", [](auto& b) { b.p_WD.z() = 1e6; }},
      {"rotation that is none", [](auto& b) { b.q_WD.coeffs().setZero(); }},
      {"faster than flies", [](auto& b) { b.v_WD.x() = 340; }},
      {"speed not a number", [](auto& b) { b.v_WD.x() = NAN; }},
      {"axis of length 2", [](auto& b) { b.cones[0].axis_W *= 2.0; }},
      {"axis not a number", [](auto& b) { b.cones[0].axis_W.x() = NAN; }},
      {"cosine of 2", [](auto& b) { b.cones[0].cos_beta = 2.0; }},
      {"cosine not a number", [](auto& b) { b.cones[0].cos_beta = NAN; }},
      {"channel of none", [](auto& b) { b.cones[0].channel = 1; }},
      {"negative channel", [](auto& b) { b.cones[0].channel = -1; }},
      {"negative weight", [](auto& b) { b.cones[0].weight = -0.1; }},
      {"cone elsewhere", [](auto& b) { b.cones[0].p_WS.x() += 20.0; }},
      {"cone nowhere", [](auto& b) { b.cones[0].p_WS.x() = NAN; }},
  };
  for (const auto& [what, change] : changes) {
    MeasurementBatch batch = sane_batch();
    change(batch);
    EXPECT_FALSE(is_sane(batch, kArea)) << what;
  }
}

}  // namespace
}  // namespace comptonaut
