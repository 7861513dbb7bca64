// SPDX-License-Identifier: BSD-3-Clause
#include "sim/load_setup.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "config/config.h"
#include "core/hash.h"
#include "sim/fit.h"

namespace comptonaut {
namespace {

std::uint64_t fingerprint(const std::vector<std::filesystem::path>& files, const Scenario& scenario) {
  Fnv1a hash;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    hash.add(std::string(std::istreambuf_iterator<char>(in), {}));
  }
  for (const World* world : {&scenario.world, &scenario.team_world()}) hash.add(world->hash());
  return hash.value();
}

}  // namespace

MissionSetup load_setup(const MissionFiles& files) {
  const std::filesystem::path folder = files.coordinator.parent_path();
  const Scenario scenario = load_scenario(files.scenario);
  const auto reader = load_detector_reader_config(folder / "detector-reader.yaml");
  const auto mapper = load_config(folder / "mapper.yaml", read_mapper_config);
  auto bridge = load_config(folder / "pose-bridge.yaml", read_pose_bridge_config);
  auto coordinator = load_config(files.coordinator, read_coordinator_config);
  if (!coordinator.terrain.octomap.empty() || coordinator.terrain.heightmap) {
    throw std::runtime_error(fmt::format("{}: {}: a campaign flies in the scenario's world, must be left out",
                                         files.coordinator.string(),
                                         coordinator.terrain.heightmap ? "heightmap" : "octomap"));
  }
  fit_to(scenario, coordinator);
  coordinator.map_period_s = scenario.horizon_s;  // nobody looks at the tiles
  fit_to(scenario, bridge);
  return {.scenario = scenario,
          .camera = sim_camera(reader, mapper, scenario),
          .calibration = load_calibration(reader),
          .response = ResponseTable::load(coordinator.response_table),
          .cones = load_cone_density(coordinator),
          .more_nuclides = load_more_nuclides(coordinator),
          .detector_reader = reader,
          .pose_bridge = bridge,
          .mapper = mapper,
          .coordinator = coordinator,
          .fingerprint =
              fingerprint({files.scenario, files.coordinator, folder / "detector-reader.yaml", folder / "mapper.yaml",
                           folder / "pose-bridge.yaml", coordinator.response_table, coordinator.cone_density},
                          scenario)};
}

}  // namespace comptonaut
