// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/block.h"
#include "physics/interaction_table.h"
#include "physics/material.h"

namespace comptonaut {

/// Energy that a photon left at a point of the crystal, frame D. With a direction it is an electron's (or positron's)
/// kinetic energy at its start; without (zero vector) it stays where it is (Auger electrons, soft X-rays).
struct Deposit {
  Eigen::Vector3d p_D = Eigen::Vector3d::Zero();          ///< m
  Eigen::Vector3d direction_D = Eigen::Vector3d::Zero();  ///< unit vector or zero
  double energy_keV = 0.0;
  Process process = Process::kPhotoelectric;  ///< the interaction that it comes from
};

/// What became of one photon. sum of deposits + escaped = energy of the photon.
struct PhotonHistory {
  std::vector<Deposit> deposits;  ///< the first interaction that left energy first
  double escaped_keV = 0.0;
};

/// Follows photons of 1 keV to 3 MeV, and the X-rays and annihilation quanta that they make, through a block of CdTe:
/// - photoelectric absorption with K X-rays of Cd and Te (EADL97); other holes give their energy on the spot; the
///   electron's direction is that of Sauter (1931)
/// - Compton scattering with Doppler broadening (compton.h)
/// - Rayleigh scattering at a screened nucleus (rayleigh.h)
/// - pair production: kinetic energy shared out uniformly, the positron annihilates where it was made
/// Photons below 5 keV are absorbed on the spot. Bremsstrahlung is left out: below 1 % of a 477 keV electron's energy
/// goes into photons that leave its cluster. Immutable, safe to share among threads.
class Transport {
 public:
  Transport(const Block& block, const Material& material);

  /// `photon` is inside the block or on its surface, flying in. Throws std::invalid_argument for another energy.
  [[nodiscard]] PhotonHistory follow(const Photon& photon, Random& random) const;
  [[nodiscard]] const Block& block() const { return block_; }

 private:
  Block block_;
  InteractionTable table_;
  std::vector<Material::Component> components_;
};

}  // namespace comptonaut
