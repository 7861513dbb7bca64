// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_world.h"

#include <algorithm>

#include "sim/streams.h"

namespace comptonaut {
namespace {

SimAutopilot autopilot(const Scenario& scenario, std::uint64_t seed, int mav, Utime start_utime) {
  const Eigen::Vector2d& start_W = scenario.mavs.start_W[mav - 1];
  const VehicleLimits limits{.speed_max_m_s = scenario.mavs.speed_max_m_s,
                             .acceleration_max_m_s2 = scenario.mavs.acceleration_max_m_s2};
  const PoseNoise noise(scenario.mismatch.position_sigma_m, scenario.mismatch.attitude_sigma_rad,
                        scenario.mismatch.pose_correlation_s, random_stream(seed, Purpose::kPoseNoise, mav));
  const double z_m = scenario.world.ground_height_m(start_W.x(), start_W.y()).value_or(0.0) + scenario.mavs.height_m;
  return {mav, SimVehicle(limits, {start_W.x(), start_W.y(), z_m}), noise, start_utime, scenario.mavs.endurance_s};
}

std::optional<RangeSensor> range_sensor(const Scenario& scenario, std::uint64_t seed, int mav) {
  if (!scenario.range_sensor) return std::nullopt;
  return RangeSensor(*scenario.range_sensor, random_stream(seed, Purpose::kRange, mav));
}

}  // namespace

SimWorld::SimWorld(const SimCamera& camera, const Scenario& scenario, std::uint64_t seed, Utime start_utime)
    : scenario_(scenario), start_utime_(start_utime), utime_(start_utime), sources_(draw_sources(scenario, seed)) {
  const std::vector<Emitter> points = emitters(sources_, scenario.patch, scenario.nuclide, camera.lines);
  for (int mav = 1; mav <= scenario.mavs.count; ++mav) {
    mavs_.push_back({.autopilot = autopilot(scenario, seed, mav, start_utime),
                     .detector = SimDetector(camera, scenario, points, seed, mav),
                     .range_sensor = range_sensor(scenario, seed, mav)});
  }
  note_distances();
}

std::string SimWorld::stream_start(int mav) { return mavs_[mav - 1].detector.start(start_utime_); }

std::vector<SimAutopilot::Frame> SimWorld::mavlink(int mav) { return mavs_[mav - 1].autopilot.frames(); }

void SimWorld::on_mavlink(int mav, std::span<const std::uint8_t> bytes) { mavs_[mav - 1].autopilot.on_mavlink(bytes); }

std::vector<std::string> SimWorld::step() {
  std::vector<std::string> hits;
  for (Mav& mav : mavs_) {
    mav.autopilot.fly(kStep_us / 2);
    const Eigen::Isometry3d X_WB = mav.autopilot.vehicle().pose().X_WB();
    hits.push_back(mav.detector.step(X_WB, seconds(utime_ - start_utime_), seconds(kStep_us)));
    mav.autopilot.fly(kStep_us / 2);
  }
  utime_ += kStep_us;
  note_distances();
  note_collisions();
  return hits;
}

std::optional<RangePoints> SimWorld::range_points(int mav) {
  Mav& m = mavs_[mav - 1];
  if (!m.range_sensor || !m.range_sensor->is_due(utime_ - start_utime_)) return std::nullopt;
  StampedPose pose = m.autopilot.vehicle().pose();
  pose.utime = utime_;
  return m.range_sensor->scan(scenario_.world, pose);
}

void SimWorld::note_collisions() {
  constexpr double kBody_m = 0.3;
  if (scenario_.world.is_flat()) return;
  for (Mav& mav : mavs_) {
    const Eigen::Vector3d& p_WB = mav.autopilot.vehicle().p_WB();
    const Eigen::Vector3d half_m = Eigen::Vector3d::Constant(kBody_m);
    const bool touches = scenario_.world.closed(Box{.min_W = p_WB - half_m, .max_W = p_WB + half_m});
    if (touches && !mav.touches) ++collisions_;
    mav.touches = touches;
  }
}

void SimWorld::note_distances() {
  for (std::size_t i = 0; i < mavs_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance_m = (mavs_[i].autopilot.vehicle().p_WB() - mavs_[j].autopilot.vehicle().p_WB()).norm();
      distance_min_m_ = std::min(distance_min_m_, distance_m);
    }
  }
}

Truth SimWorld::truth() const {
  Truth truth{.utime = utime_, .start_utime = start_utime_, .scenario = scenario_.name};
  truth.area = scenario_.area;
  truth.sources = sources_;
  for (std::size_t i = 0; i < mavs_.size(); ++i) {
    const StampedPose pose = mavs_[i].autopilot.vehicle().pose();
    truth.mavs.push_back({.mav = static_cast<int>(i) + 1,
                          .p_WB = pose.p_WB,
                          .yaw_rad = yaw_of(pose.q_WB),
                          .photons = mavs_[i].detector.photons()});
  }
  return truth;
}

}  // namespace comptonaut
