// SPDX-License-Identifier: BSD-3-Clause
#include "physics/transport.h"

#include <fmt/format.h>

#include <stdexcept>

#include "physics/compton.h"
#include "physics/kinematics.h"
#include "physics/scatter.h"

namespace comptonaut {
namespace {

constexpr double kCutoff_keV = 5.0;

/// One primary photon on its way, and what it made.
class Flight {
 public:
  Flight(const Block& block, const InteractionTable& table, const std::vector<Material::Component>& components,
         Random& random)
      : block_(block), table_(table), components_(components), random_(random) {}

  PhotonHistory follow(const Photon& primary) {
    fly(primary);
    while (!pending_.empty()) {
      const Photon photon = pending_.back();
      pending_.pop_back();
      fly(photon);
    }
    return std::move(history_);
  }

 private:
  /// Until the photon is absorbed or outside.
  void fly(Photon photon) {
    while (photon.energy_keV >= kCutoff_keV) {
      const auto place = InteractionTable::place(photon.energy_keV);
      const double way_m = random_.exponential() / table_.attenuation_per_m(place);
      if (way_m >= block_.distance_to_exit_m(photon.p_D, photon.flight_D)) {
        history_.escaped_keV += photon.energy_keV;
        return;
      }
      photon.p_D += way_m * photon.flight_D;
      interact(photon, table_.sample(place, random_));
    }
    leave(photon.p_D, photon.energy_keV, Process::kPhotoelectric);
  }

  void interact(Photon& photon, const InteractionTable::Choice& choice) {
    const Material::Component& component = components_[choice.component];
    switch (choice.process) {
      case Process::kRayleigh:
        photon.flight_D =
            deflect(photon.flight_D, sample_rayleigh(component.atom.z, photon.energy_keV, random_), random_);
        return;
      case Process::kCompton:
        return scatter(photon, component.atom);
      case Process::kPhotoelectric:
        return absorb(photon, component);
      case Process::kPair:
        return make_pair(photon);
    }
  }

  void scatter(Photon& photon, const Atom& atom) {
    const ComptonScatter scatter = sample_compton(atom, photon.energy_keV, random_);
    const double binding_keV = atom.shells[scatter.shell].binding_keV;
    const Eigen::Vector3d scattered_D = deflect(photon.flight_D, scatter.cos_angle, random_);
    const Eigen::Vector3d momentum_keV = photon.energy_keV * photon.flight_D - scatter.photon_keV * scattered_D;
    eject(photon.p_D, momentum_keV.normalized(), photon.energy_keV - scatter.photon_keV - binding_keV,
          Process::kCompton);
    relax(photon.p_D, atom, scatter.shell, Process::kCompton);
    photon.flight_D = scattered_D;
    photon.energy_keV = scatter.photon_keV;
  }

  void absorb(Photon& photon, const Material::Component& component) {
    const std::size_t shell = sample_photoelectric_shell(photon.energy_keV, component);
    const double electron_keV = photon.energy_keV - component.atom.shells[shell].binding_keV;
    eject(photon.p_D, deflect(photon.flight_D, sample_photoelectron(electron_keV, random_), random_), electron_keV,
          Process::kPhotoelectric);
    relax(photon.p_D, component.atom, shell, Process::kPhotoelectric);
    photon.energy_keV = 0.0;
  }

  /// K where it is open and drawn; else the outer shells' most bound that is open: all of them end on the spot.
  std::size_t sample_photoelectric_shell(double energy_keV, const Material::Component& component) {
    const bool k_open = energy_keV > component.cross_sections.k_edge_keV();
    if (k_open && random_.uniform() < component.cross_sections.k_shell_share()) return 0;
    std::size_t shell = 1;
    while (component.atom.shells[shell].binding_keV >= energy_keV) ++shell;
    return shell;
  }

  void make_pair(Photon& photon) {
    const double kinetic_keV = photon.energy_keV - 2.0 * kElectronMass_keV;
    const double share = random_.uniform();
    eject(photon.p_D, photon.flight_D, share * kinetic_keV, Process::kPair);
    eject(photon.p_D, photon.flight_D, (1.0 - share) * kinetic_keV, Process::kPair);
    const Eigen::Vector3d annihilation_D = random_.unit_vector();
    pending_.push_back({.p_D = photon.p_D, .flight_D = annihilation_D, .energy_keV = kElectronMass_keV});
    pending_.push_back({.p_D = photon.p_D, .flight_D = -annihilation_D, .energy_keV = kElectronMass_keV});
    photon.energy_keV = 0.0;
  }

  /// Fills a hole: a K X-ray flies on, everything else stays.
  void relax(const Eigen::Vector3d& p_D, const Atom& atom, std::size_t shell, Process process) {
    double left_keV = atom.shells[shell].binding_keV;
    if (shell == 0) {
      double draw = random_.uniform();
      for (const XRayLine& line : atom.k_x_rays) {
        draw -= line.probability;
        if (draw >= 0.0) continue;
        pending_.push_back({.p_D = p_D, .flight_D = random_.unit_vector(), .energy_keV = line.energy_keV});
        left_keV -= line.energy_keV;
        break;
      }
    }
    leave(p_D, left_keV, process);
  }

  void eject(const Eigen::Vector3d& p_D, const Eigen::Vector3d& direction_D, double energy_keV, Process process) {
    if (!(energy_keV > 0.0)) return;
    history_.deposits.push_back({.p_D = p_D, .direction_D = direction_D, .energy_keV = energy_keV, .process = process});
  }

  void leave(const Eigen::Vector3d& p_D, double energy_keV, Process process) {
    eject(p_D, Eigen::Vector3d::Zero(), energy_keV, process);
  }

  const Block& block_;
  const InteractionTable& table_;
  const std::vector<Material::Component>& components_;
  Random& random_;
  std::vector<Photon> pending_;
  PhotonHistory history_;
};

}  // namespace

Transport::Transport(const Block& block, const Material& material)
    : block_(block), table_(material), components_(material.components) {}

PhotonHistory Transport::follow(const Photon& photon, Random& random) const {
  if (!(photon.energy_keV >= InteractionTable::kMin_keV && photon.energy_keV <= InteractionTable::kMax_keV)) {
    throw std::invalid_argument(fmt::format("a photon of {} keV: transport is for {} to {} keV", photon.energy_keV,
                                            InteractionTable::kMin_keV, InteractionTable::kMax_keV));
  }
  return Flight(block_, table_, components_, random).follow(photon);
}

}  // namespace comptonaut
