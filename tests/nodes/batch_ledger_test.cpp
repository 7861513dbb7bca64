// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/batch_ledger.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace comptonaut {
namespace {

constexpr Utime kStart = 1'700'000'000'000'000;
constexpr Utime kGiveUp = 3 * kSecond_us;
using Entry = BatchLedger::Entry;

MeasurementBatch batch(std::int32_t sender, std::int64_t number, std::int64_t epoch = 7) {
  return {.key = {.sender = sender, .boot_epoch = epoch, .number = number}, .utime = kStart + number * kBatch_us};
}

void enter(BatchLedger& ledger, std::int32_t sender, std::int64_t first, std::int64_t last) {
  for (auto number = first; number <= last; ++number) ASSERT_EQ(ledger.enter(batch(sender, number)), Entry::kNew);
}

Utime after(double duration_s) { return kStart + static_cast<Utime>(duration_s * 1e6); }

TEST(BatchLedger, FoldsInOneOrderHoweverBatchesArrive) {
  std::vector<MeasurementBatch> arrivals;
  for (const int sender : {2, 1, 3}) {
    for (int number = 19; number >= 0; --number) arrivals.push_back(batch(sender, number));
  }
  BatchLedger ledger(kGiveUp);
  for (const auto& arrival : arrivals) ledger.enter(arrival);
  const auto fold = ledger.fold_until(after(1));
  ASSERT_EQ(fold.batches.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(fold.batches[i].utime, kStart + static_cast<Utime>(i / 3) * kBatch_us) << i;
    EXPECT_EQ(fold.batches[i].key.sender, static_cast<std::int32_t>(i % 3 + 1)) << i;
  }
  EXPECT_EQ(fold.basis, (Basis{{1, 7, 19, {}}, {2, 7, 19, {}}, {3, 7, 19, {}}}));
}

TEST(BatchLedger, ABatchTwiceChangesNothing) {
  BatchLedger ledger(kGiveUp);
  enter(ledger, 1, 0, 5);
  EXPECT_EQ(ledger.enter(batch(1, 3)), Entry::kDuplicate) << "waiting";
  EXPECT_EQ(ledger.fold_until(after(0.3)).batches.size(), 6u);
  EXPECT_EQ(ledger.enter(batch(1, 3)), Entry::kDuplicate) << "folded";
  EXPECT_TRUE(ledger.fold_until(after(1)).batches.empty());
}

TEST(BatchLedger, WaitsAtAGapAndFoldsWhatComesLateAtTheNextTick) {
  BatchLedger ledger(kGiveUp);
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
  BatchLedger ledger(kGiveUp);
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
  BatchLedger ledger(kGiveUp);
  for (int number = 0; number < 80; number += 2) ledger.enter(batch(1, number));
  enter(ledger, 2, 0, 200);
  std::int64_t given_up = 0;
  for (int tick = 4; tick < 10; ++tick) {
    const auto fold = ledger.fold_until(after(tick));
    EXPECT_LE(fold.given_up, 12);
    given_up += fold.given_up;
  }
  EXPECT_EQ(given_up, 39);
}

TEST(BatchLedger, ANewBootEpochStartsNewNumbers) {
  BatchLedger ledger(kGiveUp);
  enter(ledger, 1, 0, 9);
  for (int number = 0; number < 10; ++number) {
    auto restarted = batch(1, number, 8);
    restarted.utime += kSecond_us / 2;
    EXPECT_EQ(ledger.enter(restarted), Entry::kNew);
  }
  EXPECT_EQ(ledger.reach(1), after(1));
  EXPECT_EQ(ledger.fold_until(after(1)).basis, (Basis{{1, 7, 9, {}}, {1, 8, 9, {}}}));
}

TEST(BatchLedger, FollowsABasisExactlyAndOnlyWhenAllOfItIsThere) {
  BatchLedger leader(kGiveUp), follower(kGiveUp);
  enter(leader, 1, 0, 4);
  enter(leader, 1, 6, 19);
  enter(leader, 2, 0, 100);
  const auto fold = leader.fold_until(after(1));
  enter(follower, 1, 0, 18);  // it got number 5, which the leader gave up, but not yet 19
  enter(follower, 2, 0, 150);
  EXPECT_FALSE(follower.fold_to(fold.basis));
  enter(follower, 1, 19, 40);
  const auto followed = follower.fold_to(fold.basis);
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->basis, fold.basis);
  ASSERT_EQ(followed->batches.size(), fold.batches.size());
  for (std::size_t i = 0; i < fold.batches.size(); ++i) EXPECT_EQ(followed->batches[i].key, fold.batches[i].key) << i;
}

TEST(BatchLedger, RefusesABasisThatDoesNotFollowFromItsOwn) {
  BatchLedger ledger(kGiveUp);
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
  for (const Basis& basis : bases) EXPECT_FALSE(ledger.fold_to(basis));
  EXPECT_TRUE(ledger.fold_to({{1, 7, 30, {}}, {2, 7, 30, {}}}));
}

}  // namespace
}  // namespace comptonaut
