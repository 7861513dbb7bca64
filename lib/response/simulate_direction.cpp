// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "response/make_response.h"

namespace comptonaut {
namespace {

constexpr double kFar_m = std::numeric_limits<double>::infinity();
constexpr std::int64_t kThinningOutside = 64;
constexpr double kMargin_px = 5.0;   // tracks of electrons move centroids
constexpr double kMarginRel = 0.05;  // resolution, charge below the threshold
constexpr double kMargin_keV = 30.0;
constexpr double kLeast_keV = 5.0;  // a deposit that shows

void add(Tally& to, const Tally& more) {
  to.weight += more.weight;
  to.weight2 += more.weight2;
}

double sum_keV(const PhotonHistory& history) {
  double sum = 0.0;
  for (const Deposit& deposit : history.deposits) sum += deposit.energy_keV;
  return sum;
}

}  // namespace

double Tally::rel_sigma(std::int64_t photons) const {
  if (weight == 0) return 1.0;
  return std::sqrt(static_cast<double>(weight2) / std::pow(sum(), 2) - 1.0 / static_cast<double>(photons));
}

void DirectionCounts::add(const DirectionCounts& more) {
  photons += more.photons;
  interacted += more.interacted;
  comptonaut::add(singles, more.singles);
  comptonaut::add(pairs, more.pairs);
  comptonaut::add(others, more.others);
  simulated_pairs.insert(simulated_pairs.end(), more.simulated_pairs.begin(), more.simulated_pairs.end());
}

PhotonSimulator::PhotonSimulator(const ResponseConfig& config, const Transport& transport)
    : config_(config),
      transport_(transport),
      lines_(emitted_lines(config.rules.channels.front())),
      digitizer_(config.digitizer, config.rules.sensor, config.calibration),
      events_(config.rules, config.calibration) {
  for (const GammaLine& line : lines_) lines_per_decay_ += line.per_decay;
}

DirectionCounts PhotonSimulator::simulate(const Eigen::Vector3d& u_D, std::int64_t photons, Random& random) {
  DirectionCounts counts;
  counts.photons = photons;
  for (std::int64_t i = 0; i < photons; ++i) {
    const double energy_keV = draw_energy_keV(random);
    const Photon photon = sample_entry(transport_.block(), u_D, kFar_m, energy_keV, random);
    const PhotonHistory history = transport_.follow(photon, random);
    if (history.deposits.empty()) continue;
    ++counts.interacted;
    const std::int64_t weight = photons_per_digitized(history);
    if (weight > 1 && static_cast<double>(weight) * random.uniform() >= 1.0) continue;
    hits_.clear();
    digitizer_.digitize(history.deposits, 0.0, random, hits_);
    for (const DetectorEvent& event : events_.find(hits_)) count(event, history, weight, u_D, counts);
  }
  return counts;
}

double PhotonSimulator::draw_energy_keV(Random& random) const {
  if (lines_.size() == 1) return lines_.front().energy_keV;
  double left = random.uniform() * lines_per_decay_;
  std::size_t line = 0;
  while (line + 1 < lines_.size() && left >= lines_[line].per_decay) left -= lines_[line++].per_decay;
  return lines_[line].energy_keV;
}

std::int64_t PhotonSimulator::photons_per_digitized(const PhotonHistory& history) const {
  if (config_.thinning == 1) return 1;
  const double deposited_keV = sum_keV(history);
  if (may_be_pair(history, deposited_keV)) return 1;
  return may_be_single(deposited_keV) ? config_.thinning : kThinningOutside;
}

bool PhotonSimulator::may_be_pair(const PhotonHistory& history, double deposited_keV) const {
  const NuclideChannel& channel = config_.rules.channels.front();
  const double off_rel = std::abs(deposited_keV / channel.line_keV - 1.0);
  if (!channel.pairs || off_rel > channel.pair_sum_rel_window + kMarginRel) return false;
  const double apart_m = 1e-6 * kPixelPitch_um * (config_.rules.pair_distance_min_px - kMargin_px);
  for (const Deposit& a : history.deposits) {
    for (const Deposit& b : history.deposits) {
      if (a.energy_keV < kLeast_keV || b.energy_keV < kLeast_keV) continue;
      if ((a.p_D - b.p_D).head<2>().squaredNorm() > apart_m * apart_m) return true;
    }
  }
  return false;
}

bool PhotonSimulator::may_be_single(double deposited_keV) const {
  const NuclideChannel& channel = config_.rules.channels.front();
  return deposited_keV > channel.singles_min_keV * (1.0 - kMarginRel) - kMargin_keV &&
         deposited_keV < channel.singles_max_keV * (1.0 + kMarginRel) + kMargin_keV;
}

void PhotonSimulator::count(const DetectorEvent& event, const PhotonHistory& history, std::int64_t weight,
                            const Eigen::Vector3d& u_D, DirectionCounts& counts) const {
  const bool of_channel = event.channel == 0;
  if (of_channel && event.kind == EventKind::kPair) {
    counts.pairs.add(weight);
    counts.simulated_pairs.push_back(compare_with_photon(event, history.deposits, u_D, config_.rules.sensor));
    counts.simulated_pairs.back().weight = static_cast<double>(weight);
  } else {
    (of_channel && event.kind == EventKind::kSingle ? counts.singles : counts.others).add(weight);
  }
}

}  // namespace comptonaut
