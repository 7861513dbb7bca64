// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/reconstruction.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "radiation/joint_estimator.h"
#include "radiation/local_maxima.h"
#include "radiation/map_sources.h"
#include "radiation/mlem_estimator.h"
#include "radiation/response_lookup.h"

namespace comptonaut {
namespace {

using Progress = std::function<void(double)>;

constexpr double kGainOfNothing = 1e-3;  // in log likelihood
constexpr double kShareOfMap = 0.7;      // of the time, roughly, where there are sources to be found besides

bool is_of(const MeasurementBatch& batch, const Cone& cone, const std::string& nuclide) {
  return batch.channels.at(static_cast<std::size_t>(cone.channel)).nuclide == nuclide;
}

bool has_map(const ReconstructionConfig& config) { return config.with_map || config.estimator == "mlem"; }

void check(const ReconstructionConfig& config, const Cells& cells, const MeasuredEvents& events) {
  if (cells.size() == 0) throw std::invalid_argument("the grid has no cells, must have one at least");
  if (config.estimator != "mlem" && config.estimator != "joint") {
    throw std::invalid_argument(fmt::format("estimator '{}' is unknown, must be mlem or joint", config.estimator));
  }
  const double n = static_cast<double>(cells.size());
  const double spacing_m = std::max(config.joint.score_spacing_m, cells.cell_m());
  const double places = n * cells.cell_m() * cells.cell_m() / (spacing_m * spacing_m);
  const double map_B = has_map(config) ? 2.0 * n * static_cast<double>(events.cones) : 0.0;
  const double scores_B = config.estimator == "joint" ? 4.0 * places * static_cast<double>(events.photons) : 0.0;
  if (map_B + scores_B <= config.memory_max_B) return;
  throw std::invalid_argument(
      fmt::format("{} cones on {} cells take {:.1f} GB of memory, {:.1f} GB are the most: use "
                  "larger cells, a smaller grid or fewer cones",
                  events.cones, cells.size(), 1e-9 * (map_B + scores_B), 1e-9 * config.memory_max_B));
}

/// The map of pairs.
void fill_map(const ReconstructionConfig& config, const Cells& cells, const ResponseTable& response,
              std::span<const MeasurementBatch> batches, const Progress& progress, Reconstruction& result) {
  MlemEstimator mlem(config.mlem, cells, config.nuclide, pair_lookup(response));
  for (std::size_t i = 0; i < batches.size(); ++i) {
    if (i % 1024 == 0) progress(static_cast<double>(i) / static_cast<double>(batches.size()));
    mlem.add(batches[i]);
  }
  mlem.update();
  result.lambda_Bq.assign(mlem.lambda_Bq().begin(), mlem.lambda_Bq().end());
  result.sensitivity_s.assign(mlem.sensitivity_s().begin(), mlem.sensitivity_s().end());
  result.map_change = mlem.change();
  result.cones_outside = mlem.cones_outside();
}

/// Each update also tries to split another one of the sources: nothing is left to gain when none of them gained.
void fill_joint(const ReconstructionConfig& config, const Cells& cells, const ResponseTable& response,
                const ConeDensity& cones, std::span<const MeasurementBatch> batches, const Progress& progress,
                Reconstruction& result) {
  JointConfig only_sources = config.joint;
  only_sources.map_steps = 0;
  JointEstimator joint(only_sources, cells, config.nuclide, response, cones);
  for (const MeasurementBatch& batch : batches) joint.add(batch);
  std::size_t idle = 0;
  for (double before = 0.0; result.updates < config.updates_max && !result.converged; before = joint.log_likelihood()) {
    joint.update();
    const bool gained = result.updates++ == 0 || joint.log_likelihood() - before > kGainOfNothing;
    idle = gained ? 0 : idle + 1;
    const std::size_t enough = std::max<std::size_t>(1, joint.sources().size());
    result.converged = idle >= enough;
    progress(static_cast<double>(idle + 1) / static_cast<double>(enough + 1));
  }
  result.sources = joint.sources();
  result.log_likelihood = joint.log_likelihood();
  result.certificate_s = joint.certificate_s();
  result.coverage = joint.coverage();
}

}  // namespace

MeasuredEvents measured_events(std::span<const MeasurementBatch> batches, const std::string& nuclide) {
  MeasuredEvents events;
  for (const MeasurementBatch& batch : batches) {
    std::int32_t last_event = -1;
    for (const Cone& cone : batch.cones) {
      if (!is_of(batch, cone, nuclide)) continue;
      ++events.cones;
      events.photons += cone.event != last_event ? 1 : 0;
      last_event = cone.event;
    }
    if (batch.live_us <= 0) continue;
    ++events.viewpoints;
    events.live_s += seconds(batch.live_us);
    for (const ChannelCounts& counts : batch.channels) events.singles += counts.nuclide == nuclide ? counts.singles : 0;
  }
  return events;
}

std::vector<MeasurementBatch> above_ground(std::vector<MeasurementBatch> batches, double ground_m,
                                           std::int64_t& below) {
  below += std::erase_if(batches, [&](const MeasurementBatch& batch) { return batch.p_WD.z() < ground_m; });
  for (MeasurementBatch& batch : batches) {
    below += std::erase_if(batch.cones, [&](const Cone& cone) { return cone.p_WS.z() < ground_m; });
  }
  return batches;
}

Reconstruction reconstruct(const ReconstructionConfig& config, const Cells& cells, const ResponseTable& response,
                           const ConeDensity& cones, std::span<const MeasurementBatch> batches,
                           const std::function<void(double)>& progress) {
  Reconstruction result{.nuclide = config.nuclide, .estimator = config.estimator};
  result.events = measured_events(batches, config.nuclide);
  check(config, cells, result.events);
  const bool joint = config.estimator == "joint";
  const double map_share = joint ? (config.with_map ? kShareOfMap : 0.0) : 1.0;
  const auto tell = [&](double share) {
    if (progress) progress(share);
  };
  fill_map(
      config, cells, response, batches, [&](double share) { tell(map_share * share); }, result);
  if (joint) {
    const auto rest = [&](double share) { tell(map_share + (1.0 - map_share) * share); };
    fill_joint(config, cells, response, cones, batches, rest, result);
  } else {
    result.sources = sources_of_map(cells, result.lambda_Bq, local_maxima(cells, result.lambda_Bq), config.nuclide,
                                    config.mlem.source_radius_m);
  }
  return result;
}

}  // namespace comptonaut
