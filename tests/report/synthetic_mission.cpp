// SPDX-License-Identifier: BSD-3-Clause
#include "report/synthetic_mission.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bus/bus.h"
#include "bus/log.h"
#include "core/random.h"

namespace comptonaut {
namespace {

constexpr double kHeight_m = 2.0;
constexpr double kSpeed_m_s = 8.0;
constexpr double kLane_m = 2.0;
constexpr Utime kPosePeriod_us = 100'000;

class Synthesis {
 public:
  explicit Synthesis(const SyntheticConfig& config) : config_(config), random_(config.seed) {
    for (int attempt = 0; truth_.size() < 5 && attempt < 1000; ++attempt) {
      const Eigen::Vector3d p_W(random_.uniform(3, edge() - 3), random_.uniform(3, edge() - 3), 0.0);
      const auto near = [&](const TrueSource& s) { return (s.p_W - p_W).norm() < 0.16 * edge(); };
      if (std::none_of(truth_.begin(), truth_.end(), near)) truth_.push_back({"Cs-137", p_W, 2e9});
    }
    for (std::size_t i = 0; i < truth_.size(); ++i)
      found_at_s_.push_back(config.duration_s * random_.uniform(0.05, 0.6));
  }

  std::vector<Sent> run() {
    for (Utime t = 0; t <= config_.duration_s * kSecond_us; t += kBatch_us) {
      for (int mav = 1; mav <= config_.drones; ++mav) {
        if (t % kPosePeriod_us == 0) send(mav, "POSE", pose(mav, t));
        if (t < config_.duration_s * kSecond_us) send(mav, "MEASUREMENTS", batch(mav, t));
        if (t % kSecond_us == 0) send_each_second(mav, t);
      }
      if (t % kSecond_us == 0) send_tick(t);
    }
    return std::move(sent_);
  }

 private:
  [[nodiscard]] double edge() const { return config_.edge_m; }
  static double t_s(Utime t) { return seconds(t); }

  template <class T>
  void send(int mav, const std::string& name, T message) {
    sent_.push_back({mav < 0 ? name : mav_channel(mav, name), mav, std::move(message)});
  }

  /// Each drone sweeps a strip of its own in lanes, to and fro.
  [[nodiscard]] Eigen::Vector3d position(int mav, double at_s) const {
    const double strip_m = edge() / config_.drones, lanes = std::floor(strip_m / kLane_m);
    const double along_m = kSpeed_m_s * at_s, per_lane_m = edge() + kLane_m;
    const double lane = std::floor(along_m / per_lane_m), within_m = along_m - lane * per_lane_m;
    const double sweep = std::fmod(lane, 2 * lanes), folded = sweep < lanes ? sweep : 2 * lanes - 1 - sweep;
    const double y_m = std::min(within_m, edge());
    const double aside_m = std::max(0.0, within_m - edge()) * (sweep < lanes ? 1 : -1);
    const double x_m = (mav - 1) * strip_m + (folded + 0.5) * kLane_m + aside_m;
    return {std::clamp(x_m, 0.5, edge() - 0.5), std::fmod(lane, 2) == 0 ? y_m : edge() - y_m, kHeight_m};
  }

  [[nodiscard]] Eigen::Vector3d velocity(int mav, double at_s) const {
    return (position(mav, at_s + 0.05) - position(mav, at_s - 0.05)) / 0.1;
  }

  StampedPose pose(int mav, Utime t) {
    StampedPose pose{.utime = kSyntheticStart + t};
    pose.p_WB = position(mav, t_s(t)) + 0.02 * Eigen::Vector3d(random_.normal(), random_.normal(), random_.normal());
    pose.v_WB_B = velocity(mav, t_s(t));
    return pose;
  }

  MeasurementBatch batch(int mav, Utime t) {
    MeasurementBatch batch{.key = {.mission = 1, .sender = mav, .boot_epoch = kSyntheticStart, .number = t / kBatch_us},
                           .utime = kSyntheticStart + t,
                           .live_us = static_cast<std::int32_t>(kBatch_us - 300)};
    batch.p_WD = position(mav, t_s(t + kBatch_us / 2));
    double per_s = 3.0;
    for (const TrueSource& source : truth_) {
      per_s += source.activity_Bq * 1.1e-6 * 0.85 / (batch.p_WD - source.p_W).squaredNorm() / 25.0;
    }
    const auto count = [&](double share) { return static_cast<std::int32_t>(random_.poisson(share * per_s * 0.05)); };
    batch.channels.push_back({.nuclide = "Cs-137", .singles = count(0.934), .pairs = count(0.043)});
    batch.others = count(0.023);
    return batch;
  }

