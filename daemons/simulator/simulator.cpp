// SPDX-License-Identifier: BSD-3-Clause
#include "simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace comptonaut {
namespace {

/// Only range points go to a MAV's own bus.
std::unique_ptr<Bus> bus_of(int mav, int base_port, const Scenario& scenario, const std::string& lcm_url) {
  if (!scenario.range_sensor || base_port == 0) return nullptr;
  static const std::regex port(":[0-9]+");
  return std::make_unique<Bus>(std::regex_replace(lcm_url, port, fmt::format(":{}", base_port + mav)));
}

/// Simulated time after which every pose bridge should have answered.
constexpr Utime kAnswerPeriod_us = 50'000;
constexpr std::chrono::milliseconds kConnectPeriod{100};
constexpr std::chrono::milliseconds kAdvancePeriod{1};

}  // namespace

Simulator::Simulator(const SimulatorConfig& config, const Scenario& scenario, std::uint64_t seed,
                     const SimCamera& camera, SimulatorPorts ports, const DaemonArguments& arguments, EventLoop& loop,
                     Bus& bus)
    : config_(config),
      scenario_(scenario),
      seed_(seed),
      camera_(camera),
      arguments_(arguments),
      loop_(loop),
      bus_(bus),
      start_s_(now_s()),
      last_tick_s_(start_s_),
      last_chunk_s_(start_s_),
      last_truth_s_(start_s_) {
  for (int mav = 1; mav <= scenario.mavs.count; ++mav) {
    mavs_.push_back({.detector = TcpLink(ports.detector + mav),
                     .autopilot = UdpLink(ports.autopilot + mav),
                     .bus = bus_of(mav, ports.bus, scenario, arguments.lcm_url)});
    loop.watch(mavs_.back().autopilot.fd(), [this, mav] { receive(mav); });
  }
  bus.subscribe<CoordinatorState>("COORDINATOR", [this](const auto&, const CoordinatorState& state) {
    if (!pace_) return;
    pace_->on_tick(state.utime);
    last_tick_s_ = now_s();
  });
  loop.every(kConnectPeriod, [this] { connect(); });
  loop.every(kAdvancePeriod, [this] { advance(); });
}

void Simulator::connect() {
  bool complete = true;
  for (int mav = 1; mav <= static_cast<int>(mavs_.size()); ++mav) {
    Mav& m = mavs_[mav - 1];
    if (m.detector.connect() && world_) {
      ++counts_.reconnects;
      send_hits(mav, world_->stream_start(mav));
    }
    if (!world_) m.autopilot.send(hello_frame(mav));
    complete = complete && m.detector.connected() && m.heard;
  }
  if (!world_ && complete) begin_mission();
  check_patience();
}

void Simulator::begin_mission() {
  const Utime now = config_.start_utime_s > 0 ? config_.start_utime_s * kSecond_us : wall_clock_utime();
  const Utime start_utime = floor_to(now + kSecond_us - 1, kSecond_us);
  world_.emplace(camera_, scenario_, seed_, start_utime);
  pace_.emplace(config_.pace, start_utime, scenario_.horizon_s);
  start_s_ = last_tick_s_ = last_chunk_s_ = last_truth_s_ = now_s();
  for (int mav = 1; mav <= world_->mavs(); ++mav) send_hits(mav, world_->stream_start(mav));
}

void Simulator::receive(int mav) {
  for (const auto& datagram : mavs_[mav - 1].autopilot.receive()) {
    ++counts_.datagrams_in;
    mavs_[mav - 1].heard = true;
    if (world_) world_->on_mavlink(mav, datagram);
  }
}

bool Simulator::readers_keep_up() {
  for (Mav& mav : mavs_) mav.detector.flush();
  return std::all_of(mavs_.begin(), mavs_.end(), [](const Mav& mav) { return mav.detector.idle(); });
}

