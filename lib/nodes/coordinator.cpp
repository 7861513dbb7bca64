// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/coordinator.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "core/hash.h"
#include "nodes/batch_check.h"
#include "nodes/batch_ledger.h"
#include "nodes/dispatch.h"
#include "nodes/map_tiles.h"
#include "nodes/plan_of.h"
#include "nodes/team_estimate.h"
#include "nodes/team_terrain.h"
#include "response/response_table.h"
#include "world/world.h"

namespace comptonaut {
namespace {

constexpr std::int64_t kTerm = 1;  // the machine that leads does so for the whole mission
// A batch that is so much further from its tick than waiting for a gap explains has a strange time.
constexpr Utime kStrange_us = 5 * kSecond_us;

CoordinatorConfig checked(CoordinatorConfig config, const Cells& cells, const ResponseTable& response) {
  if (cells.size() == 0) throw std::invalid_argument("the coordinator has no cells: the area is empty of ground");
  if (config.mavs.empty()) throw std::invalid_argument("the coordinator has no MAVs, must be one at least");
  const auto nuclide = response.facts().find("nuclide");
  if (nuclide != response.facts().end() && nuclide->second != config.nuclide) {
    throw std::invalid_argument(fmt::format("nuclide '{}': must be that of the response table {}, which is {}",
                                            config.nuclide, config.response_table.string(), nuclide->second));
  }
  std::sort(config.mavs.begin(), config.mavs.end());
  config.search.route.fence = fence_of(config);
  return config;
}

}  // namespace

struct Coordinator::Impl {
  struct Refusals {
    std::int64_t mission = 0, sender = 0, content = 0, memory = 0, duplicate = 0, given_up = 0, tiles = 0;
  };

  Impl(const CoordinatorConfig& config_, Cells cells_, const ResponseTable& response, World world_,
       const std::optional<ConeDensity>& cones, const std::vector<MoreNuclide>& more)
      : config(checked(config_, cells_, response)),
        terrain(std::move(world_), std::move(cells_), config.area),
        ledger(microseconds(config.gap_give_up_s), static_cast<int>(config.mavs.size())),
        dispatch(config, search_facts(config, response, more)),
        estimator(config, terrain.cells(), response, cones, more, terrain.world()) {
    for (const int mav : config.mavs) strange_times[mav] = 0;
  }

  [[nodiscard]] std::optional<Utime> next_tick() const;
  [[nodiscard]] std::optional<Utime> first_tick() const;
  [[nodiscard]] bool is_waited_for(int mav, Utime tick) const;
  [[nodiscard]] bool is_complete(Utime tick) const;
  void enter(const TeamBatch& batch);
  void fold(const MeasurementBatch& batch, Utime tick);
  Tick advance(Utime tick, const BatchLedger::Fold& fold);
  [[nodiscard]] std::vector<Plan> plans(Utime tick, const Basis& basis, std::span<const SourceEstimate> sources);
  [[nodiscard]] SourceReport report(Utime tick) const;
  void add_ground(Tick& result, Utime tick);
  [[nodiscard]] std::uint64_t lambda_hash() const;