  void send_each_second(int mav, Utime t) {
    send(mav, "POSE_QUALITY",
         PoseQuality{.utime = kSyntheticStart + t, .position_sigma_m = 0.02, .quality_percent = 90});
    VehicleState vehicle{.utime = kSyntheticStart + t,
                         .sender = mav,
                         .connected = true,
                         .armed = true,
                         .mode = "OFFBOARD",
                         .battery_percent = 100.0 - 0.1 * t_s(t)};
    vehicle.p_WHome = {1.0, 1.0, 0.0};
    send(mav, "VEHICLE", vehicle);
    Plan plan{.mission = 1,
              .utime = kSyntheticStart + t,
              .mav = mav,
              .term = 1,
              .number = t / kSecond_us,
              .status = "searching"};
    for (int k = 1; k <= 4; ++k)
      plan.waypoints.push_back({.p_W = position(mav, t_s(t) + 3.0 * k), .speed_max_m_s = kSpeed_m_s});
    send(mav, "PLAN", plan);
    for (const char* daemon : {"detector-reader", "mapper", "pose-bridge", "team-link"}) send_status(mav, daemon, t);
  }

  void send_status(int mav, const char* daemon, Utime t) {
    const auto rows = static_cast<std::int64_t>(20 * t_s(t));
    DaemonStatus status{.utime = kSyntheticStart + t,
                        .sender = mav,
                        .daemon = daemon,
                        .version = "0.1.0",
                        .state = "running",
                        .counters = {{"messages", rows}, {"messages_refused", 0}}};
    if (mav == 2 && std::string(daemon) == "detector-reader") status.counters.push_back({"rows_refused", 3});
    send(mav, "STATUS", status);
  }

  /// Where the estimate of a source is: far until it is found, then nearing.
  Eigen::Vector3d estimate(std::size_t source, double at_s) {
    const double error_m =
        at_s < found_at_s_[source] ? 6.0 : 0.15 + 3.0 * std::exp(-(at_s - found_at_s_[source]) / 12.0);
    return truth_[source].p_W + error_m * Eigen::Vector3d(std::cos(3.0 * source), std::sin(3.0 * source), 0.0);
  }

  void send_tick(Utime t) {
    if (config_.with_truth) send_truth(t);
    SourceReport report{.mission = 1,
                        .utime = kSyntheticStart + t,
                        .estimator = config_.estimator,
                        .coverage = static_cast<double>(static_cast<float>(
                            std::min(1.0, t_s(t) * kSpeed_m_s * 3 * config_.drones / (edge() * edge()))))};
    for (std::size_t i = 0; i < truth_.size() && t > 0; ++i) {
      const double sharpness = std::min(1.0, t_s(t) / config_.duration_s + 0.3);
      report.sources.push_back(
          {.nuclide = "Cs-137", .p_W = estimate(i, t_s(t)), .activity_Bq = 1.9e9 * sharpness * (1 - 0.02 * i)});
    }
    send(-1, "SOURCES", report);
    send(-1, "COORDINATOR",
         CoordinatorState{.mission = 1,
                          .utime = kSyntheticStart + t,
                          .term = 1,
                          .lease_us = kSecond_us,
                          .cones = static_cast<std::int64_t>(8 * t_s(t)),
                          .viewpoints = 60 * t / kSecond_us});
    send_status(0, "coordinator", t);
    send_map(report, t);
  }

  void send_truth(Utime t) {
    Truth truth{.utime = kSyntheticStart + t,
                .start_utime = kSyntheticStart,
                .scenario = "werner2024-sim",
                .time_scale = 4.0,
                .area = {0, edge(), 0, edge()},
                .sources = truth_};
    for (int mav = 1; mav <= config_.drones; ++mav) truth.mavs.push_back({.mav = mav, .p_WB = position(mav, t_s(t))});
    send(-1, "SIM_TRUTH", truth);
  }

