// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace comptonaut {

/// Seeded random numbers, the same on every machine: xoshiro256++ (Blackman and Vigna 2019) seeded by splitmix64.
/// Generators of different streams of one seed are independent, so that work can be shared among threads without a
/// change of results. Satisfies std::uniform_random_bit_generator.
class Random {
 public:
  using result_type = std::uint64_t;

  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  result_type operator()();
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }

  /// In [0, 1).
  double uniform();
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Mean 0, standard deviation 1.
  double normal();
  /// Mean 1.
  double exponential();
  /// Any mean >= 0; takes time in proportion to the mean.
  std::int64_t poisson(double mean);
  /// Isotropic.
  Eigen::Vector3d unit_vector();

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace comptonaut
