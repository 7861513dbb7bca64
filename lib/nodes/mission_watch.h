// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/time.h"
#include "nodes/truth.h"
#include "radiation/measurement_batch.h"
#include "radiation/source_estimate.h"

namespace comptonaut {

/// Follows a mission from its messages and says in one line how it goes. Without a simulated truth it counts what is
/// reported.
class MissionWatch {
 public:
  void on_measurements(const MeasurementBatch& batch);
  void on_sources(const SourceReport& report);
  void on_truth(const Truth& truth);

  /// Data time since the first message, whole seconds.
  [[nodiscard]] std::int64_t elapsed_s() const;

  /// "  63 s   coverage  41 %   sources found 3 of 5   events 10417 (451 pairs)   14.2 x real time"
  [[nodiscard]] std::string line() const;

 private:
  void see(Utime utime);

  std::optional<Utime> start_;
  Utime now_ = 0;
  std::int64_t singles_ = 0;
  std::int64_t pairs_ = 0;
  std::int64_t others_ = 0;
  std::optional<SourceReport> report_;
  std::optional<Truth> truth_;
};

}  // namespace comptonaut
