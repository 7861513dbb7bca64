// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace comptonaut {

/// What a cluster says about the energy that was left there.
struct ClusterEnergy {
  double energy_keV = 0.0;
  double sigma_keV = 1.0;  ///< positive
};

/// One reading of a pair: the photon scattered here and went there.
struct Reading {
  double beta_rad = 0.0;    ///< the scatter angle's median, given both energies and the way between
  double likelihood = 0.0;  ///< of what was measured, in units that all readings of one pair share
};

/// Reads pairs of clusters as those of one photon of known energy, by Bayes's theorem over its first scatter angle. The
/// angles' prior is Klein and Nishina's cross section; the likelihood of two energies and a distance adds up the ways
/// in which the photon may have left them:
/// - absorbed: the electron took E_0 - E_2, the photon E_2(beta) flew so far and was absorbed. E_2 is blurred by the
///   motion of the electron (Doppler), both by the detector, and their sum is E_0
/// - the same, but an X-ray of Cd or Te escaped from either cluster
/// - scattered twice in the first cluster, within 0.3 mm: the electrons took more than one can
/// - scattered in the second cluster and escaped: the photon left less than it had
/// The first alone has sharp limits (Compton edge, backscattered photon), and where they cut, the true reading of one
/// pair in fifteen goes and the wrong one stays; here a reading beyond them keeps the probability that it has.
class PairReader {
 public:
  explicit PairReader(double e_0_keV);
  [[nodiscard]] Reading read(const ClusterEnergy& scatterer, const ClusterEnergy& absorber, double distance_m) const;

 private:
  /// From 0 to 180 degrees in steps of 1.5. Single precision, which keeps probabilities to 1e-4 and better, and eight
  /// by eight, so that several go at once.
  static constexpr std::size_t kAngles = 120, kNear = 8;
  using Angles = std::array<float, kAngles>;
  static constexpr std::size_t kSteps = 128;  ///< of energies
  struct Range {                              ///< of angles, up to before the last
    std::size_t first = 0, last = 0;
  };
  struct Way;
  template <std::size_t kWays>
  struct Ways;
  struct AllWays;

  [[nodiscard]] AllWays ways(const ClusterEnergy& scatterer, const ClusterEnergy& absorber) const;
  [[nodiscard]] Range between(double low_keV, double high_keV) const;
  template <std::size_t kWays>
  void add(const Ways<kWays>& ways, std::size_t angles, Angles& densities) const;
  [[nodiscard]] Angles likelihoods(const AllWays& ways, double absorber_keV, double distance_m) const;

  double e_0_keV_;
  Angles photon_keV_{};        ///< after a scatter by each angle; falls with it
  Angles per_photon_keV_{};    ///< its inverse, 1/keV
  Angles chance_{};            ///< Klein-Nishina, per angle
  Angles electron_max_keV_{};  ///< that the photon can leave in a second scatter
  Angles photoelectric_per_m_{}, attenuation_per_m_{};
  std::array<Angles, 3> blur_keV2_{};  ///< variance of the photon's energy by the electrons' momenta, three Gaussians
  std::array<double, 3> blur_max_keV2_{};  ///< the largest of each
  /// At each step of energies up to E_0, and at its end: attenuation by the photoelectric effect, freed of most of
  /// its fall with energy, and by Compton scattering.
  std::array<float, kSteps + 1> photoelectric_keV3_per_m_{}, compton_per_m_{};
  /// Of each step of energies up to E_0: angles whose eights hold photons of more only, of as much or more.
  std::array<std::uint8_t, kSteps> first_below_{}, last_above_{};
};

/// Most that electrons can take from a photon that scatters twice: 554.6 keV of 661.657.
[[nodiscard]] double two_scatters_keV(double e_0_keV);

/// Attenuation of CdTe (5.85 g/cm^3) by the photoelectric effect, 1/m: a cubic in log(E) through NIST's XCOM, within
/// 1 % from 50 to 1500 keV; below 50 keV its value there.
[[nodiscard]] double cdte_photoelectric_per_m(double energy_keV);
/// The same by Compton scattering: Klein and Nishina's cross section of all electrons as free ones, within 6 % of XCOM
/// above 150 keV.
[[nodiscard]] double cdte_compton_per_m(double energy_keV);

}  // namespace comptonaut
