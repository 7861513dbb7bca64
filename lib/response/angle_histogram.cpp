// SPDX-License-Identifier: BSD-3-Clause
#include "response/angle_histogram.h"

#include <algorithm>
#include <numbers>

#include "core/angle.h"
#include "response/fit_cone_density.h"

namespace comptonaut {
namespace {

std::vector<AngleBin> empty_bins() {
  std::vector<AngleBin> bins;
  for (int from = -180; from < 180;) {
    const int to = from + (from >= -20 && from < 20 ? 1 : 5);
    bins.push_back({.from_rad = from * kDegree, .to_rad = to * kDegree});
    from = to;
  }
  return bins;
}

/// Mean of the density over a bin, by Simpson's rule.
double mean_per_rad(const ConeProfile& profile, const AngleBin& bin) {
  const double middle_rad = 0.5 * (bin.from_rad + bin.to_rad);
  return (profile.per_rad(bin.from_rad) + 4.0 * profile.per_rad(middle_rad) + profile.per_rad(bin.to_rad)) / 6.0;
}

}  // namespace

std::vector<AngleBin> angle_histogram(std::span<const SimulatedPair> pairs, const ConeDensity& density) {
  constexpr std::size_t kMostForModel = 5000;  // profiles are slow, and their mean is smooth
  std::vector<AngleBin> bins = empty_bins();
  double total = 0.0, model_total = 0.0;
  const std::size_t every = pairs.size() / kMostForModel + 1;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const ConeSample& sample : cone_samples(pairs[i])) {
      const auto after = std::upper_bound(bins.begin(), bins.end(), delta_rad(sample.cone),
                                          [](double delta, const AngleBin& bin) { return delta < bin.from_rad; });
      AngleBin& bin = after == bins.begin() ? bins.front() : *(after - 1);
      bin.pairs += 1.0;
      bin.measured_per_rad += sample.weight;
      total += sample.weight;
      if (i % every != 0) continue;
      const ConeProfile profile = density.profile(sample.cone.cos_beta, sample.readings);
      for (AngleBin& of : bins) of.model_per_rad += sample.weight * mean_per_rad(profile, of);
      model_total += sample.weight;
    }
  }
  for (AngleBin& bin : bins) {
    bin.measured_per_rad /= total * (bin.to_rad - bin.from_rad);
    bin.model_per_rad /= model_total;
  }
  return bins;
}

}  // namespace comptonaut
