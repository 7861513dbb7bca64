// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "sim/arrivals.h"
#include "sim/box_view.h"
#include "sim/emitters.h"
#include "sim/scenario.h"
#include "sim/sim_camera.h"

namespace comptonaut {

/// One camera in the field: every photon of every emitter that strikes its block is followed on its own, digitised,
/// and what the chip reads out is sent as a t3pa stream. Background and scattered photons are singles without
/// direction.
class SimDetector {
 public:
  /// `camera` must outlive this.
  SimDetector(const SimCamera& camera, const Scenario& scenario, std::vector<Emitter> emitters, std::uint64_t seed,
              int mav);

  /// The stream's beginning.
  [[nodiscard]] std::string start(Utime start_utime);
  /// What comes in [t_s, t_s + dt_s) since the stream's start, seen from X_WB, the pose at the middle.
  [[nodiscard]] std::string step(const Eigen::Isometry3d& X_WB, double t_s, double dt_s);

  /// Photons that interacted so far: from emitters, not background.
  [[nodiscard]] std::int64_t photons() const { return photons_; }

 private:
  /// Energy left in the crystal at one moment.
  struct Strike {
    double t_s = 0.0;
    std::vector<Deposit> deposits;
  };

  /// Share of the photons of one emitter that obstacles let through to p_WD.
  [[nodiscard]] double through_obstacles(std::size_t emitter, const Eigen::Vector3d& p_WD) const;
  void add_photons(const Eigen::Isometry3d& X_WD, double t_s, double dt_s, std::vector<Strike>& strikes);
  void add_photon(const Emitter& emitter, const BoxView& view, double t_s, double dt_s, std::vector<Strike>& strikes);
  void add_background(double t_s, double dt_s, std::vector<Strike>& strikes);
  /// A photon onto the block out of an isotropic flux.
  [[nodiscard]] Photon stray_photon(double energy_keV);
  /// An electron anywhere in the block.
  [[nodiscard]] Strike electron(double t_s, double energy_keV);
  void read_out(std::vector<Strike> strikes);

  const SimCamera& camera_;
  std::vector<Emitter> emitters_;
  World world_;
  std::vector<double> attenuation_per_m_;  ///< of air, for each emitter
  std::vector<double> obstacles_per_m_;    ///< of what is occupied; empty on flat ground
  double background_per_s_;                ///< electrons of all energies, at the start
  double background_growth_per_s_;         ///< of its logarithm
  double scatter_share_;
  double stray_share_;
  double dead_time_s_;
  Random photon_random_;
  Random background_random_;
  Random stray_random_;
  Random digitizer_random_;
  Digitizer digitizer_;
  Arrivals arrivals_;
  Eigen::Isometry3d X_BD_ = Eigen::Isometry3d::Identity();
  double response_scale_ = 1.0;
  double dead_until_s_ = 0.0;
  std::int64_t photons_ = 0;
};

}  // namespace comptonaut
