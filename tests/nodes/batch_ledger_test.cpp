// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/batch_ledger.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "start_time.h"

namespace comptonaut {
namespace {

constexpr Utime kGiveUp = 3 * kSecond_us;
using Entry = BatchLedger::Entry;

MeasurementBatch batch(std::int32_t sender, std::int64_t number, std::int64_t epoch = 7) {
  return {.key = {.sender = sender, .boot_epoch = epoch, .number = number}, .utime = kStart_us + number * kBatch_us};
}

void enter(BatchLedger& ledger, std::int32_t sender, std::int64_t first, std::int64_t last) {
  for (auto number = first; number <= last; ++number) ASSERT_EQ(ledger.enter(batch(sender, number)), Entry::kNew);
}

Utime after(double duration_s) { return kStart_us + static_cast<Utime>(duration_s * 1e6); }

TEST(BatchLedger, FoldsInOneOrderHoweverBatchesArrive) {
  std::vector<MeasurementBatch> arrivals;
  for (const int sender : {2, 1, 3}) {
    for (int number = 19; number >= 0; --number) arrivals.push_back(batch(sender, number));
  }
  BatchLedger ledger(kGiveUp, 3);
  for (const auto& arrival : arrivals) ledger.enter(arrival);
  const auto fold = ledger.fold_until(after(1));
  ASSERT_EQ(fold.batches.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(fold.batches[i].utime, kStart_us + static_cast<Utime>(i / 3) * kBatch_us) << i;
    EXPECT_EQ(fold.batches[i].key.sender, static_cast<std::int32_t>(i % 3 + 1)) << i;
  }
  EXPECT_EQ(fold.basis, (Basis{{1, 7, 19, {}}, {2, 7, 19, {}}, {3, 7, 19, {}}}));
}

TEST(BatchLedger, ABatchTwiceChangesNothing) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 0, 5);
  EXPECT_EQ(ledger.enter(batch(1, 3)), Entry::kDuplicate) << "waiting";
  EXPECT_EQ(ledger.fold_until(after(0.3)).batches.size(), 6u);
  EXPECT_EQ(ledger.enter(batch(1, 3)), Entry::kDuplicate) << "folded";
  EXPECT_TRUE(ledger.fold_until(after(1)).batches.empty());
}

TEST(BatchLedger, WaitsAtAGapAndFoldsWhatComesLateAtTheNextTick) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 0, 4);
  enter(ledger, 1, 6, 19);
  EXPECT_EQ(ledger.reach(1), after(0.25));
  auto fold = ledger.fold_until(after(1));
  EXPECT_EQ(fold.batches.size(), 5u);
  EXPECT_EQ(fold.basis, (Basis{{1, 7, 4, {}}}));
  enter(ledger, 1, 5, 5);
  EXPECT_EQ(ledger.reach(1), after(1));
  fold = ledger.fold_until(after(1));
  EXPECT_EQ(fold.batches.size(), 15u);
  EXPECT_EQ(fold.basis, (Basis{{1, 7, 19, {}}}));
}

TEST(BatchLedger, GivesAGapUpWhenTheTeamIsMuchFurtherAndNamesItOnce) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 3, 4);
  enter(ledger, 1, 6, 19);
  enter(ledger, 2, 0, 64);  // to 3.25 s: 3 s after the first batch after the first gap, not after the second one
  EXPECT_EQ(ledger.reach(1), after(0.25));
  auto fold = ledger.fold_until(after(1));
  EXPECT_EQ(fold.basis.front(), (BasisEntry{1, 7, 4, {0, 2}}));
  EXPECT_EQ(fold.given_up, 3);
  enter(ledger, 2, 65, 100);
  fold = ledger.fold_until(after(1));
  EXPECT_EQ(fold.basis.front(), (BasisEntry{1, 7, 19, {5, 5}}));
  EXPECT_EQ(ledger.fold_until(after(2)).basis.front(), (BasisEntry{1, 7, 19, {}}));
  EXPECT_EQ(ledger.enter(batch(1, 5)), Entry::kGivenUp);
  EXPECT_EQ(ledger.enter(batch(1, 6)), Entry::kDuplicate);
}

TEST(BatchLedger, GivesUpNoMoreRunsAtOnceThanADatagramHolds) {
  BatchLedger ledger(kGiveUp, 3);
  for (int number = 0; number < 400; number += 2) ledger.enter(batch(1, number));
  enter(ledger, 2, 0, 600);
  std::int64_t given_up = 0;
  for (int tick = 25; tick < 30; ++tick) {
    const auto fold = ledger.fold_until(after(tick));
    EXPECT_LE(fold.given_up, 62);
    given_up += fold.given_up;
  }
  EXPECT_EQ(given_up, 199);
}

