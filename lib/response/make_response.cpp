// SPDX-License-Identifier: BSD-3-Clause
#include "response/make_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <thread>

namespace comptonaut {
namespace {

constexpr std::int64_t kChunk = 20'000;  // photons of one random stream: what threads share out

double radians(int degrees) { return degrees * std::numbers::pi / 180.0; }

struct GridDirection {
  int phi_deg = 0;
  int theta_deg = 0;

  bool operator==(const GridDirection&) const = default;
};

Eigen::Vector3d unit_vector(const GridDirection& direction) {
  return direction_D(radians(direction.phi_deg), radians(direction.theta_deg));
}

/// All directions of the table: rings of equal theta; each pole is one direction.
std::vector<GridDirection> grid_directions(int step_deg) {
  std::vector<GridDirection> directions;
  for (int theta = 0; theta <= 180; theta += step_deg) {
    const int end = theta == 0 || theta == 180 ? 1 : 360;
    for (int phi = 0; phi < end; phi += step_deg) directions.push_back({.phi_deg = phi, .theta_deg = theta});
  }
  return directions;
}

/// The one that is simulated for it: phi turned and mirrored to 0..45 degrees.
GridDirection representative(const GridDirection& direction) {
  const int turned = direction.phi_deg % 90;
  return {.phi_deg = std::min(turned, 90 - turned), .theta_deg = direction.theta_deg};
}

/// Runs task(0) .. task(tasks - 1) on so many threads.
template <class Task>
void share_out(std::size_t tasks, int threads, const Task& task) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    auto worker = task();
    for (std::size_t i = next++; i < tasks; i = next++) worker(i);
  };
  std::vector<std::jthread> pool;
  for (int t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
}

bool is_enough(const ResponseConfig& config, const DirectionCounts& counts) {
  const bool pairs = config.rules.channels.front().pairs;
  return counts.singles.rel_sigma(counts.photons) < config.single_rel_sigma &&
         (!pairs || counts.pairs.rel_sigma(counts.photons) < config.pair_rel_sigma);
}

/// One direction after the other is one thread's task, so that where it ends does not depend on the others.
std::vector<DirectionCounts> simulate(const ResponseConfig& config, const Transport& transport,
                                      const std::vector<GridDirection>& directions,
                                      const std::function<void(double)>& progress) {
  const std::int64_t chunks = (config.photons + kChunk - 1) / kChunk;
  std::vector<DirectionCounts> counts(directions.size());
  std::mutex progress_mutex;
  std::int64_t done = 0;
  share_out(directions.size(), config.threads, [&] {
    return [&, simulator = PhotonSimulator(config, transport)](std::size_t task) mutable {
      DirectionCounts& of = counts[task];
      std::int64_t chunk = 0;
      const auto report = [&](std::int64_t now_done) {
        const std::lock_guard lock(progress_mutex);
        done += now_done;
        if (progress) progress(static_cast<double>(done) / static_cast<double>(chunks * std::ssize(directions)));
      };
      for (; chunk < chunks && !is_enough(config, of); ++chunk) {
        Random random(config.seed, task * static_cast<std::size_t>(chunks) + static_cast<std::size_t>(chunk));
        const std::int64_t photons = std::min(kChunk, config.photons - chunk * kChunk);
        of.add(simulator.simulate(unit_vector(directions[task]), photons, random));
        report(1);
      }
      report(chunks - chunk);
    };
  });
  return counts;
}

/// Solid angle of the ring of entries at theta, per entry, sr.
double cell_sr(int theta_deg, int step_deg) {
  const double low = radians(std::max(2 * theta_deg - step_deg, 0)),
               high = radians(std::min(2 * theta_deg + step_deg, 360));
  const double ring_sr = 2.0 * std::numbers::pi * (std::cos(0.5 * low) - std::cos(0.5 * high));
  return theta_deg % 180 == 0 ? ring_sr : ring_sr * step_deg / 360.0;
}

double photons_per_decay(const ResponseConfig& config) {
  double sum = 0.0;
  for (const GammaLine& line : emitted_lines(config.rules.channels.front())) sum += line.per_decay;
  return sum;
}

ResponseEntry make_entry(const GridDirection& direction, const DirectionCounts& counts, const Block& block,
                         const ResponseConfig& config) {
  // By the direction that was simulated, so that symmetric entries are equal to the last bit.
  const double reach = photons_per_decay(config) * solid_angle_sr(block, unit_vector(representative(direction)), 1.0) /
                       (4.0 * std::numbers::pi * static_cast<double>(counts.photons));
  return {.phi_rad = radians(direction.phi_deg),
          .theta_rad = radians(direction.theta_deg),
          .single = reach * counts.singles.sum(),
          .single_rel_sigma = counts.singles.rel_sigma(counts.photons),
          .pair = reach * counts.pairs.sum(),
          .pair_rel_sigma = counts.pairs.rel_sigma(counts.photons)};
}

std::vector<SimulatedPair> weighted_pairs(const std::vector<DirectionCounts>& counts,
                                          const std::vector<double>& weights) {
  std::vector<SimulatedPair> pairs;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (SimulatedPair pair : counts[i].simulated_pairs) {
      pair.weight *= weights[i];
      pairs.push_back(pair);
    }
  }
  return pairs;
}