  void send_map(const SourceReport& report, Utime t) {
    const Cells cells = flat_cells({0, edge(), 0, edge()}, config_.cell_m);
    const double width_m = 0.8 + 6.0 * std::exp(-3.0 * t_s(t) / config_.duration_s);
    std::vector<MapCell> values;
    for (std::size_t j = 0; j < cells.size(); ++j) {
      const Eigen::Vector3d& p_W = cells.p_W(j);
      double lambda_Bq = 2e5 * (1.5 + std::sin(0.4 * p_W.x()) * std::cos(0.3 * p_W.y()));
      for (const SourceEstimate& source : report.sources) {
        const double d_m = (p_W - source.p_W).norm() / width_m;
        lambda_Bq += source.activity_Bq * std::exp(-0.5 * d_m * d_m) * 0.04 / (width_m * width_m);
      }
      sensitivity(j, p_W, cells.size(), t);
      values.push_back({cells.key(j), lambda_Bq, sensitivity_s_[j]});
    }
    std::vector<MapTile> tiles;
    for (const MapCell& cell : values) {
      const bool fits = !tiles.empty() && tiles.back().cells.size() < kMaxCellsPerTile &&
                        cell.key.x - tiles.back().cells.front().key.x >= 0;
      if (!fits) {
        tiles.push_back({.mission = 1,
                         .utime = kSyntheticStart + t,
                         .nuclide = "Cs-137",
                         .cell_m = config_.cell_m,
                         .tile = static_cast<std::int32_t>(tiles.size())});
      }
      tiles.back().cells.push_back(cell);
    }
    for (MapTile& tile : tiles) {
      tile.tiles = static_cast<std::int32_t>(tiles.size());
      send(-1, "RADIATION_MAP", std::move(tile));
    }
  }

  /// Grows by what the drones saw of the cell in the last second.
  void sensitivity(std::size_t j, const Eigen::Vector3d& p_W, std::size_t cells, Utime t) {
    sensitivity_s_.resize(cells);
    for (int mav = 1; mav <= config_.drones; ++mav) {
      for (double back_s = 0.0; back_s < 1.0; back_s += 0.25) {
        sensitivity_s_[j] += 0.25 * 6e-8 / (position(mav, std::max(0.0, t_s(t) - back_s)) - p_W).squaredNorm();
      }
    }
  }

  SyntheticConfig config_;
  Random random_;
  std::vector<TrueSource> truth_;
  std::vector<double> found_at_s_;
  std::vector<double> sensitivity_s_;
  std::vector<Sent> sent_;
};

/// Calls the recorder's function for a message.
struct Teller {
  MissionRecorder& recorder;
  int mav;
  void operator()(const MeasurementBatch& m) const { recorder.on_measurements(m); }
  void operator()(const StampedPose& m) const { recorder.on_pose(mav, m); }
  void operator()(const PoseQuality& m) const { recorder.on_pose_quality(mav, m); }
  void operator()(const VehicleState& m) const { recorder.on_vehicle(mav, m); }
  void operator()(const Plan& m) const { recorder.on_plan(mav, m); }
  void operator()(const DaemonStatus& m) const { recorder.on_status(mav, m); }
  void operator()(const SourceReport& m) const { recorder.on_sources(m); }
  void operator()(const MapTile& m) const { recorder.on_map(m); }
  void operator()(const CoordinatorState& m) const { recorder.on_coordinator(m); }
  void operator()(const Truth& m) const { recorder.on_truth(m); }
};

}  // namespace

std::vector<Sent> synthetic_mission(const SyntheticConfig& config) { return Synthesis(config).run(); }

MissionRecord record_of(const std::vector<Sent>& sent) {
  MissionRecorder recorder;
  for (const Sent& one : sent) std::visit(Teller{recorder, one.mav}, one.message);
  return std::move(recorder).finish();
}

void write_log(const std::vector<Sent>& sent, const std::filesystem::path& file) {
  std::filesystem::remove(file);
  LogWriter writer(file);
  Utime logged_utime = kSyntheticStart;
  for (const Sent& one : sent) {
    const Bytes bytes = std::visit([](const auto& message) { return encode(message); }, one.message);
    if (!writer.append({.logged_utime = ++logged_utime, .channel = one.channel, .bytes = bytes})) {
      throw std::runtime_error(file.string() + ": cannot be written");
    }
  }
}

}  // namespace comptonaut
