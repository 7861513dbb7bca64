// SPDX-License-Identifier: BSD-3-Clause
#include "detector/reading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/simd.h"
#include "physics/kinematics.h"
#include "physics/klein_nishina.h"

namespace comptonaut {
namespace {

constexpr double kCdTeElectrons_per_m3 = 1.4678e30;

// Of clusters of the simulated detector.
constexpr double kXRayEscapes = 0.02;  // chance per cluster
constexpr double kXRay_keV = 27.0, kXRaySigma_keV = 4.0;
constexpr double kClusterReach_m = 0.3e-3;     // two scatters so near are one cluster
constexpr double kEscapes = 0.7;               // a photon that scattered in the second cluster leaves the sensor
constexpr double kUnexplained_per_keV = 1e-6;  // chance of a sum that nothing here explains: it is shared as noise is

/// Momenta of the electrons of Cd and Te along one direction, in units of m_e c: three Gaussians through the quantiles
/// of the impulse approximation (physics/compton.h; 50 % within 0.0096, 90 % within 0.058, 98 % within 0.155).
struct Momenta {
  double share, sigma_mc;
};
constexpr std::array<Momenta, 3> kMomenta = {{{0.5, 0.008}, {0.35, 0.03}, {0.15, 0.1}}};

constexpr double kNothing = 20.0;  // exp(-kNothing) is that
constexpr double kFar = 16.0;      // exp(-kFar) is nothing beside what is nearer
constexpr double kStep_rad = std::numbers::pi / 120.0;

constexpr double kPhotoelectricMin_keV = 50.0;  ///< below, attenuation by it stays as it is there

double square(double x) { return x * x; }

/// About as the photoelectric effect falls with energy, 1/keV^3.
inline double inverse_cube(double energy_keV) {
  const double inverse = 1.0 / std::max(energy_keV, kPhotoelectricMin_keV);
  return inverse * inverse * inverse;
}

double normal_density(double x, double variance) {
  const double exponent = -0.5 * x * x / variance;
  return exponent < -kNothing ? 0.0 : std::exp(exponent) / std::sqrt(2.0 * std::numbers::pi * variance);
}

/// exp(x) for x <= 0, to 5e-5; below -32 as at -32. The 32nd power of exp(x / 32) as a polynomial: no branch, no table.
inline float exp_of(float x) {
  const float u = (x > -32.0F ? x : -32.0F) * (1.0F / 32.0F);
  const float u2 = u * u;
  const float p = (0.99999957F + 0.99996861F * u) +
                  u2 * ((0.49962687F + 0.16502942F * u) + u2 * (0.038357933F + 0.0051073081F * u));
  const float p2 = p * p, p4 = p2 * p2, p8 = p4 * p4, p16 = p8 * p8;
  return p16 * p16;
}

/// Attenuation by Compton scatters that leave this energy to the photon, per keV: with p = E' / E of the photon,
/// pi r_e^2 m_e c^2 / E^2 (p + 1/p - sin^2) per electron                             [Klein and Nishina 1929].
inline float recoil_per_m_keV(float photon_keV, float per_photon, float left_keV, float per_left) {
  constexpr double kPerElectron_m2_keV = std::numbers::pi * kElectronRadius_m * kElectronRadius_m * kElectronMass_keV;
  constexpr auto kAll = static_cast<float>(kCdTeElectrons_per_m3 * kPerElectron_m2_keV);
  const float cosine = 1.0F + static_cast<float>(kElectronMass_keV) * (per_photon - per_left);
  const float ratios = left_keV * per_photon + photon_keV * per_left;
  return kAll * per_photon * per_photon * (ratios - 1.0F + cosine * cosine);
}

}  // namespace

/// A way to leave two energies: the scattered photon's energy by it and the density of what else was measured.
struct PairReader::Way {
  double density = 0.0;
  double photon_keV = 0.0;
};
/// Ways that know the photon's energy with the same variance, the detector's.
template <std::size_t kWays>
struct PairReader::Ways {
  std::array<Way, kWays> ways;
  double variance_keV2 = 0.0;
};
struct PairReader::AllWays {
  Ways<3> absorbed;  ///< all that was left in two clusters, or nothing that is known here; all but an X-ray that
                     ///< escaped from the first of them; from the second
  Ways<1> escaped;   ///< from the second cluster: the first alone tells
};

PairReader::PairReader(double e_0_keV) : e_0_keV_(e_0_keV) {
  for (std::size_t i = 0; i < kAngles; ++i) {
    const double beta_rad = (static_cast<double>(i) + 0.5) * kStep_rad;
    const double cosine = std::cos(beta_rad);
    const double photon_keV = scattered_keV(e_0_keV, cosine);
    const double transfer_keV = std::sqrt(square(e_0_keV) + square(photon_keV) - 2.0 * e_0_keV * photon_keV * cosine);
    const double photoelectric_per_m = cdte_photoelectric_per_m(photon_keV);
    const auto set = [i](Angles& of, double value) { of[i] = static_cast<float>(value); };
    set(photon_keV_, photon_keV);
    per_photon_keV_[i] = 1.0F / photon_keV_[i];
    set(chance_, klein_nishina_m2_sr(e_0_keV, cosine) / square(kElectronRadius_m) * std::sin(beta_rad));
    set(electron_max_keV_, compton_edge_keV(photon_keV));
    set(photoelectric_per_m_, photoelectric_per_m);
    set(attenuation_per_m_, photoelectric_per_m + cdte_compton_per_m(photon_keV));
    for (std::size_t k = 0; k < kMomenta.size(); ++k) {
      const double blur_keV2 = square(kMomenta[k].sigma_mc * transfer_keV * photon_keV / e_0_keV);
      set(blur_keV2_[k], blur_keV2);
      blur_max_keV2_[k] = std::max(blur_max_keV2_[k], blur_keV2);
    }
  }
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double energy_keV = e_0_keV * static_cast<double>(step) / kSteps;
    photoelectric_keV3_per_m_[step] =
        static_cast<float>(cdte_photoelectric_per_m(energy_keV) / inverse_cube(energy_keV));
    compton_per_m_[step] = static_cast<float>(cdte_compton_per_m(energy_keV));
  }
  for (std::size_t step = 0; step < kSteps; ++step) {
    const double low_keV = e_0_keV * static_cast<double>(step) / kSteps, high_keV = low_keV + e_0_keV / kSteps;
    for (std::size_t i = 0; i < kAngles; i += kNear) {
      first_below_[step] += photon_keV_[i + kNear - 1] > high_keV ? kNear : 0;
      last_above_[step] += photon_keV_[i] >= low_keV ? kNear : 0;
    }
  }
}

