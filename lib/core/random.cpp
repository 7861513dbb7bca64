// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace comptonaut {
namespace {

std::uint64_t splitmix64(std::uint64_t& x) {
  std::uint64_t z = (x += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t mixed = stream;
  std::uint64_t x = seed ^ splitmix64(mixed);
  for (std::uint64_t& word : state_) word = splitmix64(x);
}

Random::result_type Random::operator()() {
  auto& s = state_;
  const std::uint64_t result = std::rotl(s[0] + s[3], 23) + s[0];
  const std::uint64_t t = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= t;
  s[3] = std::rotl(s[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>((*this)() >> 11) * 0x1p-53; }

double Random::normal() {
  // Box and Muller; the second value is dropped so that the generator's state is its seed's words alone.
  const double radius = std::sqrt(-2.0 * std::log1p(-uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double Random::exponential() { return -std::log1p(-uniform()); }

std::int64_t Random::poisson(double mean) {
  // Arrivals of a process with unit rate within the mean (Knuth), in stretches whose exp(-stretch) is a normal number.
  // The standard library's way calls lgamma, whose sign is a global variable: a race among threads.
  constexpr double kStretch = 500.0;
  std::int64_t n = 0;
  for (double left = mean; left > 0.0; left -= kStretch) {
    const double end = std::exp(-std::min(left, kStretch));
    for (double product = 1.0 - uniform(); product > end; product *= 1.0 - uniform()) ++n;
  }
  return n;
}

Eigen::Vector3d Random::unit_vector() {
  const double z = uniform(-1.0, 1.0);
  const double phi = uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace comptonaut