bool Simulator::answered() {
  const bool all = std::all_of(mavs_.begin(), mavs_.end(), [](const Mav& mav) { return mav.heard; });
  if (!all && now_s() - last_chunk_s_ < config_.answer_wait_s) return false;
  if (!all) ++counts_.answers_missed;
  for (Mav& mav : mavs_) mav.heard = false;
  last_chunk_s_ = now_s();
  return true;
}

void Simulator::advance() {
  if (!world_) return;
  if (pace_->over()) return loop_.stop();
  const Utime limit = pace_->limit(now_s() - start_s_);
  while (readers_keep_up() && world_->utime() + SimWorld::kStep_us <= limit) {
    if ((world_->utime() - world_->start_utime()) % kAnswerPeriod_us == 0 && !answered()) return;
    step();
  }
}

void Simulator::step() {
  if ((world_->utime() - world_->start_utime()) % kSecond_us == 0) publish_truth();
  for (int mav = 1; mav <= world_->mavs(); ++mav) {
    for (const auto& frame : world_->mavlink(mav)) {
      mavs_[mav - 1].autopilot.send(frame);
      ++counts_.datagrams_out;
    }
  }
  const std::vector<std::string> hits = world_->step();
  for (int mav = 1; mav <= world_->mavs(); ++mav) {
    if (const auto points = world_->range_points(mav)) {
      Bus& bus = mavs_[mav - 1].bus ? *mavs_[mav - 1].bus : bus_;
      bus.publish(mav_channel(mav, "POINTS"), *points);
    }
    send_hits(mav, hits[mav - 1]);
  }
  ++counts_.steps;
}

void Simulator::send_hits(int mav, const std::string& text) {
  const bool sent = mavs_[mav - 1].detector.send(text);
  (sent ? counts_.hit_bytes : counts_.hit_bytes_lost) += static_cast<std::int64_t>(text.size());
}

void Simulator::publish_truth() {
  Truth truth = world_->truth();
  const double wall_s = now_s() - last_truth_s_;
  truth.time_scale = wall_s > 1e-3 ? 1.0 / wall_s : 1.0;
  last_truth_s_ = now_s();
  bus_.publish("SIM_TRUTH", truth);
}

void Simulator::check_patience() const {
  if (!world_ && now_s() - start_s_ > config_.connect_timeout_s) {
    for (std::size_t i = 0; i < mavs_.size(); ++i) {
      if (mavs_[i].detector.connected() && mavs_[i].heard) continue;
      const char* missing = mavs_[i].detector.connected() ? "pose-bridge" : "detector-reader";
      throw std::runtime_error(fmt::format("no {} of MAV {} for {} s", missing, i + 1, config_.connect_timeout_s));
    }
  }
  if (world_ && now_s() - last_tick_s_ > config_.stall_timeout_s) {
    for (std::size_t i = 0; i < mavs_.size(); ++i) {
      if (mavs_[i].detector.idle()) continue;
      throw std::runtime_error(fmt::format("the detector-reader of MAV {} has stopped reading", i + 1));
    }
    throw std::runtime_error(fmt::format("no tick of the coordinator for {} s, {:.0f} s into the mission",
                                         config_.stall_timeout_s, seconds(world_->utime() - world_->start_utime())));
  }
}

DaemonStatus Simulator::status() const {
  DaemonStatus status{.utime = world_ ? world_->utime() : 0, .state = world_ ? "flying" : "waiting for the daemons"};
  for (std::size_t i = 0; i < mavs_.size(); ++i) {
    if (!mavs_[i].detector.idle()) status.state = fmt::format("waiting for the detector-reader of MAV {}", i + 1);
  }
  status.counters = {{"steps", counts_.steps},
                     {"datagrams_in", counts_.datagrams_in},
                     {"datagrams_out", counts_.datagrams_out},
                     {"hit_bytes", counts_.hit_bytes},
                     {"hit_bytes_lost", counts_.hit_bytes_lost},
                     {"reconnects", counts_.reconnects},
                     {"answers_missed", counts_.answers_missed}};
  return status;
}

}  // namespace comptonaut
