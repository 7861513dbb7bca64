// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/batch_key.h"
#include "radiation/measurement_batch.h"

namespace comptonaut {

/// Which batches have come, which have been folded, and which are due: the books behind a coordinator's basis.
/// Per sender and boot epoch batches are folded in the order of their numbers, without a gap but for runs that are
/// given up as lost; those of one tick are folded in the order (utime, sender, boot epoch, number), however they
/// arrived.
class BatchLedger {
 public:
  enum class Entry { kNew, kDuplicate, kGivenUp, kTooMany };

  /// What is folded at one tick, in its order, and the basis after it.
  struct Fold {
    std::vector<MeasurementBatch> batches;
    Basis basis;
    std::int64_t given_up = 0;
  };

  /// A gap is given up once the newest batch is gap_give_up_us newer than the first one after the gap.
  explicit BatchLedger(Utime gap_give_up_us);

  /// Keeps a batch until it is folded.
  Entry enter(const MeasurementBatch& batch);

  /// Start of the batch with the lowest number that `sender` has sent, of those that wait. nullopt: none waits.
  [[nodiscard]] std::optional<Utime> first_utime(std::int32_t sender) const;
  /// Up to where the sender's batches are there, gaps that are given up not counted. nullopt: nowhere.
  [[nodiscard]] std::optional<Utime> reach(std::int32_t sender) const;
  /// End of the newest batch of all. nullopt: none has come.
  [[nodiscard]] std::optional<Utime> newest() const { return newest_; }
  [[nodiscard]] std::int64_t waiting() const;

  /// Folds what is due at `tick`: ends by then, and follows its predecessor or a gap that is given up.
  [[nodiscard]] Fold fold_until(Utime tick);

  /// Folds exactly what leads to `basis`. nullopt, and nothing changed, where batches are missing or where the basis
  /// lacks what has been folded already.
  [[nodiscard]] std::optional<Fold> fold_to(const Basis& basis);

 private:
  using Name = std::pair<std::int32_t, std::int64_t>;  ///< sender, boot epoch
  using Run = std::pair<std::int64_t, std::int64_t>;   ///< first and last number
  struct Stream {
    std::map<std::int64_t, MeasurementBatch> waiting;
    std::int64_t folded = -1;  ///< last number
    std::optional<Utime> folded_end;
    std::vector<Run> given_up;
    std::size_t given_up_before = 0;  ///< of these, in earlier ticks
  };

  [[nodiscard]] Utime given_up_until() const;
  static void take(Stream& stream, std::int64_t number, Fold& fold);
  static void give_up(Stream& stream, Run run, Fold& fold);
  [[nodiscard]] bool leads_to(const Basis& basis) const;
  [[nodiscard]] static bool has_all(const Stream& stream, const BasisEntry& entry);
  void close(Fold& fold);

  Utime gap_give_up_us_;
  std::map<Name, Stream> streams_;
  std::optional<Utime> newest_;
};

}  // namespace comptonaut
