// SPDX-License-Identifier: BSD-3-Clause
#include "detector/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace comptonaut {
namespace {

/// More clusters at once come from a shower or from noise: not worth a search for what belongs together.
constexpr std::size_t kMaxClusters = 64;

double square(double x) { return x * x; }
double distance_px(const Cluster& a, const Cluster& b) {
  return std::sqrt(square(a.x_px - b.x_px) + square(a.y_px - b.y_px));
}

bool looks_like_fluorescence(const EventRules& rules, const Cluster& cluster) {
  return cluster.energy_keV >= rules.fluorescence_min_keV && cluster.energy_keV <= rules.fluorescence_max_keV;
}

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The cluster within reach that emitted cluster i as fluorescence: the nearest that is not weaker, else the nearest;
/// kNone: there is none.
std::size_t parent_of(const EventRules& rules, const std::vector<Cluster>& group, std::size_t i) {
  struct Nearest {
    double px;
    std::size_t cluster = kNone;
    void see(double d_px, std::size_t j) {
      if (d_px > px || (cluster != kNone && d_px == px)) return;
      px = d_px;
      cluster = j;
    }
  };
  Nearest any{rules.fluorescence_radius_px}, not_weaker = any;
  for (std::size_t j = 0; j < group.size(); ++j) {
    if (j == i) continue;
    const double d_px = distance_px(group[i], group[j]);
    any.see(d_px, j);
    if (group[j].energy_keV >= group[i].energy_keV) not_weaker.see(d_px, j);
  }
  return not_weaker.cluster != kNone ? not_weaker.cluster : any.cluster;
}

/// Adds the energy of fluorescence to the cluster that emitted it. Its place and time stay: there the photon
/// interacted.
void take_in(const Cluster& fluorescence, Cluster& into) {
  into.energy_keV += fluorescence.energy_keV;
  into.tot_sum += fluorescence.tot_sum;
  into.size_px += fluorescence.size_px;
  into.saturated |= fluorescence.saturated;
}

/// Which of two clusters is fluorescence of the other, the weaker one if both may be; kNone: neither.
std::size_t fluorescence_of_two(const EventRules& rules, std::span<const Cluster> two) {
  const bool first = looks_like_fluorescence(rules, two[0]), second = looks_like_fluorescence(rules, two[1]);
  if (!(first | second) || distance_px(two[0], two[1]) > rules.fluorescence_radius_px) return kNone;
  return second && !(first && two[0].energy_keV <= two[1].energy_keV) ? 1 : 0;
}

/// Takes fluorescence into the clusters that emitted it, the weakest first.
void merge_fluorescence(const EventRules& rules, std::vector<Cluster>& group) {
  while (group.size() > 1) {
    std::size_t weakest = kNone, parent = kNone;
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (!looks_like_fluorescence(rules, group[i])) continue;
      if (weakest != kNone && group[i].energy_keV >= group[weakest].energy_keV) continue;
      const std::size_t found = parent_of(rules, group, i);
      if (found == kNone) continue;
      weakest = i;
      parent = found;
    }
    if (weakest == kNone) return;
    take_in(group[weakest], group[parent]);
    group.erase(group.begin() + static_cast<std::ptrdiff_t>(weakest));
  }
}

void classify_single(const EventRules& rules, DetectorEvent& event) {
  if (event.first.saturated) return;
  for (std::size_t c = 0; c < rules.channels.size(); ++c) {
    const NuclideChannel& channel = rules.channels[c];
    if (event.first.energy_keV < channel.singles_min_keV || event.first.energy_keV > channel.singles_max_keV) continue;
    event.kind = EventKind::kSingle;
    event.channel = static_cast<int>(c);
    return;
  }
}

/// Of a pair's two clusters, freed of what they lost.
double sum_keV(const EventRules& rules, const DetectorEvent& pair) {
  return deposited_keV(rules.sensor, pair.first.energy_keV) + deposited_keV(rules.sensor, pair.second.energy_keV);
}

