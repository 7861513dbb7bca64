// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sim_detector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "physics/klein_nishina.h"
#include "sim/pose_noise.h"
#include "sim/streams.h"

namespace comptonaut {
namespace {

/// Background energies fall off exponentially with this mean; what scattered photons leave lies evenly between these.
constexpr double kBackgroundMean_keV = 200.0;
constexpr double kScatterMin_keV = 40.0;
constexpr double kScatterMax_keV = 450.0;
/// Stray photons start so far away.
constexpr double kStrayFrom_m = 10.0;

Eigen::Isometry3d mounted(const Eigen::Isometry3d& X_BD, double boresight_sigma_rad, Random& random) {
  Eigen::Vector3d error_rad;
  for (double& x : error_rad) x = boresight_sigma_rad * random.normal();
  return X_BD * rotation_by(error_rad);
}

/// Share of background electrons whose energy lies in the channel's singles window.
double share_in_window(const NuclideChannel& channel) {
  return std::exp(-channel.singles_min_keV / kBackgroundMean_keV) -
         std::exp(-channel.singles_max_keV / kBackgroundMean_keV);
}

/// Of air at another energy than the scenario tells: as the cross section of free electrons, which it is but for 1 %.
double attenuation_per_m(const Scenario& scenario, double told_at_keV, double energy_keV) {
  return scenario.air_attenuation_per_m * (klein_nishina_m2(energy_keV) / klein_nishina_m2(told_at_keV));
}

ChipTime chip_time(double t_s) { return std::llround(t_s * 1e9 / kChipTime_ns); }

}  // namespace

SimDetector::SimDetector(const SimCamera& camera, const Scenario& scenario, std::vector<Emitter> emitters,
                         std::uint64_t seed, int mav)
    : camera_(camera),
      emitters_(std::move(emitters)),
      world_(scenario.world),
      background_per_s_(scenario.background_singles_per_s / share_in_window(camera.channel)),
      background_growth_per_s_(std::log(scenario.mismatch.background_drift) / scenario.horizon_s),
      scatter_share_(scenario.mismatch.scatter_share),
      stray_share_(scenario.mismatch.stray_share),
      dead_time_s_(1e-6 * scenario.mismatch.dead_time_us),
      photon_random_(random_stream(seed, Purpose::kPhotons, mav)),
      background_random_(random_stream(seed, Purpose::kBackground, mav)),
      stray_random_(random_stream(seed, Purpose::kStray, mav)),
      digitizer_random_(random_stream(seed, Purpose::kDigitizer, mav)),
      digitizer_(camera.digitizer),
      arrivals_(scenario.traps, seed, mav) {
  Random mount_random = random_stream(seed, Purpose::kMount, mav);
  X_BD_ = mounted(camera.X_BD, scenario.mismatch.boresight_sigma_rad, mount_random);
  response_scale_ = std::max(0.0, 1.0 + scenario.mismatch.response_sigma * mount_random.normal());
  for (const Emitter& emitter : emitters_) {
    attenuation_per_m_.push_back(attenuation_per_m(scenario, camera.channel.line_keV, emitter.energy_keV));
    if (camera.obstacles) obstacles_per_m_.push_back(camera.obstacles->attenuation_per_m(emitter.energy_keV));
  }
}

std::string SimDetector::start(Utime start_utime) { return arrivals_.start(start_utime); }

void SimDetector::add_photon(const Emitter& emitter, const BoxView& view, double t_s, double dt_s,
                             std::vector<Strike>& strikes) {
  const Ray ray = view.sample(photon_random_);
  const double t_photon_s = t_s + dt_s * photon_random_.uniform();
  Photon photon{.p_D = ray.p, .flight_D = ray.direction, .energy_keV = emitter.energy_keV};
  if (stray_random_.uniform() < stray_share_) photon = stray_photon(emitter.energy_keV);
  PhotonHistory history = camera_.transport.follow(photon, photon_random_);
  if (history.deposits.empty()) return;
  ++photons_;
  strikes.push_back({.t_s = t_photon_s, .deposits = std::move(history.deposits)});
  if (background_random_.uniform() < scatter_share_) {
    const double energy_keV = background_random_.uniform(kScatterMin_keV, kScatterMax_keV);
    strikes.push_back(electron(t_s + dt_s * background_random_.uniform(), energy_keV));
  }
}

double SimDetector::through_obstacles(std::size_t emitter, const Eigen::Vector3d& p_WD) const {
  constexpr double kNothing = 50.0;  // in mean free paths
  if (obstacles_per_m_.empty()) return 1.0;
  const double per_m = obstacles_per_m_[emitter];
  return std::exp(-per_m * world_.occupied_m(emitters_[emitter].p_W, p_WD, kNothing / per_m));
}

void SimDetector::add_photons(const Eigen::Isometry3d& X_WD, double t_s, double dt_s, std::vector<Strike>& strikes) {
  const Eigen::Isometry3d X_DW = X_WD.inverse();
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    const Emitter& emitter = emitters_[i];
    const Eigen::Vector3d eye_D = X_DW * emitter.p_W;
    const BoxView view(camera_.transport.block().half_m, eye_D);
    const double through_air = std::exp(-attenuation_per_m_[i] * eye_D.norm());
    const double share = view.solid_angle() / (4.0 * std::numbers::pi) * through_air * response_scale_ *
                         through_obstacles(i, X_WD.translation());
    const std::int64_t photons = photon_random_.poisson(emitter.photons_per_s * dt_s * share);
    for (std::int64_t n = 0; n < photons; ++n) add_photon(emitter, view, t_s, dt_s, strikes);
  }
}