  CoordinatorConfig config;
  TeamTerrain terrain;
  BatchLedger ledger;
  Dispatch dispatch;
  TeamEstimate estimator;
  std::map<std::int32_t, std::int64_t> strange_times;  ///< batches by MAV
  Utime last_tick = 0;
  Utime map_utime = 0;
  Refusals refused;
  std::int64_t folded = 0, given_up = 0, late = 0, ticks = 0, ticks_late = 0, bases_refused = 0;
};

Coordinator::Coordinator(const CoordinatorConfig& config, Cells cells, const ResponseTable& response, World world,
                         const std::optional<ConeDensity>& cones, const std::vector<MoreNuclide>& more)
    : impl_(std::make_unique<Impl>(config, std::move(cells), response, std::move(world), cones, more)) {}
Coordinator::~Coordinator() = default;
Coordinator::Coordinator(Coordinator&&) noexcept = default;
Coordinator& Coordinator::operator=(Coordinator&&) noexcept = default;

void Coordinator::on_measurements(const MeasurementBatch& batch) { impl_->enter(batch); }

void Coordinator::on_terrain(const TerrainTile& tile) {
  if (fits_map(tile, impl_->terrain.world(), impl_->config.area)) return impl_->enter(tile);
  ++impl_->refused.tiles;
  impl_->enter(TerrainTile{.key = tile.key, .utime = tile.utime, .voxel_m = tile.voxel_m, .voxels = {}});
}

void Coordinator::Impl::enter(const TeamBatch& batch) {
  const BatchKey& key = key_of(batch);
  const auto* measured = std::get_if<MeasurementBatch>(&batch);
  if (key.mission != config.mission) return void(++refused.mission);
  if (!std::ranges::binary_search(config.mavs, key.sender)) return void(++refused.sender);
  const bool sane = measured != nullptr ? is_sane(*measured, config.area) : is_sane(std::get<TerrainTile>(batch));
  if (!sane) return void(++refused.content);
  switch (ledger.enter(batch)) {
    case BatchLedger::Entry::kNew:
      return;
    case BatchLedger::Entry::kDuplicate:
      return void(++refused.duplicate);
    case BatchLedger::Entry::kGivenUp:
      return void(++refused.given_up);
    case BatchLedger::Entry::kTooMany:
      return void(++refused.memory);
  }
}

/// nullopt until the team's time is there. A pause of the team is no reason for ticks.
std::optional<Utime> Coordinator::Impl::next_tick() const {
  std::optional<Utime> tick = first_tick();
  if (last_tick > 0) {
    const Utime earliest = ledger.earliest_end().value_or(0);
    tick = std::max(last_tick + kSecond_us, floor_to(earliest + kSecond_us - 1, kSecond_us));
  }
  return tick && ledger.clock().now() >= tick ? tick : std::nullopt;
}

/// The end of the second in which the last of the team began; a clock that is ahead is not waited for.
std::optional<Utime> Coordinator::Impl::first_tick() const {
  std::optional<Utime> begin;
  for (const int mav : config.mavs) {
    const auto first = ledger.first_utime(mav);
    if (first <= ledger.clock().now()) begin = std::max(begin, first);
  }
  return begin ? std::optional(floor_to(*begin, kSecond_us) + kSecond_us) : std::nullopt;
}

bool Coordinator::Impl::is_waited_for(int mav, Utime tick) const {
  const std::optional<Utime> reach = ledger.reach(mav);
  if (last_tick == 0 && !reach) return true;
  const bool silent = *ledger.clock().now() - reach.value_or(0) > microseconds(config.gap_give_up_s);
  return !silent && reach < tick;
}

bool Coordinator::Impl::is_complete(Utime tick) const {
  return std::ranges::none_of(config.mavs, [&](int mav) { return is_waited_for(mav, tick); });
}

std::optional<Coordinator::Tick> Coordinator::tick_if_complete() {
  const auto tick = impl_->next_tick();
  if (!tick || !impl_->is_complete(*tick)) return std::nullopt;
  return impl_->advance(*tick, impl_->ledger.fold_until(*tick));
}

std::optional<Coordinator::Tick> Coordinator::tick_latest_complete() {
  const auto next = impl_->next_tick();
  if (!next || !impl_->is_complete(*next)) return std::nullopt;
  Utime tick = floor_to(*impl_->ledger.clock().now(), kSecond_us);
  while (tick > *next && !impl_->is_complete(tick)) tick -= kSecond_us;
  if (tick > *next) ++impl_->ticks_late;
  return impl_->advance(tick, impl_->ledger.fold_until(tick));
}

std::optional<Coordinator::Tick> Coordinator::tick_anyway() {
  const auto tick = impl_->next_tick();
  return tick ? std::optional(impl_->advance(*tick, impl_->ledger.fold_until(*tick))) : std::nullopt;
}

std::optional<Coordinator::Tick> Coordinator::follow(Utime tick, const Basis& basis) {
  if (tick <= impl_->last_tick || tick % kSecond_us != 0) return ++impl_->bases_refused, std::nullopt;
  const auto fold = impl_->ledger.fold_to(tick, basis);
  return fold ? std::optional(impl_->advance(tick, *fold)) : std::nullopt;
}

/// The one way in which the state changes, for leaders and followers alike.
Coordinator::Tick Coordinator::Impl::advance(Utime tick, const BatchLedger::Fold& due) {
  dispatch.begin_tick();
  for (const MeasurementBatch& batch : due.batches) fold(batch, tick);
  if (terrain.fold(due.tiles)) estimator.set_terrain(terrain.world());
  estimator.update();
  given_up += due.given_up;
  last_tick = tick;
  ++ticks;
  const CoordinatorState state{.mission = config.mission,
                               .utime = tick,
                               .sender = config.machine,
                               .term = kTerm,
                               .lease_us = microseconds(config.lease_s),
                               .terrain_hash = terrain.hash(),
                               .basis = due.basis,
                               .lambda_hash = lambda_hash(),
                               .cones = estimator.rows(),
                               .viewpoints = estimator.viewpoints()};
  SourceReport found = report(tick);
  std::vector<Plan> next = plans(tick, due.newest, found.sources);
  Tick result{.state = state, .plans = std::move(next), .sources = std::move(found)};
  add_ground(result, tick);
  return result;
}

void Coordinator::Impl::fold(const MeasurementBatch& batch, Utime tick) {
  estimator.add(batch);
  ++folded;
  if (batch.end_utime() <= last_tick) ++late;
  const bool strange = std::abs(tick - batch.end_utime()) > microseconds(config.gap_give_up_s) + kStrange_us;
  if (strange) ++strange_times[batch.key.sender];
  dispatch.see(batch);
}

std::vector<Plan> Coordinator::Impl::plans(Utime tick, const Basis& basis, std::span<const SourceEstimate> sources) {
  const TeamEstimate::Ground ground = estimator.ground();
  const std::vector<std::vector<Look>> looks = estimator.looks();
  std::vector<Plan> plans = dispatch.plans({.cells = terrain.cells(),
                                            .world = terrain.world(),
                                            .lambda_Bq = ground.lambda_Bq,
                                            .sensitivity_s = ground.pair_sensitivity_s,
                                            .sources = sources,
                                            .looks = looks},
                                           tick, kTerm);
  for (Plan& plan : plans) plan.basis = basis;
  return plans;
}

SourceReport Coordinator::Impl::report(Utime tick) const {
  SourceReport report = estimator.report();
  report.mission = config.mission;
  report.utime = tick;
  return report;
}

std::uint64_t Coordinator::Impl::lambda_hash() const {
  Fnv1a sum;
  for (const TeamEstimate::NuclideMap& map : estimator.maps()) {
    for (const double lambda_Bq : map.lambda_Bq) sum.add(lambda_Bq);
  }
  return sum.value();
}

void Coordinator::Impl::add_ground(Tick& result, Utime tick) {
  result.patches = estimator.patches();
  if (result.patches) result.patches->mission = config.mission, result.patches->utime = tick;
  if (map_utime > 0 && tick - map_utime < microseconds(config.map_period_s)) return;
  map_utime = tick;
  for (const TeamEstimate::NuclideMap& map : estimator.maps()) {
    for (MapTile& tile : map_tiles(terrain.cells(), map.lambda_Bq, map.sensitivity_s)) {
      tile.nuclide = map.nuclide;
      result.map.push_back(std::move(tile));
    }
  }
  result.clearance = estimator.clearance();
  for (MapTile& tile : result.map) tile.mission = config.mission, tile.utime = tick;
  for (ClearanceTile& tile : result.clearance) tile.mission = config.mission, tile.utime = tick;
}

std::span<const double> Coordinator::lambda_Bq() const { return impl_->estimator.maps()[0].lambda_Bq; }

std::span<const double> Coordinator::sensitivity_s() const { return impl_->estimator.maps()[0].sensitivity_s; }

std::vector<Counter> Coordinator::counters() const {
  const Impl::Refusals& refused = impl_->refused;
  std::vector<Counter> counters = {{"ticks", impl_->ticks},
                                   {"ticks_late", impl_->ticks_late},
                                   {"batches_folded", impl_->folded},
                                   {"batches_folded_late", impl_->late},
                                   {"batches_waiting", impl_->ledger.waiting()},
                                   {"batches_given_up", impl_->given_up},
                                   {"batches_duplicate", refused.duplicate},
                                   {"batches_after_giving_up", refused.given_up},
                                   {"batches_refused_mission", refused.mission},
                                   {"batches_refused_sender", refused.sender},
                                   {"batches_refused_content", refused.content},
                                   {"batches_refused_memory", refused.memory},
                                   {"bases_refused", impl_->bases_refused},
                                   {"tiles_refused_voxels", refused.tiles}};
  for (const Counter& counter : impl_->terrain.counters()) counters.push_back(counter);
  for (const Counter& counter : impl_->estimator.counters()) counters.push_back(counter);
  for (const auto& [mav, batches] : impl_->strange_times) {
    counters.push_back({fmt::format("mav{}_strange_times", mav), batches});
    counters.push_back({fmt::format("mav{}_ahead_ms", mav), impl_->ledger.clock().ahead_us(mav) / 1000});
  }
  return counters;
}

}  // namespace comptonaut
