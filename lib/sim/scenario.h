// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/cells.h"
#include "nodes/truth.h"
#include "sim/range_sensor.h"
#include "world/world.h"

namespace comptonaut {

/// A team of alike MAVs, hovering at their starts when the mission begins.
struct ScenarioMavs {
  int count = 3;
  double height_m = 2.0;  ///< above the ground
  double speed_max_m_s = 8.0;
  double acceleration_max_m_s2 = 4.0;
  double endurance_s = 1200.0;           ///< of a full battery, whatever the MAV does
  std::vector<Eigen::Vector2d> start_W;  ///< one for each MAV, m
};

/// Sources that each seed puts elsewhere: uniform in the area, `margin_m` inside its border, at least `distance_min_m`
/// from each other, from listed sources and from the patch's edge.
struct SourceDraw {
  std::vector<double> activities_Bq;  ///< one source each, or
  int count = 0;                      ///< so many sources, log-uniform between
  double activity_min_Bq = 0.0;
  double activity_max_Bq = 0.0;
  double distance_min_m = 0.0;
  double margin_m = 1.0;
  double height_m = 0.0;              ///< of each above the ground: on a shelf, on a vehicle
  double surface_max_m = 1e9;         ///< only where the surface is no higher: not on roofs
  int behind_walls = 0;               ///< so many, the first ones, where hidden_share is at least kBehindWalls
  std::vector<std::string> nuclides;  ///< of the first source, the second, ...; then again from the first; empty: one
};

/// Activity spread evenly over a disc on the ground.
struct Patch {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;  ///< of the surface in its middle
  double radius_m = 0.0;
  double activity_Bq = 0.0;  ///< of the whole disc
};

/// Where the simulated truth is not the estimator's model. All zero, drift one: ideal.
struct Mismatch {
  double position_sigma_m = 0.02;        ///< of the odometry, per axis
  double attitude_sigma_rad = 0.01745;   ///< of the odometry, per axis
  double pose_correlation_s = 2.0;       ///< over which the odometry's errors last
  double boresight_sigma_rad = 0.01745;  ///< of the camera's mount, per axis, once per drone
  double response_sigma = 0.03;          ///< relative scale of the response, once per drone
  double scatter_share = 0.2;            ///< events from ground and air without direction, per event of a direct photon
  double dead_time_us = 20.0;            ///< after each event, in which the next one is lost unnoticed
  double background_drift = 1.0;         ///< background at the horizon over that at the start, growing steadily
  double stray_share = 0.0;              ///< of the photons that reach a camera, from anywhere instead of their source
};

/// Faults of real hit streams. All off by default.
struct Traps {
  double epoch_fault_share = 0.0;       ///< of events with one hit, or all, 16,384 ticks (409.6 us) late
  double repeated_pixel_share = 0.0;    ///< of hits that come twice
  double tot_zero_share = 0.0;          ///< of hits with ToT 0
  int hot_pixels = 0;                   ///< per detector
  double hot_pixel_hits_per_s = 100.0;  ///< of each hot pixel
  double lost_data_per_s = 0.0;         ///< gaps that the readout announces, per second
  double lost_data_s = 0.002;           ///< length of each gap
  double broken_rows_per_s = 0.0;       ///< rows that are not hits: cut short or not text
};

/// One experiment: config/scenarios/*.yaml.
struct Scenario {
  std::string name;
  double horizon_s = 300.0;
  Area area{0.0, 50.0, 0.0, 50.0};
  double cell_m = 0.5;
  World world = World::flat();
  std::optional<World> known_world;   ///< what the team's map holds at the start, where that is not the world
  std::string material = "concrete";  ///< of what is occupied (Shield)
  ScenarioMavs mavs;
  std::string nuclide = "Cs-137";          ///< of all sources that do not say otherwise
  std::vector<std::string> more_nuclides;  ///< that sources may be of, by rising line
  double air_attenuation_per_m = 0.0093;   ///< of the line, at sea level
  double background_singles_per_s = 3.0;   ///< per drone, in the nuclide's singles window
  SourceDraw draw;
  std::vector<TrueSource> sources;  ///< listed ones, the same for each seed
  std::optional<Patch> patch;
  std::optional<RangeSensorConfig> range_sensor;  ///< on each MAV
  Mismatch mismatch;
  Traps traps;

  [[nodiscard]] const World& team_world() const { return known_world ? *known_world : world; }
};

/// Throws ConfigError that names file, line and key.
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& file);

/// The same scenario with the truth as the estimator models it, and no traps.
[[nodiscard]] Scenario idealised(Scenario scenario);

/// Share of the places 2 m above the surface at some metres around from which a source at p_W cannot be seen straight.
[[nodiscard]] double hidden_share(const World& world, const Eigen::Vector3d& p_W);
inline constexpr double kBehindWalls = 0.4;

/// The listed and the drawn point sources of one seed. The same for the same seed, whatever else changes.
/// Throws std::runtime_error that names the scenario where no layout with the asked distances is found.
[[nodiscard]] std::vector<TrueSource> draw_sources(const Scenario& scenario, std::uint64_t seed);

}  // namespace comptonaut