/// The angles, by whole eights, whose photons have energies from about the one to the other, or more of them.
inline PairReader::Range PairReader::between(double low_keV, double high_keV) const {
  const auto step = [&](double keV) {
    return static_cast<std::size_t>(std::clamp(keV / e_0_keV_ * kSteps, 0.0, kSteps - 1.0));
  };
  return {.first = first_below_[step(high_keV)], .last = last_above_[step(low_keV)]};
}

/// Adds the density of ways at each of the first angles, so many, whose photon's energy differs from that at a resting
/// electron by the detector's variance and the motion of the electron. Angles that are far from it keep what they have.
template <std::size_t kWays>
inline void PairReader::add(const Ways<kWays>& ways, std::size_t angles, Angles& densities) const {
  // All limits first: where one of the loops below ends is known long before it does.
  std::array<std::array<Range, kWays>, kMomenta.size()> ranges{};
  std::array<Range, kMomenta.size()> all;
  for (std::size_t k = 0; k < kMomenta.size(); ++k) {
    const double reach_keV = std::sqrt(2.0 * kFar * (ways.variance_keV2 + blur_max_keV2_[k]));
    all[k] = {.first = kAngles, .last = 0};
    for (std::size_t way = 0; way < kWays; ++way) {
      const auto& [density, photon_keV] = ways.ways[way];
      if (density == 0.0) continue;
      Range& range = ranges[k][way];
      range = between(photon_keV - reach_keV, photon_keV + reach_keV);
      range.last = std::min(range.last, angles);
      all[k] = {.first = std::min(all[k].first, range.first), .last = std::max(all[k].last, range.last)};
    }
  }
  const auto variance_keV2 = static_cast<float>(ways.variance_keV2);
  for (std::size_t k = 0; k < kMomenta.size(); ++k) {
    Angles per_variance, root;
    for (std::size_t i = all[k].first; i < all[k].last; ++i) {
      per_variance[i] = 1.0F / (variance_keV2 + blur_keV2_[k][i]);
      root[i] = std::sqrt(per_variance[i]);
    }
    for (std::size_t way = 0; way < kWays; ++way) {
      const auto& [density, way_keV] = ways.ways[way];
      const auto photon_keV = static_cast<float>(way_keV);
      const auto weight = static_cast<float>(density * kMomenta[k].share / std::sqrt(2.0 * std::numbers::pi));
      for (std::size_t i = ranges[k][way].first; i < ranges[k][way].last; ++i) {
        const float off_keV = photon_keV_[i] - photon_keV;
        densities[i] += weight * root[i] * exp_of(-0.5F * per_variance[i] * off_keV * off_keV);
      }
    }
  }
}

PairReader::AllWays PairReader::ways(const ClusterEnergy& scatterer, const ClusterEnergy& absorber) const {
  const double variance_1 = square(scatterer.sigma_keV), variance_2 = square(absorber.sigma_keV);
  const double of_sum = variance_1 + variance_2;
  const double missing_keV = e_0_keV_ - scatterer.energy_keV - absorber.energy_keV;
  const auto absorbed = [&](double chance, double lost_1_keV, double lost_2_keV, double extra_variance) {
    const double left_keV = missing_keV - lost_1_keV - lost_2_keV;
    return Way{.density = chance * normal_density(left_keV, of_sum + extra_variance),
               .photon_keV = absorber.energy_keV + lost_2_keV + left_keV * variance_2 / of_sum};
  };
  AllWays all{.absorbed = {.ways = {absorbed(1.0 - 2.0 * kXRayEscapes, 0.0, 0.0, 0.0),
                                    absorbed(kXRayEscapes, kXRay_keV, 0.0, square(kXRaySigma_keV)),
                                    absorbed(kXRayEscapes, 0.0, kXRay_keV, square(kXRaySigma_keV))},
                           .variance_keV2 = variance_1 * variance_2 / of_sum},
              .escaped = {.ways = {Way{.density = kEscapes, .photon_keV = e_0_keV_ - scatterer.energy_keV}},
                          .variance_keV2 = variance_1}};
  all.absorbed.ways[0].density += kUnexplained_per_keV;
  return all;
}

