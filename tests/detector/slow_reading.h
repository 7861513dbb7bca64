// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "detector/reading.h"
#include "physics/kinematics.h"
#include "physics/klein_nishina.h"

namespace comptonaut::slow_reading {

inline constexpr double kCdTeElectrons_per_m3 = 1.4678e30;

// Of clusters of the simulated detector.
inline constexpr double kXRayEscapes = 0.02;  // chance per cluster
inline constexpr double kXRay_keV = 27.0, kXRaySigma_keV = 4.0;
inline constexpr double kClusterReach_m = 0.3e-3;  // two scatters so near are one cluster
inline constexpr double kEscapes = 0.7;            // a photon that scattered in the second cluster leaves the sensor
inline constexpr double kUnexplained_per_keV = 1e-6;

/// Momenta of the electrons of Cd and Te along one direction, in units of m_e c: three Gaussians through the quantiles
/// of the impulse approximation (physics/compton.h; 50 % within 0.0096, 90 % within 0.058, 98 % within 0.155).
struct Momenta {
  double share, sigma_mc;
};
inline constexpr std::array<Momenta, 3> kMomenta = {{{0.5, 0.008}, {0.35, 0.03}, {0.15, 0.1}}};

inline double square(double x) { return x * x; }

inline double normal_density(double x, double variance) {
  return std::exp(-0.5 * x * x / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

/// Attenuation by Compton scatters that leave this energy to the electron, per keV: with p = E' / E of the photon,
/// pi r_e^2 m_e c^2 / E^2 (p + 1/p - sin^2) per electron                             [Klein and Nishina 1929].
inline double recoil_per_m_keV(double photon_keV, double electron_keV) {
  constexpr double kPerElectron_m2_keV = std::numbers::pi * kElectronRadius_m * kElectronRadius_m * kElectronMass_keV;
  const double left_keV = photon_keV - electron_keV;
  const double per_photon = 1.0 / photon_keV, per_left = 1.0 / left_keV;
  const double cosine = 1.0 + kElectronMass_keV * (per_photon - per_left);
  const double ratios = left_keV * per_photon + photon_keV * per_left;
  return kCdTeElectrons_per_m3 * kPerElectron_m2_keV * square(per_photon) * (ratios - 1.0 + square(cosine));
}

/// A way to leave two energies without the photon's escape.
struct Absorbed {
  double density = 0.0;     ///< of the sum
  double photon_keV = 0.0;  ///< fitted to the sum
};

/// The densities of some ways, each times that of its photon's energy, which differs from that at a resting electron by
/// the detector's variance and the motion of the electron.
inline double blurred_density(std::span<const Absorbed> ways, double photon_keV, double variance, double momentum_keV) {
  double sum = 0.0;
  for (const auto& [share, sigma_mc] : kMomenta) {
    const double per_variance = 1.0 / (variance + square(sigma_mc * momentum_keV));
    double exponentials = 0.0;
    for (const Absorbed& way : ways) {
      exponentials += way.density * std::exp(-0.5 * square(way.photon_keV - photon_keV) * per_variance);
    }
    sum += share * exponentials * std::sqrt(per_variance * (0.5 * std::numbers::inv_pi));
  }
  return sum;
}

/// One angle after another, in double precision and with nothing left out: what PairReader does at eight angles at
/// once.
class SlowPairReader {
 public:
  explicit SlowPairReader(double e_0_keV) : e_0_keV_(e_0_keV) {
    for (std::size_t i = 0; i < kAngles; ++i) {
      const double beta_rad = (static_cast<double>(i) + 0.5) * std::numbers::pi / kAngles;
      const double cosine = std::cos(beta_rad);
      const double photon_keV = scattered_keV(e_0_keV, cosine);
      const double transfer_keV = std::sqrt(square(e_0_keV) + square(photon_keV) - 2.0 * e_0_keV * photon_keV * cosine);
      scattered_[i] = {.photon_keV = photon_keV,
                       .chance = klein_nishina_m2_sr(e_0_keV, cosine) / square(kElectronRadius_m) * std::sin(beta_rad),
                       .momentum_keV = transfer_keV * photon_keV / e_0_keV,
                       .electron_max_keV = compton_edge_keV(photon_keV),
                       .photoelectric_per_m = cdte_photoelectric_per_m(photon_keV),
                       .attenuation_per_m = cdte_photoelectric_per_m(photon_keV) + cdte_compton_per_m(photon_keV)};
    }
  }
  Reading read(const ClusterEnergy& scatterer, const ClusterEnergy& absorber, double distance_m) const {
    const double variance_1 = square(scatterer.sigma_keV), variance_2 = square(absorber.sigma_keV);
    const double of_sum = variance_1 + variance_2, of_photon = variance_1 * variance_2 / of_sum;
    const double missing_keV = e_0_keV_ - scatterer.energy_keV - absorber.energy_keV;
    const auto absorbed = [&](double chance, double lost_1_keV, double lost_2_keV, double extra_variance) {
      const double left_keV = missing_keV - lost_1_keV - lost_2_keV;
      return Absorbed{.density = chance * normal_density(left_keV, of_sum + extra_variance),
                      .photon_keV = absorber.energy_keV + lost_2_keV + left_keV * variance_2 / of_sum};
    };
    std::array<Absorbed, 3> ways = {absorbed(1.0 - 2.0 * kXRayEscapes, 0.0, 0.0, 0.0),
                                    absorbed(kXRayEscapes, kXRay_keV, 0.0, square(kXRaySigma_keV)),
                                    absorbed(kXRayEscapes, 0.0, kXRay_keV, square(kXRaySigma_keV))};
    ways[0].density += kUnexplained_per_keV;
    const double after_two_keV = std::clamp(ways[0].photon_keV, 1.0, e_0_keV_);
    const double absorbed_after_two =
        cdte_photoelectric_per_m(after_two_keV) * ways[0].density * kClusterReach_m *
        std::exp(-distance_m * (cdte_photoelectric_per_m(after_two_keV) + cdte_compton_per_m(after_two_keV)));

    const Absorbed after_escape{.density = 1.0, .photon_keV = e_0_keV_ - scatterer.energy_keV};

    std::array<double, kAngles> up_to;
    double sum = 0.0;
    for (std::size_t i = 0; i < kAngles; ++i) {
      const Scattered& s = scattered_[i];
      const double once = blurred_density(ways, s.photon_keV, of_photon, s.momentum_keV);
      double twice = 0.0, escaped = 0.0;
      const double second_keV = s.photon_keV - after_two_keV;
      if (second_keV > 0.0 && second_keV < s.electron_max_keV) {
        twice = recoil_per_m_keV(s.photon_keV, second_keV) * absorbed_after_two;
      }
      if (absorber.energy_keV < s.electron_max_keV) {
        escaped = kEscapes * recoil_per_m_keV(s.photon_keV, absorber.energy_keV) *
                  blurred_density(std::array{after_escape}, s.photon_keV, variance_1, s.momentum_keV);
      }
      const double arrives = std::exp(-distance_m * (s.attenuation_per_m));
      sum += s.chance * (twice + arrives * (s.photoelectric_per_m * once + escaped));
      up_to[i] = sum;
    }
    const auto median = std::lower_bound(up_to.begin(), up_to.end(), 0.5 * sum);
    const auto angle = static_cast<double>(median - up_to.begin());
    const double below = median == up_to.begin() ? 0.0 : *(median - 1);
    const double share = sum > 0.0 ? (0.5 * sum - below) / (*median - below) : 0.0;
    return {.beta_rad = (angle + share) * std::numbers::pi / kAngles, .likelihood = sum};
  }

 private:
  static constexpr std::size_t kAngles = 120;
  /// A photon after a scatter by beta, for betas from 0 to 180 degrees.
  struct Scattered {
    double photon_keV = 0.0, chance = 0.0, momentum_keV = 0.0, electron_max_keV = 0.0;
    double photoelectric_per_m = 0.0, attenuation_per_m = 0.0;
  };
  double e_0_keV_;
  std::array<Scattered, kAngles> scattered_;
};

}  // namespace comptonaut::slow_reading
