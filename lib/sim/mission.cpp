// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>
#include <stop_token>

#include "bus/codec.h"
#include "nodes/coordinator.h"
#include "radiation/cramer_rao.h"
#include "sim/sim_world.h"
#include "world/world.h"

namespace comptonaut {
namespace {

/// 2024-01-01 00:00:00 UTC: any whole second does.
constexpr Utime kStart = 1'704'067'200 * kSecond_us;
/// A tick comes at most this long after its second.
constexpr Utime kTickDelayMax_us = 10 * kSecond_us;

/// Processor time of this thread: does not depend on what else the machine does.
double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A message as the receiver gets it.
template <class T>
T passed(const T& message) {
  const auto received = decode<T>(encode(message));
  if (!received) throw std::logic_error("a node sent a message that its receiver refuses");
  return *received;
}

/// The daemons of one drone.
struct Drone {
  DetectorReader reader;
  PoseBridge bridge;
  Mapper mapper;
};

Drone drone(const MissionSetup& setup, int mav) {
  const BatchKey first_key{.mission = setup.coordinator.mission, .sender = mav, .boot_epoch = kStart};
  PoseBridgeConfig bridge = setup.pose_bridge;
  bridge.pilot.mav = mav;
  return {.reader = DetectorReader(setup.detector_reader, setup.calibration, first_key),
          .bridge = PoseBridge(bridge),
          .mapper = Mapper(setup.mapper, first_key, setup.scenario.team_world())};
}

CramerRao cramer_rao(const MissionSetup& setup, const std::vector<TrueSource>& sources) {
  std::vector<PointSource> truth;
  for (const TrueSource& source : sources) {
    truth.push_back({.p_W = source.p_W, .activity_Bq = source.activity_Bq, .nuclide = source.nuclide});
  }
  return {joint_channels(setup.coordinator, {setup.response, *setup.cones}, setup.more_nuclides), truth,
          setup.coordinator.mavs, setup.scenario.world};
}

class Mission {
 public:
  Mission(const MissionSetup& setup, std::uint64_t seed)
      : setup_(setup),
        world_(setup.camera, setup.scenario, seed, kStart),
        coordinator_(setup.coordinator,
                     setup.scenario.team_world().surface_cells(setup.coordinator.area, setup.coordinator.cell_m),
                     setup.response, setup.scenario.team_world(), setup.cones, setup.more_nuclides),
        fence_(fence_of(setup.coordinator)) {
    for (int mav = 1; mav <= world_.mavs(); ++mav) {
      drones_.push_back(drone(setup, mav));
      on_hits(mav, world_.stream_start(mav));
    }
    if (setup.cones) bound_ = cramer_rao(setup, world_.sources());
    result_.seed = seed;
    result_.sources = world_.sources();
    result_.tracks.resize(drones_.size());
  }

  MissionResult fly(std::atomic<std::int64_t>& seconds_done, const std::stop_token& stop) {
    const auto steps = static_cast<std::size_t>(setup_.scenario.horizon_s);
    while (result_.steps.size() < steps) {
      if (stop.stop_requested()) throw std::runtime_error("stopped in flight");
      step();
      while (result_.steps.size() < steps) {
        const auto tick = coordinator_.tick_if_complete();
        if (!tick) break;
        on_tick(*tick);
        ++seconds_done;
      }
      check_progress();
    }
    result_.distance_min_m = world_.distance_min_m();
    for (int mav = 1; mav <= world_.mavs(); ++mav) {
      const Eigen::Vector3d from_home_W = world_.p_WB(mav) - result_.tracks[mav - 1].front().cast<double>();
      if (from_home_W.norm() <= setup_.coordinator.search.reach_m) ++result_.at_home;
    }
    result_.collisions = world_.collisions();
    return result_;
  }

 private:
  [[nodiscard]] double now_s() const { return seconds(world_.utime() - kStart); }

