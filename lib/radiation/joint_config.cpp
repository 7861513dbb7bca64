// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/joint_config.h"

#include <algorithm>

#include "config/config.h"

namespace comptonaut {
namespace {

void read_use(Config& config, JointConfig& joint) {
  std::vector<std::string> use;
  config.read("use", use);
  if (!config.has("use")) return;
  const auto has = [&](const char* kind) { return std::find(use.begin(), use.end(), kind) != use.end(); };
  joint.use_pairs = has("pairs");
  joint.use_singles = has("singles");
  const auto known = static_cast<std::size_t>(joint.use_pairs) + static_cast<std::size_t>(joint.use_singles);
  if (use.empty() || known != use.size()) throw config.error("use", "must be a list of pairs, singles or both");
}

}  // namespace

JointConfig read_joint_config(Config& config) {
  JointConfig joint;
  read_use(config, joint);
  config.read("attenuation_per_m", joint.attenuation_per_m, {.min = 0.0, .max = 10.0});
  config.read("attitude_sigma_rad", joint.attitude_sigma_rad, {.min = 0.0, .max = 1.0});
  config.read("pass_sigma_m", joint.pass_sigma_m, {.min = 0.0, .max = 10.0});
  config.read("pass_s", joint.pass_s, {.min = 0.05, .max = 3600.0});
  config.read("alignment_sigma_rad", joint.alignment_sigma_rad, {.min = 1e-6, .max = 1.0});
  config.read("response_rel_sigma", joint.response_rel_sigma, {.min = 1e-4, .max = 1.0});
  config.read("scatter_share", joint.scatter_share, {.min = 0.0, .max = 10.0});
  config.read("scatter_share_sigma", joint.scatter_share_sigma, {.min = 1e-4, .max = 10.0});
  config.read("gain_to_add", joint.gain_to_add, {.min = 1.0, .max = 1e6});
  config.read("loss_to_drop", joint.loss_to_drop, {.min = 0.0, .max = 1e6});
  config.read("loss_to_reseed", joint.loss_to_reseed, {.min = 0.0, .max = 1e6});
  config.read("height_max_m", joint.height_max_m, {.min = 0.0, .max = 100.0});
  config.read("gain_to_lift", joint.gain_to_lift, {.min = 1.0, .max = 1e6});
  config.read("drift_s", joint.drift_s, {.min = 1.0, .max = 1e6});
  config.read("drift_sigma", joint.drift_sigma, {.min = 1e-4, .max = 10.0});
  config.read("score_spacing_m", joint.score_spacing_m, {.min = 0.1, .max = 100.0});
  config.read("candidates", joint.candidates, {.min = 1, .max = 100});
  config.read("activity_min_Bq", joint.activity_min_Bq, {.min = 1.0, .max = 1e15});
  config.read("activity_max_Bq", joint.activity_max_Bq, {.min = 1.0, .max = 1e15});
  if (joint.activity_min_Bq >= joint.activity_max_Bq)
    throw config.error("activity_min_Bq", "must be below activity_max_Bq");
  config.read("known_rel_sigma", joint.known_rel_sigma, {.min = 1e-3, .max = 10.0});
  config.read("sources_max", joint.sources_max, {.min = 1, .max = 32});
  config.read("map_steps", joint.map_steps, {.min = 1, .max = 10000});
  if (joint.loss_to_drop > joint.gain_to_add) throw config.error("loss_to_drop", "must not exceed gain_to_add");
  return joint;
}

}  // namespace comptonaut
