// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/detector_reader_config.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "config/config.h"

namespace comptonaut {
namespace {

void read_sensor(Config& config, SensorConfig& sensor) {
  config.read("thickness_um", sensor.thickness_um, {.min = 100.0, .max = 10e3});
  config.read("bias_V", sensor.bias_V, {.min = -5e3, .max = -1.0});
  config.read("mobility_cm2_V_s", sensor.mobility_cm2_V_s, {.min = 10.0, .max = 1e5});
  config.read("mirror_x", sensor.mirror_x);
  config.read("walk_keV_ns", sensor.walk_keV_ns, {.min = 0.0, .max = 1e3});
  config.read("walk_pole_keV", sensor.walk_pole_keV, {.min = 0.0, .max = 50.0});
  config.read("noise_sigma_keV", sensor.noise_sigma_keV, {.min = 0.0, .max = 100.0});
  config.read("lost_keV", sensor.lost_keV, {.min = 0.0, .max = 50.0});
  config.read("lost_rel", sensor.lost_rel, {.min = 0.0, .max = 0.5});
  config.read("rel_sigma_662", sensor.rel_sigma_662, {.min = 1e-4, .max = 0.5});
}

void read_rules(Config& config, EventRules& rules) {
  config.read("cluster_window_ns", rules.cluster_window_ns, {.min = 1.0, .max = 1e5});
  config.read("fluorescence_min_keV", rules.fluorescence_min_keV, {.min = 0.0, .max = 1e3});
  config.read("fluorescence_max_keV", rules.fluorescence_max_keV, {.min = 0.0, .max = 1e3});
  config.read("fluorescence_radius_px", rules.fluorescence_radius_px, {.min = 0.0, .max = 100.0});
  config.read("pair_distance_min_px", rules.pair_distance_min_px, {.min = 1.0, .max = 256.0});
  config.read("constrain_to_line", rules.constrain_to_line);
}

void read_stream(Config& config, HitStreamConfig& stream) {
  config.read("reorder_us", stream.reorder_us, {.min = 500.0, .max = 1e6});
  config.read("silence_max_ms", stream.silence_max_ms, {.min = 1.0, .max = 60e3});
  config.read("jump_max_s", stream.jump_max_s, {.min = 0.1, .max = 3600.0});
  config.read("delay_max_ms", stream.delay_max_ms, {.min = 1.0, .max = 60e3});
  config.read("quiet_max_ms", stream.quiet_max_ms, {.min = 1.0, .max = 3600e3});
}

void read_hot_pixels(Config& config, HotPixelConfig& hot_pixels) {
  config.read("window_s", hot_pixels.window_s, {.min = 0.01, .max = 3600.0});
  config.read("times_around", hot_pixels.times_around, {.min = 2.0, .max = 1e6});
  config.read("hits_min", hot_pixels.hits_min, {.min = 16, .max = 60'000});
}

}  // namespace

DetectorReaderConfig read_detector_reader_config(Config& config) {
  DetectorReaderConfig reader;
  config.require("mission", reader.mission, Range{.min = 0});
  config.section("sensor", [&](Config& section) { read_sensor(section, reader.rules.sensor); });
  config.section("events", [&](Config& section) { read_rules(section, reader.rules); });
  config.section("stream", [&](Config& section) { read_stream(section, reader.stream); });
  config.section("hot_pixels", [&](Config& section) { read_hot_pixels(section, reader.hot_pixels); });
  config.read("calibration", reader.calibration);
  config.section("input", [&](Config& section) {
    section.read("bind_address", reader.input.bind_address);
    section.read("speed", reader.input.speed, {.min = 0.01, .max = 1000.0});
  });
  reader.rules.channels.clear();
  config.each("nuclides", [&](Config& section) {
    std::filesystem::path file;
    section.require("file", file);
    reader.rules.channels.push_back(load_config(file, read_nuclide_channel));
  });
  if (reader.rules.channels.empty()) throw config.error("nuclides", "must name at least one file of a nuclide");
  try {
    check(reader.rules);
  } catch (const std::invalid_argument& e) {
    throw config.error("nuclides", e.what());
  }
  return reader;
}

Calibration load_calibration(const DetectorReaderConfig& config) {
  return config.calibration.empty() ? Calibration::uniform() : Calibration::load(config.calibration);
}

}  // namespace comptonaut