  void step() {
    if ((world_.utime() - kStart) % kTrackPeriod_us == 0) note_places();
    const bool whole_second = (world_.utime() - kStart) % kSecond_us == 0;
    for (int mav = 1; mav <= world_.mavs(); ++mav) {
      for (const auto& frame : world_.mavlink(mav)) on_bridge(mav, bridge(mav).on_mavlink(frame, now_s()));
      if (whole_second) on_bridge(mav, bridge(mav).on_timer(now_s()));
    }
    const std::vector<std::string> hits = world_.step();
    for (int mav = 1; mav <= world_.mavs(); ++mav) {
      if (const auto points = world_.range_points(mav)) drones_[mav - 1].mapper.on_points(passed(*points));
      on_hits(mav, hits[mav - 1]);
    }
  }

  void note_places() {
    for (int mav = 1; mav <= world_.mavs(); ++mav) {
      const Eigen::Vector3d p_WB = world_.p_WB(mav);
      result_.tracks[mav - 1].emplace_back(p_WB.cast<float>());
      if (!fence_.contains(p_WB)) result_.outside_s += seconds(kTrackPeriod_us);
    }
  }

  void on_bridge(int mav, const PoseBridge::Output& output) {
    for (const auto& frame : output.to_autopilot) world_.on_mavlink(mav, frame);
    if (output.vehicle) drones_[mav - 1].mapper.on_vehicle(passed(*output.vehicle));
    if (!output.pose) return;
    const StampedPose pose = passed(*output.pose);
    on_measurements(mav, drones_[mav - 1].mapper.on_pose(pose));
    for (int other = 1; other <= world_.mavs(); ++other) {
      if (other != mav) bridge(other).on_other_pose(mav, pose);
    }
  }

  void on_hits(int mav, const std::string& text) {
    for (const EventBatch& batch : drones_[mav - 1].reader.on_bytes(text)) {
      const EventBatch events = passed(batch);
      tally(events);
      on_measurements(mav, drones_[mav - 1].mapper.on_events(events));
    }
  }

  void on_measurements(int mav, const std::vector<MeasurementBatch>& batches) {
    for (const MeasurementBatch& batch : batches) {
      coordinator_.on_measurements(passed(batch));
      if (bound_) bound_->add(batch);
    }
    for (const TerrainTile& tile : drones_[mav - 1].mapper.take_terrain()) coordinator_.on_terrain(passed(tile));
  }

  void on_tick(const Coordinator::Tick& tick) {
    for (const Plan& plan : tick.plans) bridge(plan.mav).on_plan(passed(plan), now_s());
    result_.steps.push_back(judge(passed(tick.sources), world_.sources(), setup_.scenario, kStart));
    if (bound_) result_.steps.back().crb_m = bound_->rmse_m();
    if (tick.patches) judge_patches(passed(*tick.patches), result_.steps.back());
  }

  void judge_patches(const PatchReport& report, Judgement& judgement) const {
    judgement.patches = static_cast<int>(report.patches.size());
    if (setup_.scenario.patch) judgement.patch = patch_error(report, *setup_.scenario.patch);
  }

  void tally(const EventBatch& batch) {
    result_.events.others += batch.others;
    for (const ChannelCounts& channel : batch.channels) {
      result_.events.singles += channel.singles;
      result_.events.pairs += channel.pairs;
    }
  }

  void check_progress() const {
    const Utime next = kStart + static_cast<Utime>(result_.steps.size() + 1) * kSecond_us;
    if (world_.utime() > next + kTickDelayMax_us) {
      throw std::logic_error(
          fmt::format("seed {}: no tick of the coordinator for {} s", result_.seed, result_.steps.size() + 1));
    }
  }

  PoseBridge& bridge(int mav) { return drones_[mav - 1].bridge; }

  const MissionSetup& setup_;
  SimWorld world_;
  Coordinator coordinator_;
  std::vector<Drone> drones_;
  Fence fence_;
  MissionResult result_;
  std::optional<CramerRao> bound_;  ///< where the cones' density is known
};

}  // namespace

MissionResult fly_mission(const MissionSetup& setup, std::uint64_t seed, std::atomic<std::int64_t>& seconds_done,
                          const std::stop_token& stop) {
  const double start_s = thread_cpu_s();
  MissionResult result = Mission(setup, seed).fly(seconds_done, stop);
  result.cpu_s = thread_cpu_s() - start_s;
  return result;
}

}  // namespace comptonaut