/// The channel whose line is nearest to the summed energy, of those that can explain the pair.
void classify_pair(const EventRules& rules, std::span<const PairReader> readers, DetectorEvent& event) {
  if (event.first.saturated || event.second.saturated) return;
  if (distance_px(event.first, event.second) < rules.pair_distance_min_px) return;
  double nearest = 1.0;
  for (std::size_t c = 0; c < rules.channels.size(); ++c) {
    const NuclideChannel& channel = rules.channels[c];
    const double rel_difference = std::abs(event.energy_keV / channel.line_keV - 1.0);
    if (!channel.pairs || rel_difference >= nearest) continue;
    const auto hypotheses =
        rules.constrain_to_line
            ? pair_hypotheses(rules.sensor, channel, readers[c], event.first, event.second)
            : pair_hypotheses(rules.sensor, channel, PairReader(sum_keV(rules, event)), event.first, event.second);
    if (!hypotheses) continue;
    nearest = rel_difference;
    event.kind = EventKind::kPair;
    event.channel = static_cast<int>(c);
    event.hypotheses = hypotheses;
  }
}

void require(bool right, const char* name, double value, const char* what) {
  if (!right) throw std::invalid_argument(fmt::format("{} = {}: must be {}", name, value, what));
}

}  // namespace

void check(const EventRules& rules) {
  check(rules.sensor);
  check(rules.channels);
  require(rules.cluster_window_ns > 0.0 && rules.cluster_window_ns <= 1e5, "cluster_window_ns", rules.cluster_window_ns,
          "above 0, at most 100000");
  require(rules.fluorescence_min_keV <= rules.fluorescence_max_keV, "fluorescence_min_keV", rules.fluorescence_min_keV,
          "at most fluorescence_max_keV");
  require(max_drift_ns(rules.sensor) <= 1e5, "drift time through the sensor, ns", max_drift_ns(rules.sensor),
          "at most 100000");
}

EventFinder::EventFinder(const EventRules& rules, Calibration calibration)
    : rules_(rules),
      calibration_(std::move(calibration)),
      cluster_finder_(rules.sensor, rules.cluster_window_ns),
      drift_ns_(max_drift_ns(rules.sensor)) {
  check(rules);
  for (const NuclideChannel& channel : rules.channels) pair_readers_.emplace_back(channel.line_keV);
}

std::span<const DetectorEvent> EventFinder::find(std::span<const Hit> hits) {
  clusters_ = cluster_finder_.find(hits, calibration_);
  events_.clear();
  for (std::size_t first = 0, last = 0; first < clusters_.size(); first = last) {
    for (++last; last < clusters_.size() && between_ns(clusters_[first], clusters_[last]) <= drift_ns_;) ++last;
    add_event(clusters_.subspan(first, last - first));
  }
  return events_;
}

void EventFinder::add_event(std::span<const Cluster> group) {
  DetectorEvent& event = events_.emplace_back();
  event.clusters = static_cast<int>(group.size());
  event.first = group.front();
  for (const Cluster& cluster : group) {
    event.hits += cluster.size_px;
    event.tot_ticks += cluster.tot_sum;
    event.energy_keV += cluster.energy_keV;
  }
  if (group.size() == 1) return classify_single(rules_, event);
  if (group.size() == 2) {
    const std::size_t fluorescence = fluorescence_of_two(rules_, group);
    if (fluorescence == kNone) {
      event.second = group[1];
      return classify_pair(rules_, pair_readers_, event);
    }
    if (fluorescence == 0) event.first = group[1];
    take_in(group[fluorescence], event.first);
    return classify_single(rules_, event);
  }
  if (group.size() > kMaxClusters) return;

  group_.assign(group.begin(), group.end());
  merge_fluorescence(rules_, group_);
  event.first = group_.front();
  if (group_.size() == 1) return classify_single(rules_, event);
  event.second = group_[1];
  if (group_.size() == 2) classify_pair(rules_, pair_readers_, event);
}

ChipTime EventFinder::quiet() const {
  // Cluster times differ from hit times by the cluster's length and by time walk.
  const double walk_ns = time_walk_ns(rules_.sensor, 0.0);
  return static_cast<ChipTime>(std::ceil((std::max(rules_.cluster_window_ns, drift_ns_) + walk_ns) / kChipTime_ns)) + 1;
}

std::vector<DetectorEvent> find_events(std::span<const Hit> hits, const EventRules& rules,
                                       const Calibration& calibration) {
  EventFinder finder(rules, calibration);
  const auto events = finder.find(hits);
  return {events.begin(), events.end()};
}

}  // namespace comptonaut