TEST(BatchLedger, ANewBootEpochStartsNewNumbers) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 0, 9);
  for (int number = 0; number < 10; ++number) {
    auto restarted = batch(1, number, 8);
    restarted.utime += kSecond_us / 2;
    EXPECT_EQ(ledger.enter(restarted), Entry::kNew);
  }
  EXPECT_EQ(ledger.reach(1), after(1));
  EXPECT_EQ(ledger.fold_until(after(1)).basis, (Basis{{1, 7, 9, {}}, {1, 8, 9, {}}}));
}

/// Batches of a boot epoch that all senders' clocks agree on, 20 a second from `from_s` on.
std::vector<MeasurementBatch> epoch_of(std::int32_t sender, std::int64_t epoch, double from_s, int batches) {
  std::vector<MeasurementBatch> all;
  for (int number = 0; number < batches; ++number) {
    all.push_back(batch(sender, number, epoch));
    all.back().utime = after(from_s) + number * kBatch_us;
  }
  return all;
}

// MAV 1 starts again every second for a minute, with gaps; MAV 2 does not. What the one ledger announces the other
// follows, and neither basis nor books grow.
TEST(BatchLedger, RetiresEpochsThatTheirSenderHasLeft) {
  BatchLedger leader(kGiveUp, 3), follower(kGiveUp, 3);
  std::int64_t folded = 0, followed = 0;
  for (int second = 0; second < 60; ++second) {
    auto arrivals = epoch_of(1, 1000 - second, second, 17);  // the clock goes backwards from start to start
    arrivals.erase(arrivals.begin() + second % 10);
    for (const auto& b : epoch_of(2, 7, 0, 20 * (second + 1))) arrivals.push_back(b);
    for (const auto& b : arrivals) {
      leader.enter(b);
      follower.enter(b);
    }
    const Utime tick = after(second + 1);
    const auto fold = leader.fold_until(tick);
    folded += std::ssize(fold.batches);
    EXPECT_LE(fold.basis.size(), 6u) << "tick " << second;
    const auto same = follower.fold_to(tick, fold.basis);
    ASSERT_TRUE(same) << "tick " << second;
    EXPECT_EQ(same->basis, fold.basis) << "tick " << second;
    followed += std::ssize(same->batches);
  }
  EXPECT_EQ(folded, followed);
  EXPECT_GT(folded, 60 * 16 + 60 * 20 - 4 * 17) << "all but what is given up and what still waits at the end";
  for (BatchLedger* ledger : {&leader, &follower}) {
    EXPECT_EQ(ledger->enter(batch(1, 30, 1000)), Entry::kGivenUp) << "nothing more comes of a retired one";
    EXPECT_EQ(ledger->enter(batch(1, 5, 1000)), Entry::kDuplicate);
    EXPECT_EQ(ledger->enter(batch(1, 0, 1000)), Entry::kGivenUp);
  }
}

TEST(BatchLedger, NamesAnEpochUntilTheNextOneIsNamed) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 0, 19);
  enter(ledger, 2, 0, 20 * 3 - 1);
  EXPECT_EQ(ledger.fold_until(after(1)).basis.front(), (BasisEntry{1, 7, 19, {}}));
  auto restarted = epoch_of(1, 8, 1.5, 40);
  restarted.erase(restarted.begin(), restarted.begin() + 10);  // to be given up at 5.05 s, 3.55 s after the old epoch
  for (const auto& b : restarted) ledger.enter(b);
  enter(ledger, 2, 20 * 3, 20 * 5 - 1);
  const Basis still_old = {{1, 7, 19, {}}, {2, 7, 99, {}}};
  EXPECT_EQ(ledger.fold_until(after(5)).basis, still_old) << "its last word was at 1 s";
  enter(ledger, 2, 20 * 5, 20 * 6 - 1);
  EXPECT_EQ(ledger.fold_until(after(6)).basis.at(1), (BasisEntry{1, 8, 39, {0, 9}}));
  const Basis without_old = {{1, 8, 39, {}}, {2, 7, 119, {}}};
  EXPECT_EQ(ledger.fold_until(after(7)).basis, without_old);
}

TEST(BatchLedger, NamesNoMoreEpochsThanADatagramHolds) {
  BatchLedger ledger(kGiveUp, 6);
  for (int epoch = 0; epoch < 30; ++epoch) ledger.enter(batch(1, 0, epoch));
  enter(ledger, 2, 0, 20);
  std::int64_t folded = 0;
  for (int tick = 1; tick < 12; ++tick) {
    enter(ledger, 2, 20 * tick + 1, 20 * tick + 20);
    const auto fold = ledger.fold_until(after(tick));
    EXPECT_LE(fold.basis.size(), 6u) << "five of MAV 1, tick " << tick;
    EXPECT_EQ(fold.newest.size(), 2u) << "tick " << tick;
    folded += std::ssize(fold.batches);
  }
  EXPECT_EQ(folded, 30 + 220) << "some of it later, but nothing is lost";
}

