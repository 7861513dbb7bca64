// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "flight/plan.h"
#include "flight/team_flight.h"
#include "nodes/coordinator_config.h"
#include "radiation/measurement_batch.h"
#include "search/strategy.h"

namespace comptonaut {

/// Knows where the MAVs are and tells each where to fly: what the strategy proposes, made flyable; home when its
/// battery is nearly used up or its detector is dead; nothing when it has not been heard of. A function of the batches
/// that it saw, tick by tick.
class Dispatch {
 public:
  Dispatch(const CoordinatorConfig& config, const SearchFacts& facts);

  /// The batches of a tick are about to come.
  void begin_tick();
  void see(const MeasurementBatch& batch);

  /// What a strategy sees besides the MAVs.
  struct Map {
    const Cells& cells;
    const World& world;
    std::span<const double> lambda_Bq, sensitivity_s;
    std::span<const SourceEstimate> sources;
    std::span<const std::vector<Look>> looks = {};
  };

  /// One plan per MAV, by number, its status in words; none with strategy "none". One that has been lost for long gets
  /// none any more, so that it returns on its own.
  [[nodiscard]] std::vector<Plan> plans(const Map& map, Utime tick, std::int64_t term);

 private:
  struct Mav {
    Searcher searcher;
    Utime first_utime = 0, last_utime = 0;                            ///< of its positions
    Utime live_utime = 0;                                             ///< when its detector last measured
    Utime tick_utime = 0;                                             ///< of this tick's newest one; 0: none
    double begin_percent = std::numeric_limits<double>::quiet_NaN();  ///< of its battery, when it was first told,
    double battery_percent = begin_percent;                           ///< and last; NaN: never
    Utime begin_utime = 0;
    Eigen::Vector3d home_W = Eigen::Vector3d::Zero();
    bool goes_home = false;
  };

  [[nodiscard]] bool is_lost(const Mav& mav, Utime tick) const;
  /// Why it is to fly home, in a word; empty: it is not.
  [[nodiscard]] static std::string_view why_home(const Mav& mav, Utime tick);
  static void note_battery(const MeasurementBatch& batch, Mav& mav);
  /// Until its battery is down to the reserve, s; infinite where that cannot be told.
  [[nodiscard]] double battery_left_s(const Mav& mav) const;
  [[nodiscard]] bool must_go_home(const World& world, const RouteConfig& route, const Mav& mav, Utime tick) const;
  [[nodiscard]] std::map<std::int32_t, Course> search_courses(const Map& map, Utime tick);
  /// Of the separation, what is kept while one flies home.
  [[nodiscard]] double home_share(const RouteConfig& route) const;
  [[nodiscard]] Course home_course(const World& world, const RouteConfig& route, const Mav& mav, Utime tick) const;
  /// Where others hang in the air and will not leave.
  [[nodiscard]] std::vector<Leg> standing(const Mav& mav, Utime tick) const;

  CoordinatorConfig config_;
  SearchFacts facts_;
  std::unique_ptr<Strategy> strategy_;
  TeamFlight team_flight_;
  std::map<std::int32_t, Mav> mavs_;
};

}  // namespace comptonaut