Photon SimDetector::stray_photon(double energy_keV) {
  const Eigen::Vector3d& half_m = camera_.transport.block().half_m;
  const double widest_sr = 4.0 * (half_m.x() * half_m.y() + half_m.y() * half_m.z() + half_m.z() * half_m.x()) /
                           (kStrayFrom_m * kStrayFrom_m);
  for (;;) {
    const BoxView view(half_m, kStrayFrom_m * stray_random_.unit_vector());
    if (stray_random_.uniform() * widest_sr > view.solid_angle()) continue;
    const Ray ray = view.sample(stray_random_);
    return {.p_D = ray.p, .flight_D = ray.direction, .energy_keV = energy_keV};
  }
}

SimDetector::Strike SimDetector::electron(double t_s, double energy_keV) {
  Deposit deposit;
  for (int i = 0; i < 3; ++i) {
    deposit.p_D[i] = camera_.transport.block().half_m[i] * background_random_.uniform(-1.0, 1.0);
  }
  deposit.direction_D = background_random_.unit_vector();
  deposit.energy_keV = energy_keV;
  return {.t_s = t_s, .deposits = {deposit}};
}

void SimDetector::add_background(double t_s, double dt_s, std::vector<Strike>& strikes) {
  const double per_s = background_per_s_ * std::exp(background_growth_per_s_ * t_s);
  const std::int64_t electrons = background_random_.poisson(per_s * dt_s);
  for (std::int64_t i = 0; i < electrons; ++i) {
    const double t_electron_s = t_s + dt_s * background_random_.uniform();
    strikes.push_back(electron(t_electron_s, kBackgroundMean_keV * background_random_.exponential()));
  }
}

void SimDetector::read_out(std::vector<Strike> strikes) {
  std::stable_sort(strikes.begin(), strikes.end(), [](const Strike& a, const Strike& b) { return a.t_s < b.t_s; });
  for (const Strike& strike : strikes) {
    if (strike.t_s < dead_until_s_) continue;
    dead_until_s_ = strike.t_s + dead_time_s_;
    std::vector<Hit> hits;
    digitizer_.digitize(strike.deposits, 1e9 * strike.t_s, digitizer_random_, hits);
    arrivals_.add(hits);
  }
}

std::string SimDetector::step(const Eigen::Isometry3d& X_WB, double t_s, double dt_s) {
  std::vector<Strike> strikes;
  add_photons(X_WB * X_BD_, t_s, dt_s, strikes);
  add_background(t_s, dt_s, strikes);
  read_out(std::move(strikes));
  return arrivals_.send(chip_time(t_s + dt_s));
}

}  // namespace comptonaut
