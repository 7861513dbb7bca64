// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/mapper_fixture.h"

namespace comptonaut {
namespace {

TEST(Mapper, TakesThePoseOfTheMiddleOfABatch) {
  Mapper mapper(config(), kFirst);
  EXPECT_TRUE(mapper.on_events(events(0)).empty());
  const auto released = fly(mapper, kStart_us - 10'000, kStart_us + 50'000);
  ASSERT_EQ(released.size(), 1u);
  const MeasurementBatch& batch = released.front();
  EXPECT_EQ(batch.key, kFirst);
  EXPECT_EQ(batch.utime, kStart_us);
  EXPECT_EQ(batch.live_us, 49'000);
  EXPECT_EQ(batch.utime_sigma_us, 3);
  EXPECT_EQ(batch.others, 4);
  EXPECT_EQ(batch.channels, events(0).channels);
  EXPECT_LT((batch.p_WD - Eigen::Vector3d(0.2, 0.0, 1.95)).norm(), 1e-9) << batch.p_WD.transpose();
  EXPECT_LT((batch.v_WD - Eigen::Vector3d(8, 0, 0)).norm(), 1e-9) << batch.v_WD.transpose();
  // Looking down: the cathode's normal is -z of W, and x_D is the body's forward, north-east.
  EXPECT_LT((batch.q_WD * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((batch.q_WD * Eigen::Vector3d::UnitX() - Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0)).norm(), 1e-9);
}

TEST(Mapper, SaysWhatIsLeftOfItsOwnBattery) {
  Mapper mapper(config(), kFirst);
  (void)fly(mapper, kStart_us, kStart_us + 200'000);
  EXPECT_TRUE(std::isnan(mapper.on_events(events(0)).at(0).battery_percent));
  mapper.on_vehicle({.sender = kFirst.sender, .battery_percent = 63.0});
  mapper.on_vehicle({.sender = kFirst.sender + 1, .battery_percent = 99.0});
  EXPECT_EQ(mapper.on_events(events(1)).at(0).battery_percent, 63.0);
  mapper.on_vehicle({.sender = kFirst.sender});
  EXPECT_TRUE(std::isnan(mapper.on_events(events(2)).at(0).battery_percent));
}

TEST(Mapper, GivesEachConeThePoseOfItsOwnPhoton) {
  Mapper mapper(config(), kFirst);
  (void)mapper.on_events(events(0, {pair_at(10'000'000), pair_at(40'000'999)}));
  const auto released = fly(mapper, kStart_us, kStart_us + 60'000);
  ASSERT_EQ(released.size(), 1u);
  const auto& cones = released.front().cones;
  ASSERT_EQ(cones.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const int offset_us = i < 2 ? 10'000 : 40'000;
    EXPECT_EQ(cones[i].offset_us, offset_us) << "cone " << i;
    EXPECT_EQ(cones[i].event, i < 2 ? 0 : 1) << "cone " << i;
    EXPECT_NEAR(cones[i].p_WS.x(), 8.0 * 1e-6 * offset_us, 1e-9) << "cone " << i;
    EXPECT_EQ(cones[i].weight, i % 2 == 0 ? 0.25 : 0.75) << "cone " << i;
    EXPECT_EQ(cones[i].cos_beta, i % 2 == 0 ? 0.5 : -0.5) << "cone " << i;
  }
  EXPECT_LT((cones[0].axis_W - Eigen::Vector3d(0, 0, -1)).norm(), 1e-9);
  EXPECT_LT((cones[1].axis_W - Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0)).norm(), 1e-9);
}

TEST(Mapper, MakesOneConeOfAPairWithOnePhysicalHypothesis) {
  Mapper mapper(config(), kFirst);
  PairEvent pair = pair_at(0);
  pair.a.probability = 0.0;
  pair.b.probability = 1.0;
  (void)mapper.on_events(events(0, {pair}));
  const auto released = fly(mapper, kStart_us, kStart_us + 60'000);
  ASSERT_EQ(released.at(0).cones.size(), 1u);
  EXPECT_EQ(released[0].cones[0].weight, 1.0);
}

TEST(Mapper, TakesTheVelocityOfTheDetectorNotOfTheBody) {
  MapperConfig mounted = config();
  mounted.X_BD = Eigen::Translation3d(1, 0, 0);
  Mapper mapper(mounted, kFirst);
  for (const Utime utime : {kStart_us, kStart_us + 50'000}) {
    StampedPose pose{.utime = utime};
    pose.w_WB_B = {0, 0, 2};
    (void)mapper.on_pose(pose);
  }
  const auto released = mapper.on_events(events(0));
  ASSERT_EQ(released.size(), 1u);
  EXPECT_LT((released[0].v_WD - Eigen::Vector3d(0, 2, 0)).norm(), 1e-12) << released[0].v_WD.transpose();
}

TEST(Mapper, ReleasesTheSameBatchesHoweverInputsInterleave) {
  std::vector<EventBatch> all;
  for (int i = 0; i < 40; ++i) all.push_back(events(i, {pair_at(1'000'000 * i)}));
  const auto run = [&](Utime poses_late_us) {
    Mapper mapper(config(), kFirst);
    std::vector<MeasurementBatch> released;
    Utime posed = kStart_us - 20'000;
    for (const EventBatch& batch : all) {
      for (; posed <= batch.utime + 50'000 - poses_late_us; posed += 20'000)
        append(released, mapper.on_pose(pose_at(posed)));
      append(released, mapper.on_events(batch));
    }
    append(released, fly(mapper, posed, kStart_us + 40 * kBatch_us + 20'000));
    return released;
  };
  const auto early = run(-100'000);
  ASSERT_EQ(early.size(), 40u);
  for (const Utime late_us : {0, 30'000, 300'000, 900'000}) {
    const auto late = run(late_us);
    ASSERT_EQ(late.size(), early.size()) << late_us;
    for (std::size_t i = 0; i < late.size(); ++i) {
      EXPECT_EQ(late[i].key, early[i].key) << late_us;
      EXPECT_EQ(late[i].p_WD, early[i].p_WD) << "batch " << i << ", poses " << late_us << " us late";
      EXPECT_EQ(late[i].cones.at(0).p_WS, early[i].cones.at(0).p_WS) << "batch " << i;
    }
  }
}

TEST(Mapper, GivesUpWaitingForAPoseAfterSomeDataTime) {
  Mapper mapper(config(), kFirst);
  (void)fly(mapper, kStart_us - 100'000, kStart_us);
  std::vector<MeasurementBatch> released;
  for (int i = 0; i < 21; ++i) {
    append(released, mapper.on_events(events(i, {pair_at(5)})));
    EXPECT_EQ(released.size(), i < 20 ? 0u : 1u) << "after batch " << i;
  }
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].live_us, 0);
  EXPECT_TRUE(released[0].cones.empty());
  EXPECT_TRUE(released[0].channels.empty());
  EXPECT_EQ(released[0].others, 0);
  EXPECT_LT((released[0].p_WD - Eigen::Vector3d(0, 0, 1.95)).norm(), 1e-9) << "the last known place";
  EXPECT_FALSE(released[0].has_pose());
  EXPECT_EQ(counter(mapper, "batches_without_pose"), 1);
  EXPECT_EQ(counter(mapper, "events_waiting"), 20);
}

TEST(Mapper, DoesNotInterpolateAcrossAGapOfPoses) {
  Mapper mapper(config(), kFirst);
  (void)mapper.on_pose(pose_at(kStart_us - 200'000));
  (void)mapper.on_pose(pose_at(kStart_us + 60'000));
  (void)mapper.on_events(events(0));
  const auto released = mapper.on_end();
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].live_us, 0);
}

TEST(Mapper, LeavesOutWhatNobodyKnowsThePlaceOf) {
  Mapper mapper(config(), kFirst);
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(mapper.on_events(events(i)).empty()) << i;
  EXPECT_EQ(counter(mapper, "batches_before_first_pose"), 10);
  auto released = fly(mapper, kStart_us + 28 * kBatch_us, kStart_us + 60 * kBatch_us);
  for (int i = 30; i < 60; ++i) append(released, mapper.on_events(events(i)));
  ASSERT_FALSE(released.empty());
  EXPECT_EQ(released.front().key.number, 0) << "numbers have no gap";
  EXPECT_EQ(released.back().live_us, 49'000);
  EXPECT_EQ(released.back().utime, kStart_us + 59 * kBatch_us);
}

TEST(Mapper, SendsWhatWaitsWhenTheInputEnds) {
  Mapper mapper(config(), kFirst);
  (void)fly(mapper, kStart_us, kStart_us + 40'000);  // not to the end of the batch, but past its middle
  EXPECT_TRUE(mapper.on_events(events(0)).empty());
  const auto released = mapper.on_end();
  ASSERT_EQ(released.size(), 1u);
  EXPECT_EQ(released[0].live_us, 49'000);
  EXPECT_TRUE(mapper.on_end().empty());
}

TEST(Mapper, SplitsABatchWithMoreConesThanFitWithoutPartingAPhotonsHypotheses) {
  Mapper mapper(config(), kFirst);
  std::vector<PairEvent> pairs;
  for (int i = 0; i < 25; ++i) {
    pairs.push_back(pair_at(1'000'000 * i));
    if (i % 3 == 0) pairs.back().a.probability = 0.0, pairs.back().b.probability = 1.0;
  }
  (void)mapper.on_events(events(0, pairs));
  const auto released = fly(mapper, kStart_us, kStart_us + 60'000);
  ASSERT_EQ(released.size(), 3u);
  std::vector<std::int32_t> photons;
  for (std::size_t i = 0; i < released.size(); ++i) {
    const MeasurementBatch& part = released[i];
    EXPECT_EQ(part.key.number, static_cast<std::int64_t>(i));
    EXPECT_EQ(part.utime, kStart_us);
    EXPECT_EQ(part.live_us, i == 0 ? 49'000 : 0);
    EXPECT_EQ(part.channels.at(0).singles, i == 0 ? 10 : 0);
    EXPECT_EQ(part.channels.at(0).pairs, i == 0 ? 25 : 0);
    EXPECT_EQ(part.others, i == 0 ? 4 : 0);
    EXPECT_LE(part.cones.size(), kMaxConesPerBatch);
    for (const Cone& cone : part.cones) photons.push_back(cone.event);
    if (i == 0) continue;
    EXPECT_NE(part.cones.front().event, released[i - 1].cones.back().event) << "part " << i;
  }
  EXPECT_EQ(photons.size(), 41u);  // 9 photons with one cone, 16 with two
  EXPECT_TRUE(std::is_sorted(photons.begin(), photons.end()));
}

}  // namespace
}  // namespace comptonaut
