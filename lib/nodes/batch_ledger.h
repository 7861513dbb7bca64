// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/batch_key.h"
#include "nodes/team_batch.h"
#include "nodes/team_clock.h"

namespace comptonaut {

/// Which batches have come, which have been folded, and which are due: the books behind a coordinator's basis. Batches
/// are of measurements and of terrain, in one sequence.
/// Per sender and boot epoch batches are folded in the order of their numbers, without a gap but for runs that are
/// given up as lost; those of one tick are folded in the order (utime, sender, boot epoch, number), however they
/// arrived.
///
/// The time is the team's. Where the clock of a boot epoch is more than a second ahead of it, its newest batch counts
/// as of now and those before it accordingly, so that its measurements are folded when they come, too.
///
/// A boot epoch that its sender has left is retired once a basis has named its last number and nothing has come of it
/// for gap_give_up_us: no basis names it any more, and what still comes of it is refused. A follower retires it when
/// the basis names only other boot epochs of the same sender.
class BatchLedger {
 public:
  enum class Entry { kNew, kDuplicate, kGivenUp, kTooMany };

  /// What is folded at one tick, in its order, and the basis after it.
  struct Fold {
    std::vector<MeasurementBatch> batches;
    std::vector<TerrainTile> tiles;
    Basis basis;
    Basis newest;  ///< of each sender the boot epoch that began last, without what was given up
    std::int64_t given_up = 0;
  };

  /// A gap is given up once the team's time is gap_give_up_us later than the first batch after the gap.
  BatchLedger(Utime gap_give_up_us, int senders);

  /// Keeps a batch until it is folded.
  Entry enter(const TeamBatch& batch);

  [[nodiscard]] const TeamClock& clock() const { return clock_; }
  /// Start of the batch with the lowest number that `sender` has sent, of those that wait. nullopt: none waits.
  [[nodiscard]] std::optional<Utime> first_utime(std::int32_t sender) const;
  /// Up to where, in the team's time, the sender's batches are there, gaps that are given up not counted. nullopt:
  /// nowhere.
  [[nodiscard]] std::optional<Utime> reach(std::int32_t sender) const;
  /// The earliest end, in the team's time, of what waits to be folded next. nullopt: nothing waits.
  [[nodiscard]] std::optional<Utime> earliest_end() const;
  [[nodiscard]] std::int64_t waiting() const;

  /// Folds what is due at `tick`: ends by then, and follows its predecessor or a gap that is given up. Boot epochs and
  /// gaps for which the basis has no room wait for the next tick.
  [[nodiscard]] Fold fold_until(Utime tick);

  /// Folds exactly what leads to the `basis` of `tick`. nullopt, and nothing changed, where batches are missing or
  /// where the basis lacks what has been folded already.
  [[nodiscard]] std::optional<Fold> fold_to(Utime tick, const Basis& basis);

 private:
  using Name = std::pair<std::int32_t, std::int64_t>;  ///< sender, boot epoch
  using Run = std::pair<std::int64_t, std::int64_t>;   ///< first and last number
  struct Stream {
    std::map<std::int64_t, TeamBatch> waiting;
    std::int64_t newest = -1;  ///< highest number that came
    Utime newest_end = 0;
    Utime heard_at = 0;        ///< in the clock's progress
    std::int64_t begun = -1;   ///< how many had been folded of before
    std::int64_t folded = -1;  ///< last number
    std::optional<Utime> folded_end;
    std::vector<Run> given_up;
    std::size_t given_up_before = 0;  ///< of these, in earlier ticks
    bool retired = false;

    [[nodiscard]] bool is_named() const { return folded >= 0 && !retired; }
  };

  void note_time(const Name& name, Stream& stream, const TeamBatch& batch);
  [[nodiscard]] Utime ahead_us(const Stream& stream) const;
  [[nodiscard]] bool is_given_up_before(Utime end) const;
  void take(Stream& stream, std::int64_t number, Fold& fold);
  static void give_up(Stream& stream, Run run, Fold& fold);
  void retire_left_epochs();
  [[nodiscard]] bool may_begin(const Name& name) const;
  [[nodiscard]] std::int64_t room_for_runs() const;
  void retire_unnamed_epochs(const Basis& basis);
  [[nodiscard]] bool leads_to(const Basis& basis) const;
  [[nodiscard]] static bool has_all(const Stream& stream, const BasisEntry& entry);
  void close(Utime tick, Fold& fold);

  Utime gap_give_up_us_;
  std::int64_t max_epochs_;  ///< of each sender that a basis names
  std::map<Name, Stream> streams_;
  std::int64_t streams_begun_ = 0;
  std::map<std::int32_t, std::int64_t> present_epoch_;  ///< by sender: the boot epoch that appeared last
  TeamClock clock_;
};

}  // namespace comptonaut