ResponseTable::Facts facts_of(const ResponseConfig& config, const AngularSummary& angular) {
  const NuclideChannel& channel = config.rules.channels.front();
  ResponseTable::Facts facts{
      {"nuclide", channel.name},
      {"line_keV", fmt::format("{}", channel.line_keV)},
      {"photons_per_decay", fmt::format("{:.6g}", photons_per_decay(config))},
      {"singles_keV", fmt::format("{}..{}", channel.singles_min_keV, channel.singles_max_keV)},
      {"pairs", channel.pairs
                    ? fmt::format("summed energy within {:.6g} % of the line", 100.0 * channel.pair_sum_rel_window)
                    : "none: the lines give no pairs that can be told from other events"},
      {"photons_per_direction", fmt::format("{}{}", config.single_rel_sigma > 0.0 ? "at most " : "", config.photons)},
      {"seed", fmt::format("{}", config.seed)},
      {"sensor_um", fmt::format("{}", config.rules.sensor.thickness_um)},
      {"bias_V", fmt::format("{}", config.rules.sensor.bias_V)},
      {"unit", "events per decay at 1 m, without air"},
      {"pairs_simulated", fmt::format("{}", angular.pairs)}};
  if (angular.pairs == 0) return facts;
  const auto degrees = [](double rad) { return fmt::format("{:.3f}", rad * 180.0 / std::numbers::pi); };
  facts["p_hypothesis_a_true"] = fmt::format("{:.4f}", angular.a_is_true);
  facts["p_photon_scattered_first"] = fmt::format("{:.4f}", angular.has_truth);
  facts["angular_error_best_median_deg"] = degrees(angular.best_median_rad);
  facts["angular_error_best_q95_deg"] = degrees(angular.best_q95_rad);
  facts["angular_error_true_median_deg"] = degrees(angular.true_median_rad);
  facts["angular_error_true_q95_deg"] = degrees(angular.true_q95_rad);
  return facts;
}

void require(bool right, const std::string& what) {
  if (!right) throw std::invalid_argument("response: " + what);
}

}  // namespace

void check(const ResponseConfig& config) {
  check(config.rules);
  require(config.rules.channels.size() == 1,
          fmt::format("{} channels, must be exactly one", config.rules.channels.size()));
  for (const auto& [energy_keV, per_decay] : emitted_lines(config.rules.channels.front())) {
    require(energy_keV >= InteractionTable::kMin_keV && energy_keV <= InteractionTable::kMax_keV,
            fmt::format("a line at {} keV, must be from {} to {}", energy_keV, InteractionTable::kMin_keV,
                        InteractionTable::kMax_keV));
    require(per_decay > 0.0, fmt::format("{} photons of {} keV per decay, must be positive", per_decay, energy_keV));
  }
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  require(is_share(config.single_rel_sigma) && is_share(config.pair_rel_sigma),
          fmt::format("relative errors of {} and {}, must be 0 to 1", config.single_rel_sigma, config.pair_rel_sigma));
  require(config.thinning >= 1 && config.thinning <= 1000,
          fmt::format("a thinning of {}, must be 1 to 1000", config.thinning));
  require(config.photons >= 1 && config.photons <= 1'000'000'000'000,
          fmt::format("{} photons per direction, must be 1 to 10^12", config.photons));
  require(config.threads >= 1 && config.threads <= 1024, fmt::format("{} threads, must be 1 to 1024", config.threads));
  require(config.grid_deg >= 1 && 90 % config.grid_deg == 0,
          fmt::format("a grid of {} degrees, must divide 90", config.grid_deg));
}

Response make_response(const ResponseConfig& config, const Material& cdte,
                       const std::function<void(double)>& progress) {
  check(config);
  const Transport transport(sensor_block(config.rules.sensor), cdte);
  const std::vector<GridDirection> grid = grid_directions(config.grid_deg);
  std::vector<GridDirection> simulated;
  std::copy_if(grid.begin(), grid.end(), std::back_inserter(simulated),
               [](const GridDirection& direction) { return direction == representative(direction); });
  const std::vector<DirectionCounts> counts = simulate(config, transport, simulated, progress);

  std::vector<ResponseEntry> entries;
  std::vector<double> weights(simulated.size(), 0.0);  // of a photon, if a source is as likely in any direction
  for (const GridDirection& direction : grid) {
    const auto found = std::find(simulated.begin(), simulated.end(), representative(direction));
    const auto place = static_cast<std::size_t>(found - simulated.begin());
    const DirectionCounts& of = counts[place];
    weights[place] += cell_sr(direction.theta_deg, config.grid_deg) *
                      transport.block().projected_area_m2(unit_vector(direction)) / static_cast<double>(of.photons);
    entries.push_back(make_entry(direction, of, transport.block(), config));
  }
  std::vector<SimulatedPair> pairs = weighted_pairs(counts, weights);
  const AngularSummary angular = summarize(pairs);
  return {.table = ResponseTable(std::move(entries), facts_of(config, angular)),
          .angular = angular,
          .pairs = std::move(pairs)};
}

}  // namespace comptonaut