COMPTONAUT_SIMD_CLONES
PairReader::Angles PairReader::likelihoods(const AllWays& ways, double absorber_keV, double distance_m) const {
  Angles arriving{};
  add(ways.absorbed, kAngles, arriving);
  for (std::size_t i = 0; i < kAngles; ++i) arriving[i] *= photoelectric_per_m_[i];

  const auto electron_2_keV = static_cast<float>(absorber_keV);
  std::size_t escapes = 0;  // up to which angle, by whole eights, the photon can leave as much in a second scatter
  while (escapes < kAngles && electron_2_keV < electron_max_keV_[escapes]) escapes += kNear;
  if (escapes > 0) {
    Angles escaped{};
    add(ways.escaped, escapes, escaped);
    for (std::size_t i = 0; i < escapes; ++i) {
      const float photon_keV = photon_keV_[i], left_keV = photon_keV - electron_2_keV;
      const float scattered = escaped[i] * recoil_per_m_keV(photon_keV, per_photon_keV_[i], left_keV, 1.0F / left_keV);
      arriving[i] += electron_2_keV < electron_max_keV_[i] ? scattered : 0.0F;
    }
  }

  const double after_two_keV = std::clamp(ways.absorbed.ways[0].photon_keV, 1.0, e_0_keV_);
  const double steps = std::min(after_two_keV / e_0_keV_ * kSteps, kSteps - 1e-9);
  const auto step = static_cast<std::size_t>(steps);
  const auto part = static_cast<float>(steps - static_cast<double>(step));
  const auto of = [&](const auto& table) { return table[step] + part * (table[step + 1] - table[step]); };
  const auto way_m = static_cast<float>(distance_m), density = static_cast<float>(ways.absorbed.ways[0].density);
  const auto left_keV = static_cast<float>(after_two_keV), per_left = 1.0F / left_keV;
  const float photoelectric_per_m = of(photoelectric_keV3_per_m_) * static_cast<float>(inverse_cube(after_two_keV));
  const float attenuation_per_m = photoelectric_per_m + of(compton_per_m_);
  const float absorbed_after_two =
      photoelectric_per_m * density * static_cast<float>(kClusterReach_m) * exp_of(-way_m * attenuation_per_m);
  Angles all;
  for (std::size_t i = 0; i < kAngles; ++i) {
    const float photon_keV = photon_keV_[i], electron_keV = photon_keV - left_keV;
    const float twice = absorbed_after_two * recoil_per_m_keV(photon_keV, per_photon_keV_[i], left_keV, per_left);
    all[i] = chance_[i] * (arriving[i] * exp_of(-way_m * attenuation_per_m_[i]) +
                           (electron_keV > 0.0F && electron_keV < electron_max_keV_[i] ? twice : 0.0F));
  }
  return all;
}

Reading PairReader::read(const ClusterEnergy& scatterer, const ClusterEnergy& absorber, double distance_m) const {
  const Angles all = likelihoods(ways(scatterer, absorber), absorber.energy_keV, distance_m);
  float sum = 0.0F;
  std::array<float, kAngles / kNear> up_to;  // the end of each eight
  for (std::size_t i = 0; i < up_to.size(); ++i) {
    up_to[i] = sum += std::accumulate(&all[i * kNear], &all[i * kNear] + kNear, 0.0F);
  }
  if (!(sum > 0.0F)) return {};
  const auto eight = static_cast<std::size_t>(std::lower_bound(up_to.begin(), up_to.end(), 0.5F * sum) - up_to.begin());
  float missing = 0.5F * sum - (eight == 0 ? 0.0F : up_to[eight - 1]);
  std::size_t i = kNear * eight;
  for (; i + 1 < kNear * (eight + 1) && missing > all[i]; ++i) missing -= all[i];
  return {.beta_rad = (static_cast<double>(i) + std::min(missing / all[i], 1.0F)) * kStep_rad, .likelihood = sum};
}

double two_scatters_keV(double e_0_keV) { return e_0_keV - scattered_keV(scattered_keV(e_0_keV, -1.0), -1.0); }

double cdte_photoelectric_per_m(double energy_keV) {
  const double x = std::log(std::max(energy_keV, kPhotoelectricMin_keV) / 200.0);
  return 100.0 * std::exp(0.150055 + x * (-2.851563 + x * (0.0873567 + x * 0.0673441)));
}

double cdte_compton_per_m(double energy_keV) { return kCdTeElectrons_per_m3 * klein_nishina_m2(energy_keV); }

}  // namespace comptonaut
