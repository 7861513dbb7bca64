// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_clock.h"

#include <gtest/gtest.h>

#include <vector>

#include "start_time.h"

namespace comptonaut {
namespace {

constexpr Utime kSilence = 3 * kSecond_us;

/// MAVs 1, 2, ... whose clocks are off by so much. All send at the same time, in the order of their numbers.
struct Team {
  TeamClock clock{kSilence};
  std::vector<Utime> off_us;
  Utime truth = kStart_us;

  /// Those in `senders` send for so long; the coordinator ticks each second that has come.
  void send(double duration_s, const std::vector<int>& senders) {
    for (const Utime end = truth + static_cast<Utime>(1e6 * duration_s); truth < end;) {
      truth += kBatch_us;
      for (const int sender : senders) {
        clock.on_newest(sender, truth + off_us[static_cast<std::size_t>(sender) - 1], kBatch_us);
      }
      if (floor_to(*clock.now(), kSecond_us) > last_tick) clock.on_tick(last_tick = floor_to(*clock.now(), kSecond_us));
    }
  }
  [[nodiscard]] double error_s() const { return seconds(*clock.now() - truth); }

  Utime last_tick = 0;
};

TEST(TeamClock, KnowsNoTimeBeforeTheFirstBatch) {
  TeamClock clock(kSilence);
  EXPECT_FALSE(clock.now());
  EXPECT_EQ(clock.ahead_us(1), 0);
}

TEST(TeamClock, OneWrongClockOfThreeMovesNothing) {
  for (const double off_s : {-300.0, -5.0, 5.0, 300.0, 1e8}) {
    Team team{.off_us = {0, 0, static_cast<Utime>(1e6 * off_s)}};
    team.send(20, {1, 2, 3});
    EXPECT_NEAR(team.error_s(), 0.0, 0.05) << off_s;
    EXPECT_NEAR(seconds(team.clock.ahead_us(3)), off_s, 0.05 + 1e-9 * std::abs(off_s));
    EXPECT_NEAR(seconds(team.clock.ahead_us(1)), 0.0, 0.05) << off_s;
  }
}

TEST(TeamClock, OfTwoTheEarlierOneCounts) {
  Team team{.off_us = {0, 300 * kSecond_us}};
  team.send(20, {1, 2});
  EXPECT_NEAR(team.error_s(), 0.0, 0.05);
}

TEST(TeamClock, OfTwoTheOneThatJumpsAheadDoesNotCount) {
  Team team{.off_us = {0, 0}};
  team.send(20, {1, 2});
  team.off_us[1] = 300 * kSecond_us;
  team.send(20, {1, 2});
  EXPECT_NEAR(team.error_s(), 0.0, 0.05);
}

// Ticks cannot go back: who falls behind them has no vote, and the team goes on by the other.
TEST(TeamClock, OfTwoTheOneThatFallsBackDoesNotCount) {
  Team team{.off_us = {0, 0}};
  team.send(20, {1, 2});
  team.off_us[0] = -300 * kSecond_us;
  team.send(20, {1, 2});
  EXPECT_NEAR(team.error_s(), 0.0, 0.05);
}

TEST(TeamClock, StandsStillWhileNobodySendsAndGoesOnAfterAPauseOfAnyLength) {
  for (const double pause_s : {5.0, 660.0, 86'400.0}) {
    Team team{.off_us = {0, 0, 0}};
    team.send(20, {1, 2, 3});
    team.truth += static_cast<Utime>(1e6 * pause_s);
    EXPECT_NEAR(team.error_s(), -pause_s, 1e-9) << pause_s;
    team.send(1, {1, 2, 3});
    EXPECT_NEAR(team.error_s(), 0.0, 0.05) << pause_s;
  }
}

TEST(TeamClock, WhoComesBackAloneFromAPauseWaitsForTheOthersNoLongerThanTheirSilence) {
  Team team{.off_us = {0, 0, 0}};
  team.send(20, {1, 2, 3});
  team.truth += 660 * kSecond_us;
  team.send(2.9, {2});
  EXPECT_NEAR(team.error_s(), -660.0, 0.05) << "its clock may as well have jumped";
  team.send(0.2, {2});
  EXPECT_NEAR(team.error_s(), 0.0, 0.05);
}

TEST(TeamClock, RunsOnWhileSomeAreNotHeard) {
  Team team{.off_us = {0, 0, 0}};
  team.send(20, {1, 2, 3});
  for (int i = 0; i < 50; ++i) {
    team.send(0.2, {1});
    EXPECT_NEAR(team.error_s(), 0.0, 0.06) << "after " << i;
  }
}

TEST(TeamClock, AWrongClockThatIsLeftAloneCarriesTheTeamAndCountsNoMoreThanAnother) {
  Team team{.off_us = {0, 0, 300 * kSecond_us}};
  team.send(20, {1, 2, 3});
  team.send(10, {3});
  EXPECT_NEAR(team.error_s(), 300.0, 0.05) << "a pause of the others looks the same";
  team.send(10, {1, 2, 3});
  EXPECT_NEAR(team.error_s(), 300.0, 0.05) << "ticks do not go back";
  const double error_s = team.error_s();
  team.send(60, {1, 2});
  EXPECT_NEAR(team.error_s(), error_s, 0.2) << "and go on at the pace of those that are left";
}

TEST(TeamClock, GoesOnWhenAllClocksAreSetBack) {
  Team team{.off_us = {0, 0, 0}};
  team.send(20, {1, 2, 3});
  team.off_us = {-3600 * kSecond_us, -3600 * kSecond_us, -3600 * kSecond_us};
  team.send(60, {1, 2, 3});
  EXPECT_NEAR(team.error_s(), 0.0, 0.1);
}

TEST(TeamClock, CountsTheContinuationOfABatchOnce) {
  TeamClock clock(kSilence);
  for (int part = 0; part < 3; ++part) clock.on_newest(1, kStart_us, kBatch_us);
  EXPECT_EQ(clock.progress_us(), kBatch_us);
  EXPECT_EQ(clock.now(), kStart_us);
}

TEST(TeamClock, MeasuresProgressByTheBusiestSender) {
  Team team{.off_us = {0, 0, 0}};
  team.send(5, {1, 2});
  team.send(5, {1, 2, 3});
  team.send(5, {3});
  EXPECT_NEAR(seconds(team.clock.progress_us()), 15.0, 0.1) << "whoever it is";
}

}  // namespace
}  // namespace comptonaut
