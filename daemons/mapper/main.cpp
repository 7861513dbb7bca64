// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "bus/daemon.h"
#include "bus/log.h"
#include "config/config.h"
#include "nodes/mapper.h"

using namespace comptonaut;

int main(int argc, char** argv) {
  std::string journal_file;
  const std::vector<ExtraOption> options = {
      {"--journal", "file for the batches, instead of a new one in the configuration's journal_dir", &journal_file}};
  return run_daemon(
      argc, argv, "comptonaut-mapper", "Gives events and range points the pose of their moment.", options,
      [&](const DaemonArguments& arguments) {
        const MapperConfig config = load_config(arguments.config, read_mapper_config);
        if (arguments.mav == 0) throw std::runtime_error("a mapper needs --mav N, the number of its MAV");
        const Utime boot_epoch = wall_clock_utime();
        const auto channel = [&](const char* what) { return mav_channel(arguments.mav, what); };
        const std::string own_file = fmt::format("{}-{}.lcm", channel("MEASUREMENTS"), boot_epoch);
        LogWriter journal(journal_file.empty() ? config.journal_dir / own_file : std::filesystem::path(journal_file));
        std::int64_t journal_failures = 0;

        EventLoop loop;
        Bus bus(arguments.lcm_url);
        Mapper mapper(config, {.mission = config.mission, .sender = arguments.mav, .boot_epoch = boot_epoch},
                      load_world(config.terrain));
        const auto put = [&](const std::string& on, const Bytes& bytes) {
          journal_failures += journal.append({wall_clock_utime(), on, bytes}) ? 0 : 1;
          bus.publish_raw(on, bytes);
        };
        const auto send = [&](const std::vector<MeasurementBatch>& batches) {
          for (const MeasurementBatch& batch : batches) put(channel("MEASUREMENTS"), encode(batch));
          for (const TerrainTile& tile : mapper.take_terrain()) put(channel("TERRAIN"), encode(tile));
        };
        bus.subscribe<StampedPose>(channel("POSE"), [&](const auto&, const auto& pose) { send(mapper.on_pose(pose)); });
        bus.subscribe<EventBatch>(channel("EVENTS"),
                                  [&](const auto&, const auto& events) { send(mapper.on_events(events)); });
        bus.subscribe<RangePoints>(channel("POINTS"),
                                   [&](const auto&, const auto& points) { mapper.on_points(points); });
        bus.subscribe<VehicleState>(channel("VEHICLE"),
                                    [&](const auto&, const auto& vehicle) { mapper.on_vehicle(vehicle); });
        loop.watch(bus);
        loop.every(std::chrono::milliseconds(std::lround(1e3 * config.fsync_period_s)),
                   [&] { journal_failures += journal.sync() ? 0 : 1; });
        publish_status(loop, bus, arguments, "mapper", [&] {
          DaemonStatus status{.utime = mapper.utime(), .state = "running", .counters = mapper.counters()};
          status.counters.push_back({"journal_failures", journal_failures});
          return status;
        });
        loop.run();
        send(mapper.on_end());
      });
}
