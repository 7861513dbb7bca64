// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace comptonaut {

/// What a ConeDensity is made of: rings of half-angle beta smeared by these widths (the last, infinity, is an isotropic
/// source), then discs about the axis, which is where the source lies if the sole reading is the wrong one.
inline constexpr std::size_t kConeRings = 8, kConeDiscs = 2, kConeParts = kConeRings + kConeDiscs;
/// Their widths, rad: kappa = 1 / sigma^2.
[[nodiscard]] const std::array<double, kConeParts>& cone_sigmas_rad();

/// Shares of the parts; not negative, sum 1.
using ConeWeights = std::array<double, kConeParts>;

/// A pair keeps both readings (A and B) or only one that kinematics allows.
enum class Readings { kBoth, kSole };

/// A ring of half-angle beta around an axis, smeared by a von Mises-Fisher distribution of concentration 1 / sigma^2:
///   g = kappa / (4 pi sinh kappa) exp(kappa cos alpha cos beta) I_0(kappa sin alpha sin beta)
/// per steradian, alpha = angle(u, axis); its integral over the sphere is 1 for every beta, and it is smooth at the
/// axis too. Of a narrow one, 2 pi sin(alpha) g is a Gaussian in delta = alpha - beta.
[[nodiscard]] double smeared_ring_per_sr(double cos_alpha, double cos_beta, double sigma_rad);
/// The density of one part: a ring as above, or a disc, which is a ring of beta = 0.
[[nodiscard]] double cone_part_per_sr(std::size_t part, double cos_alpha, double cos_beta);

/// The density of one cone, ready to be evaluated in many directions.
class ConeProfile {
 public:
  ConeProfile(double cos_beta, const ConeWeights& weights, double extra_sigma_rad = 0.0);
  /// Density of the source's direction u, per steradian: integral 1 over the sphere. cos_alpha = u . axis.
  [[nodiscard]] double per_sr(double cos_alpha) const;
  /// The same as a density of delta = alpha - beta, per rad: 2 pi sin(alpha) per_sr.
  [[nodiscard]] double per_rad(double delta_rad) const;

 private:
  struct Part {
    double kappa = 0.0;
    double factor = 0.0;
  };
  double cos_beta_, sin_beta_;
  std::array<Part, kConeParts> parts_;
};

/// What a pair tells about the direction of its source, measured on simulated pairs of known direction: a mixture of
/// smeared rings and discs whose shares depend on beta (large angles are told badly: d(beta) / d(E) grows) and on
/// whether the pair kept both readings. Of a pair with hypotheses A and B of probabilities w the density per steradian
/// is
///   sum_H w_H profile(cos_beta_H, readings).per_sr(u . a_H)
/// and integrates to 1. It holds whatever happens to a photon that is counted as a pair of the channel: also a second
/// scattering, a first interaction without scattering, and the photons whose true hypothesis was refused as
/// unphysical, which are part of what lies around sole readings.
class ConeDensity {
 public:
  /// Shares at one beta; between nodes they are interpolated, outside they stay.
  struct Node {
    double beta_rad = 0.0;
    double pairs = 0.0;  ///< that it was fitted to, in effect
    ConeWeights weights{};
    bool operator==(const Node&) const = default;
  };
  /// Facts about the density, by key: `nuclide`, `command`, ...
  using Facts = std::map<std::string, std::string>;

  /// Throws std::invalid_argument unless both have nodes of growing beta from 0 to pi with valid weights.
  ConeDensity(std::vector<Node> both, std::vector<Node> sole, Facts facts = {});

  /// From a CSV file: `# key: value` lines, a header, one row per node. Throws std::runtime_error with file, line and
  /// reason.
  static ConeDensity load(const std::filesystem::path& file);
  /// Shares are written with eight digits. Throws std::runtime_error if the file cannot be written.
  void save(const std::filesystem::path& file) const;

  /// extra_sigma_rad: what else blurs the cone, such as the error of the drone's attitude (per axis).
  [[nodiscard]] ConeProfile profile(double cos_beta, Readings readings, double extra_sigma_rad = 0.0) const;

  [[nodiscard]] const std::vector<Node>& nodes(Readings readings) const {
    return readings == Readings::kBoth ? both_ : sole_;
  }
  [[nodiscard]] const Facts& facts() const { return facts_; }

 private:
  std::vector<Node> both_, sole_;
  Facts facts_;
};

}  // namespace comptonaut
