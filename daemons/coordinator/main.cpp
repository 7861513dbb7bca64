// SPDX-License-Identifier: BSD-3-Clause
#include "bus/daemon.h"
#include "bus/publish_tick.h"
#include "config/config.h"
#include "nodes/bases_to_follow.h"
#include "nodes/coordinator.h"
#include "response/response_table.h"

using namespace comptonaut;

int main(int argc, char** argv) {
  bool follow = false;
  return run_daemon(
      argc, argv, "comptonaut-coordinator", "Holds the team's map and says who flies where.",
      {{.name = "--follow", .help = "tick by announced bases, on FOLLOWER_ channels", .flag = &follow}},
      [&](const DaemonArguments& arguments) {
        CoordinatorConfig config = load_config(arguments.config, read_coordinator_config);
        config.machine = arguments.mav;
        const World world = load_world(config.terrain);
        Coordinator coordinator(config, world.surface_cells(config.area, config.cell_m),
                                ResponseTable::load(config.response_table), world, load_cone_density(config),
                                load_more_nuclides(config));
        BasesToFollow bases;
        Bus bus(arguments.lcm_url);
        EventLoop loop;
        PacedPublisher map(loop, bus);
        DaemonStatus status{.state = follow ? "following" : "leading"};
        double last_tick_s = monotonic_s(arguments);
        const auto publish = [&](const Coordinator::Tick& tick) {
          publish_tick(bus, map, tick, follow ? "FOLLOWER_" : "");  // nobody flies by what a follower says
          status.utime = tick.state.utime;
          last_tick_s = monotonic_s(arguments);
        };
        const auto advance = [&] {
          while (const auto tick = follow ? bases.next(coordinator) : coordinator.tick_latest_complete()) {
            publish(*tick);
          }
        };
        bus.subscribe<MeasurementBatch>("MAV[0-9]+_MEASUREMENTS", [&](const auto&, const MeasurementBatch& batch) {
          coordinator.on_measurements(batch);
        });
        bus.subscribe<TerrainTile>("MAV[0-9]+_TERRAIN", [&](auto&, const auto& tile) { coordinator.on_terrain(tile); });
        bus.subscribe<CoordinatorState>("COORDINATOR", [&](const auto&, const CoordinatorState& state) {
          if (follow) bases.on_state(state);
        });
        loop.watch(bus, advance);
        // A leader keeps its lease: rather a tick with what is there than none.
        loop.every(std::chrono::milliseconds(20), [&] {
          if (follow || monotonic_s(arguments) - last_tick_s < config.lease_s / 2) return;
          if (const auto tick = coordinator.tick_anyway()) publish(*tick);
        });
        publish_status(loop, bus, arguments, "coordinator", [&] {
          status.counters = coordinator.counters();
          for (Counter& counter : bases.counters()) status.counters.push_back(std::move(counter));
          return status;
        });
        loop.run();
      });
}
