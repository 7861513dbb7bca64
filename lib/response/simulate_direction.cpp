// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "response/make_response.h"

namespace comptonaut {
namespace {

constexpr double kFar_m = std::numeric_limits<double>::infinity();

}  // namespace

void DirectionCounts::add(const DirectionCounts& more) {
  photons += more.photons;
  interacted += more.interacted;
  singles += more.singles;
  pairs += more.pairs;
  others += more.others;
  angular_errors.insert(angular_errors.end(), more.angular_errors.begin(), more.angular_errors.end());
  cones.insert(cones.end(), more.cones.begin(), more.cones.end());
}

PhotonSimulator::PhotonSimulator(const ResponseConfig& config, const Transport& transport)
    : config_(config),
      transport_(transport),
      digitizer_(config.digitizer, config.rules.sensor, config.calibration),
      events_(config.rules, config.calibration) {}

DirectionCounts PhotonSimulator::simulate(const Eigen::Vector3d& u_D, std::int64_t photons, Random& random) {
  DirectionCounts counts;
  counts.photons = photons;
  const double line_keV = config_.rules.channels.front().line_keV;
  for (std::int64_t i = 0; i < photons; ++i) {
    const Photon photon = sample_entry(transport_.block(), u_D, kFar_m, line_keV, random);
    const PhotonHistory history = transport_.follow(photon, random);
    if (history.deposits.empty()) continue;
    ++counts.interacted;
    hits_.clear();
    digitizer_.digitize(history.deposits, 0.0, random, hits_);
    for (const DetectorEvent& event : events_.find(hits_)) count(event, history, u_D, counts);
  }
  return counts;
}

void PhotonSimulator::count(const DetectorEvent& event, const PhotonHistory& history, const Eigen::Vector3d& u_D,
                            DirectionCounts& counts) const {
  if (event.channel != 0) {
    ++counts.others;
  } else if (event.kind == EventKind::kSingle) {
    ++counts.singles;
  } else if (event.kind == EventKind::kPair) {
    ++counts.pairs;
    const AngularError error = angular_error(event, history.deposits, u_D, config_.rules.sensor);
    const std::vector<ConeSample> cones = cone_samples(event, error, u_D);
    counts.angular_errors.push_back(error);
    counts.cones.insert(counts.cones.end(), cones.begin(), cones.end());
  } else {
    ++counts.others;
  }
}

}  // namespace comptonaut