TEST(BatchLedger, SaysOfEachSenderWhichEpochBeganLast) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 0, 19);
  enter(ledger, 2, 0, 19);
  const Basis before = {{1, 7, 19, {}}, {2, 7, 19, {}}}, after_restart = {{1, 3, 9, {}}, {2, 7, 19, {}}};
  EXPECT_EQ(ledger.fold_until(after(1)).newest, before);
  for (const auto& b : epoch_of(1, 3, 1.0, 10)) ledger.enter(b);  // the clock went back
  EXPECT_EQ(ledger.fold_until(after(2)).newest, after_restart);
}

/// The bases of ten ticks for three senders of which the third loses some batches and has a clock that is wrong.
std::vector<Basis> bases_with_wrong_clock(double off_s) {
  BatchLedger ledger(kGiveUp, 3);
  std::vector<Basis> bases;
  for (int second = 0; second < 10; ++second) {
    for (int number = 20 * second; number < 20 * (second + 1); ++number) {
      ledger.enter(batch(1, number));
      ledger.enter(batch(2, number));
      auto wrong = batch(3, number);
      wrong.utime += static_cast<Utime>(1e6 * off_s);
      if (number % 50 != 10) ledger.enter(wrong);
    }
    bases.push_back(ledger.fold_until(after(second + 1)).basis);
  }
  return bases;
}

TEST(BatchLedger, FoldsWhatAClockThatIsAheadMeasuredAsIfItWereRight) {
  const auto right = bases_with_wrong_clock(0.0);
  EXPECT_EQ(right[9][2].number, 159) << "the gap at number 160 is not given up yet";
  for (const double off_s : {1.5, 300.0, 1e8}) EXPECT_EQ(bases_with_wrong_clock(off_s), right) << off_s << " s";
}

// It cannot be told from one whose batches come late; what comes is folded at once.
TEST(BatchLedger, WaitsForNothingOfAClockThatIsBehind) {
  for (const double off_s : {-5.0, -300.0, -1e8}) {
    const auto bases = bases_with_wrong_clock(off_s);
    for (std::size_t i = 0; i < bases.size(); ++i) {
      EXPECT_EQ(bases[i][2].number, static_cast<std::int64_t>(20 * i + 19)) << off_s << " s";
    }
  }
}

TEST(BatchLedger, FollowsABasisExactlyAndOnlyWhenAllOfItIsThere) {
  BatchLedger leader(kGiveUp, 3), follower(kGiveUp, 3);
  enter(leader, 1, 0, 4);
  enter(leader, 1, 6, 19);
  enter(leader, 2, 0, 100);
  const auto fold = leader.fold_until(after(1));
  enter(follower, 1, 0, 18);  // it got number 5, which the leader gave up, but not yet 19
  enter(follower, 2, 0, 150);
  EXPECT_FALSE(follower.fold_to(after(1), fold.basis));
  enter(follower, 1, 19, 40);
  const auto followed = follower.fold_to(after(1), fold.basis);
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->basis, fold.basis);
  ASSERT_EQ(followed->batches.size(), fold.batches.size());
  for (std::size_t i = 0; i < fold.batches.size(); ++i) EXPECT_EQ(followed->batches[i].key, fold.batches[i].key) << i;
}

TEST(BatchLedger, RefusesABasisThatDoesNotFollowFromItsOwn) {
  BatchLedger ledger(kGiveUp, 3);
  enter(ledger, 1, 0, 40);
  enter(ledger, 2, 0, 40);
  (void)ledger.fold_until(after(1));
  const Basis bases[] = {
      {{1, 7, 30, {}}},                                 // without MAV 2
      {{1, 7, 18, {}}, {2, 7, 30, {}}},                 // back
      {{1, 7, 30, {5, 5}}, {2, 7, 30, {}}},             // gives up what has been folded
      {{1, 7, 30, {25, 24}}, {2, 7, 30, {}}},           // a run of less than nothing
      {{1, 7, 30, {25, 30}}, {2, 7, 30, {}}},           // a run to the last one
      {{1, 7, 30, {}}, {2, 7, 30, {}}, {3, 7, 0, {}}},  // a MAV that nobody heard of
      {{1, 7, INT64_MAX, {}}, {2, 7, 30, {}}},
      {{1, 7, INT64_MAX, {21, INT64_MAX - 1}}, {2, 7, 30, {}}},
  };
  for (const Basis& basis : bases) EXPECT_FALSE(ledger.fold_to(after(1), basis));
  EXPECT_TRUE(ledger.fold_to(after(1), {{1, 7, 30, {}}, {2, 7, 30, {}}}));
}

}  // namespace
}  // namespace comptonaut
