// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bus/codec.h"
#include "bus/samples.h"

namespace comptonaut {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr Utime kYear2200 = 7'258'118'400'000'000;

template <class T>
struct Spoiled {
  const char* what;
  std::function<void(T&)> spoil;
};

/// Each case alone makes a valid message one that is refused.
template <class T>
void expect_each_refused(const std::vector<Spoiled<T>>& cases) {
  ASSERT_TRUE(decode<T>(encode(sample<T>())));
  for (const Spoiled<T>& c : cases) {
    T message = sample<T>();
    c.spoil(message);
    EXPECT_FALSE(decode<T>(encode(message))) << c.what;
  }
}

TEST(CodecRefuses, EventBatchesThatCannotBe) {
  expect_each_refused<EventBatch>({
      {"negative mission", [](auto& b) { b.key.mission = -1; }},
      {"sender beyond MAVLink's", [](auto& b) { b.key.sender = 251; }},
      {"negative sender", [](auto& b) { b.key.sender = -1; }},
      {"boot epoch out of range", [](auto& b) { b.key.boot_epoch = kYear2200; }},
      {"negative number", [](auto& b) { b.key.number = -1; }},
      {"time off the grid of batches", [](auto& b) { b.utime += 1; }},
      {"time before 1970", [](auto& b) { b.utime = -50'000; }},
      {"time after 2100", [](auto& b) { b.utime = kYear2200; }},
      {"no duration", [](auto& b) { b.duration_us = b.live_us = 0; }},
      {"longer than a batch", [](auto& b) { b.duration_us = 50'001; }},
      {"negative live time", [](auto& b) { b.live_us = -1; }},
      {"more live time than time", [](auto& b) { b.live_us = 50'001; }},
      {"negative uncertainty", [](auto& b) { b.utime_sigma_us = -1; }},
      {"negative others", [](auto& b) { b.others = -1; }},
      {"negative singles", [](auto& b) { b.channels[1].singles = -1; }},
      {"negative pairs", [](auto& b) { b.channels[0].pairs = -1; }},
      {"pair before the batch", [](auto& b) { b.pairs[0].offset_ns = -1; }},
      {"pair after the batch", [](auto& b) { b.pairs[0].offset_ns = 50'000'000; }},
      {"pair of no channel", [](auto& b) { b.pairs[0].channel = 2; }},
      {"pair of a negative channel", [](auto& b) { b.pairs[0].channel = -1; }},
      {"negative e1", [](auto& b) { b.pairs[0].e1_keV = -1; }},
      {"e2 not a number", [](auto& b) { b.pairs[0].e2_keV = NAN; }},
      {"infinite e1", [](auto& b) { b.pairs[0].e1_keV = kInf; }},
      {"axis of A not unit", [](auto& b) { b.pairs[0].a.axis_D *= 1.0001; }},
      {"axis of B not a number", [](auto& b) { b.pairs[0].b.axis_D.x() = NAN; }},
      {"cosine of A above 1", [](auto& b) { b.pairs[0].a.cos_beta = 1.001; }},
      {"cosine of B below -1", [](auto& b) { b.pairs[0].b.cos_beta = -1.001; }},
      {"probabilities that do not sum to 1", [](auto& b) { b.pairs[0].a.probability = 0.5; }},
      {"both hypotheses unphysical", [](auto& b) { b.pairs[0].a.probability = b.pairs[0].b.probability = 0; }},
      {"probability not a number", [](auto& b) { b.pairs[0].a.probability = NAN; }},
  });
}

TEST(CodecRefuses, RangePointsThatCannotBe) {
  expect_each_refused<RangePoints>({
      {"time before 1970", [](auto& p) { p.utime = -1; }},
      {"sensor nowhere", [](auto& p) { p.p_BR.y() = NAN; }},
      {"no range", [](auto& p) { p.range_max_m = 0; }},
      {"range not a number", [](auto& p) { p.range_max_m = NAN; }},
      {"range without end", [](auto& p) { p.range_max_m = kInf; }},
      {"more points than a scan has", [](auto& p) { p.points_B.resize(kMaxRangePoints + 1); }},
  });
  RangePoints some_unknown = sample<RangePoints>();
  some_unknown.points_B[0].x() = NAN;
  EXPECT_TRUE(decode<RangePoints>(encode(some_unknown))) << "a sensor may say that it does not know";
}

TEST(CodecRefuses, TerrainTilesThatCannotBe) {
  expect_each_refused<TerrainTile>({
      {"negative number", [](auto& t) { t.key.number = -1; }},
      {"time after 2100", [](auto& t) { t.utime = kYear2200; }},
      {"no edge", [](auto& t) { t.voxel_m = 0; }},
      {"edge not a number", [](auto& t) { t.voxel_m = NAN; }},
      {"beyond the world",
       [](auto& t) {
         t.voxels = {{{200'000'000, 0, 0}, Occupancy::kFree}};
       }},
      {"more voxels than fit", [](auto& t) { t.voxels.resize(kMaxVoxelsPerTile + 1, t.voxels.front()); }},
  });
  TerrainTile wide = sample<TerrainTile>();
  wide.voxels.push_back({{500, -200, 3}, Occupancy::kFree});
  EXPECT_THROW((void)encode(wide), std::invalid_argument);
  TerrainTile full = sample<TerrainTile>();
  full.voxels.resize(kMaxVoxelsPerTile, full.voxels.front());
  EXPECT_LE(encode(full).size() + 64, 1200u) << "with its trailer a datagram of the team bus";
}

TEST(CodecRefuses, MeasurementBatchesThatCannotBe) {
  expect_each_refused<MeasurementBatch>({
      {"negative number", [](auto& b) { b.key.number = -1; }},
      {"time off the grid of batches", [](auto& b) { b.utime += 1; }},
      {"more live time than time", [](auto& b) { b.live_us = 50'001; }},
      {"position not a number", [](auto& b) { b.p_WD.y() = NAN; }},
      {"position on another planet", [](auto& b) { b.p_WD.z() = 1.1e6; }},
      {"quaternion not unit", [](auto& b) { b.q_WD.coeffs() *= 1.0001; }},
      {"quaternion zero", [](auto& b) { b.q_WD.coeffs().setZero(); }},
      {"quaternion not a number", [](auto& b) { b.q_WD.w() = NAN; }},
      {"infinite velocity", [](auto& b) { b.v_WD.x() = kInf; }},
      {"battery above 100 %", [](auto& b) { b.battery_percent = 101; }},
      {"negative others", [](auto& b) { b.others = -1; }},
      {"negative singles", [](auto& b) { b.channels[0].singles = -1; }},
      {"cone before the batch", [](auto& b) { b.cones[0].offset_us = -1; }},
      {"cone after the batch", [](auto& b) { b.cones[0].offset_us = 50'000; }},
      {"negative event", [](auto& b) { b.cones[1].event = -1; }},
      {"cone of no channel", [](auto& b) { b.cones[1].channel = 2; }},
      {"scatter point not a number", [](auto& b) { b.cones[1].p_WS.z() = NAN; }},
      {"axis not unit", [](auto& b) { b.cones[1].axis_W *= 0.9999; }},
      {"cosine above 1", [](auto& b) { b.cones[1].cos_beta = 1.001; }},
      {"cosine not a number", [](auto& b) { b.cones[1].cos_beta = NAN; }},
      {"negative weight", [](auto& b) { b.cones[1].weight = -0.1; }},
      {"weight above 1", [](auto& b) { b.cones[1].weight = 1.1; }},
  });
}

TEST(CodecRefuses, PosesThatCannotBe) {
  expect_each_refused<StampedPose>({
      {"time before 1970", [](auto& p) { p.utime = -1; }},
      {"position not a number", [](auto& p) { p.p_WB.x() = NAN; }},
      {"infinite velocity", [](auto& p) { p.v_WB_B.x() = kInf; }},
      {"infinite rate", [](auto& p) { p.w_WB_B.y() = kInf; }},
      {"infinite acceleration", [](auto& p) { p.a_WB_B.z() = -kInf; }},
      {"quaternion not unit", [](auto& p) { p.q_WB.coeffs() *= 1.0001; }},
  });
  expect_each_refused<PoseQuality>({
      {"time after 2100", [](auto& q) { q.utime = kYear2200; }},
      {"negative sigma", [](auto& q) { q.position_sigma_m = -1; }},
      {"infinite sigma", [](auto& q) { q.height_sigma_m = kInf; }},
      {"negative yaw sigma", [](auto& q) { q.yaw_sigma_rad = -0.1; }},
      {"quality above 100 %", [](auto& q) { q.quality_percent = 101; }},
      {"quality below unknown", [](auto& q) { q.quality_percent = -2; }},
      {"negative resets", [](auto& q) { q.resets = -1; }},
  });
}

TEST(CodecRefuses, VehicleStatesThatCannotBe) {
  expect_each_refused<VehicleState>({
      {"time before 1970", [](auto& v) { v.utime = -1; }},
      {"sender beyond MAVLink's", [](auto& v) { v.sender = 251; }},
      {"battery above 100 %", [](auto& v) { v.battery_percent = 101; }},
      {"negative battery", [](auto& v) { v.battery_percent = -1; }},
      {"home known in part", [](auto& v) { v.p_WHome.x() = NAN; }},
      {"infinite home", [](auto& v) { v.p_WHome.x() = kInf; }},
      {"fence not a number", [](auto& v) { v.fence_m[1].y() = NAN; }},
      {"infinite floor", [](auto& v) { v.fence_floor_m = -kInf; }},
      {"infinite ceiling", [](auto& v) { v.fence_ceiling_m = kInf; }},
      {"plan before the first", [](auto& v) { v.plan_number = -2; }},
      {"negative waypoint", [](auto& v) { v.waypoint = -1; }},
  });
}

TEST(CodecRefuses, PlansThatCannotBe) {
  expect_each_refused<Plan>({
      {"negative mission", [](auto& p) { p.mission = -1; }},
      {"time before 1970", [](auto& p) { p.utime = -1; }},
      {"negative MAV", [](auto& p) { p.mav = -1; }},
      {"negative term", [](auto& p) { p.term = -1; }},
      {"negative number", [](auto& p) { p.number = -1; }},
      {"waypoint not a number", [](auto& p) { p.waypoints[1].p_W.x() = NAN; }},
      {"negative speed", [](auto& p) { p.waypoints[0].speed_max_m_s = -1; }},
      {"infinite speed", [](auto& p) { p.waypoints[0].speed_max_m_s = kInf; }},
      {"waypoint before 1970", [](auto& p) { p.waypoints[0].utime = -1; }},
      {"basis with a negative sender", [](auto& p) { p.basis[0].sender = -1; }},
      {"basis with a negative epoch", [](auto& p) { p.basis[0].boot_epoch = -1; }},
      {"basis before the first number", [](auto& p) { p.basis[0].number = -2; }},
      {"basis out of order", [](auto& p) { std::swap(p.basis[0], p.basis[1]); }},
      {"basis with a sender twice", [](auto& p) { p.basis[1] = p.basis[0]; }},
      {"run that was given up without its end", [](auto& p) { p.basis[0].skipped = {3}; }},
      {"run that was given up backwards",
       [](auto& p) {
         p.basis[0].skipped = {9, 7};
       }},
      {"runs that overlap",
       [](auto& p) {
         p.basis[0].skipped = {3, 7, 7, 9};
       }},
      {"run beyond the last number",
       [](auto& p) {
         p.basis[0].skipped = {50, 51};
       }},
      {"run before the first number",
       [](auto& p) {
         p.basis[0].skipped = {-1, 3};
       }},
  });
}

TEST(CodecRefuses, AnswersThatCannotBe) {
  expect_each_refused<SourceReport>({
      {"negative mission", [](auto& r) { r.mission = -1; }},
      {"coverage above 1", [](auto& r) { r.coverage = 1.1; }},
      {"coverage not a number", [](auto& r) { r.coverage = NAN; }},
      {"infinite certificate", [](auto& r) { r.certificate = kInf; }},
      {"position not a number", [](auto& r) { r.sources[0].p_W.x() = NAN; }},
      {"negative activity", [](auto& r) { r.sources[0].activity_Bq = -1; }},
      {"activity not a number", [](auto& r) { r.sources[1].activity_Bq = NAN; }},
      {"negative sigma", [](auto& r) { r.sources[0].position_sigma_m.z() = -1; }},
      {"infinite covariance", [](auto& r) { r.sources[0].position_cov_xy_m2 = kInf; }},
      {"negative sigma of activity", [](auto& r) { r.sources[0].activity_sigma_Bq = -1; }},
      {"infinite significance", [](auto& r) { r.sources[0].significance = kInf; }},
  });
  expect_each_refused<MapTile>({
      {"negative mission", [](auto& t) { t.mission = -1; }},
      {"no cell size", [](auto& t) { t.cell_m = 0; }},
      {"cell size not a number", [](auto& t) { t.cell_m = NAN; }},
      {"tile beyond the last", [](auto& t) { t.tile = 9; }},
      {"negative tile", [](auto& t) { t.tile = -1; }},
      {"negative activity", [](auto& t) { t.cells[1].lambda_Bq = -1; }},
      {"activity not a number", [](auto& t) { t.cells[1].lambda_Bq = NAN; }},
      {"infinite sensitivity", [](auto& t) { t.cells[0].sensitivity_s = kInf; }},
      {"voxel out of range",
       [](auto& t) {
         t.cells = {{.key = {100'000'001, 0, 0}}};
       }},
  });
  expect_each_refused<ClearanceTile>({
      {"negative mission", [](auto& t) { t.mission = -1; }},
      {"no cell size", [](auto& t) { t.cell_m = 0; }},
      {"tile beyond the last", [](auto& t) { t.tile = 9; }},
      {"chance above 1", [](auto& t) { t.chance = 1.1; }},
      {"chance not a number", [](auto& t) { t.chance = NAN; }},
      {"negative limit", [](auto& t) { t.cells[1].limit_Bq = -1; }},
      {"infinite limit", [](auto& t) { t.cells[0].limit_Bq = kInf; }},
      {"voxel out of range",
       [](auto& t) {
         t.cells = {{.key = {0, -100'000'001, 0}}};
       }},
  });
  expect_each_refused<PatchReport>({
      {"negative mission", [](auto& r) { r.mission = -1; }},
      {"centroid not a number", [](auto& r) { r.patches[0].p_W.y() = NAN; }},
      {"negative area", [](auto& r) { r.patches[1].area_m2 = -1; }},
      {"infinite activity", [](auto& r) { r.patches[0].activity_Bq = kInf; }},
      {"gain not a number", [](auto& r) { r.patches[0].gain = NAN; }},
  });
  expect_each_refused<CoordinatorState>({
      {"negative mission", [](auto& s) { s.mission = -1; }},
      {"tick between seconds", [](auto& s) { s.utime += 1; }},
      {"negative sender", [](auto& s) { s.sender = -1; }},
      {"negative term", [](auto& s) { s.term = -1; }},
      {"negative lease", [](auto& s) { s.lease_us = -1; }},
      {"negative cones", [](auto& s) { s.cones = -1; }},
      {"negative viewpoints", [](auto& s) { s.viewpoints = -1; }},
      {"basis out of order", [](auto& s) { std::swap(s.basis[0], s.basis[2]); }},
  });
}

TEST(CodecRefuses, StatusAndTruthThatCannotBe) {
  expect_each_refused<DaemonStatus>({
      {"time before 1970", [](auto& s) { s.utime = -1; }},
      {"sender beyond MAVLink's", [](auto& s) { s.sender = 251; }},
  });
  expect_each_refused<Truth>({
      {"time before 1970", [](auto& t) { t.utime = -1; }},
      {"start after 2100", [](auto& t) { t.start_utime = kYear2200; }},
      {"time that stands still", [](auto& t) { t.time_scale = 0; }},
      {"infinite time scale", [](auto& t) { t.time_scale = kInf; }},
      {"area inside out", [](auto& t) { std::swap(t.area.x_min_m, t.area.x_max_m); }},
      {"area not a number", [](auto& t) { t.area.y_max_m = NAN; }},
      {"source not a number", [](auto& t) { t.sources[0].p_W.x() = NAN; }},
      {"negative activity", [](auto& t) { t.sources[0].activity_Bq = -1; }},
      {"negative MAV", [](auto& t) { t.mavs[0].mav = -1; }},
      {"MAV not a number", [](auto& t) { t.mavs[0].p_WB.x() = NAN; }},
      {"infinite yaw", [](auto& t) { t.mavs[0].yaw_rad = kInf; }},
      {"negative photons", [](auto& t) { t.mavs[0].photons = -1; }},
  });
}

TEST(CodecRefuses, TextWithControlCharacters) {
  const Bytes bytes = encode(sample<DaemonStatus>());
  for (const std::string word : {"mapper", "0.1.0", "running", "batches"}) {
    Bytes spoiled = bytes;
    const auto at = std::search(spoiled.begin(), spoiled.end(), word.begin(), word.end());
    ASSERT_NE(at, spoiled.end()) << word;
    *at = '\n';
    EXPECT_FALSE(decode<DaemonStatus>(spoiled)) << word;
  }
}

}  // namespace
}  // namespace comptonaut
