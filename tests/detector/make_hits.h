// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "detector/calibration.h"
#include "detector/hit.h"
#include "detector/row_faults.h"
#include "detector/sensor.h"
#include "detector/stream_item.h"

namespace comptonaut {

inline std::uint16_t pixel_at(int x, int y) { return static_cast<std::uint16_t>(kChipPixels * y + x); }

inline ChipTime chip_time_ns(double ns) { return std::llround(ns / kChipTime_ns); }

/// The same for each pixel.
inline const Calibration& typical_calibration() {
  static const Calibration calibration = Calibration::uniform();
  return calibration;
}

/// What one pixel reads of a deposit whose charge arrives at t_ns.
inline Hit make_hit(int x, int y, double energy_keV, double t_ns, const SensorConfig& sensor = SensorConfig{},
                    const Calibration& calibration = typical_calibration()) {
  return {.t = chip_time_ns(t_ns + time_walk_ns(sensor, energy_keV)),
          .pixel = pixel_at(x, y),
          .tot = calibration.tot(pixel_at(x, y), energy_keV)};
}

/// The same on one pixel after the other, all over the chip: none is hot.
inline Hit make_hit_anywhere(std::int64_t index, double energy_keV, double t_ns) {
  const auto pixel = static_cast<std::uint16_t>(40503 * index);
  return make_hit(pixel_x(pixel), pixel_y(pixel), energy_keV, t_ns);
}

inline std::string t3pa_row(std::int64_t index, const Hit& hit) {
  const std::int64_t toa = (hit.t + 15) / 16;
  const std::int64_t ftoa = 16 * toa - hit.t;
  return std::to_string(index) + "\t" + std::to_string(hit.pixel) + "\t" + std::to_string(toa) + "\t" +
         std::to_string(hit.tot) + "\t" + std::to_string(ftoa) + "\t0\n";
}

inline const std::string kT3paHeader = "Index\tMatrix Index\tToA\tToT\tFToA\tOverflow\n";

inline std::string t3pa_text(const std::vector<Hit>& hits) {
  std::string text = kT3paHeader;
  for (std::size_t i = 0; i < hits.size(); ++i) text += t3pa_row(static_cast<std::int64_t>(i), hits[i]);
  return text;
}

/// A record of .t3p.
inline std::string t3p_record(std::uint64_t pixel, std::uint64_t toa, unsigned overflow, unsigned ftoa, unsigned tot) {
  std::string record;
  const auto add = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) record += static_cast<char>(value >> (8 * i) & 0xff);
  };
  add(pixel, 4);
  add(toa, 8);
  add(overflow, 1);
  add(ftoa, 1);
  add(tot, 2);
  return record;
}

inline std::string t3p_data(const std::vector<Hit>& hits) {
  std::string data;
  for (const Hit& hit : hits) {
    const auto toa = static_cast<std::uint64_t>((hit.t + 15) / 16);
    data += t3p_record(hit.pixel, toa, 0, static_cast<unsigned>(16 * toa - static_cast<std::uint64_t>(hit.t)), hit.tot);
  }
  return data;
}

/// As a cluster log, a frame and a cluster a hit, with the energies that the calibration gives them.
inline std::string clog_text(const std::vector<Hit>& hits, const Calibration& calibration = typical_calibration()) {
  std::string text;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Hit& hit = hits[i];
    text += "Frame " + std::to_string(i + 1) + " (" + std::to_string(static_cast<double>(hit.t) * kChipTime_ns) +
            ", 0.000000 s)\n[" + std::to_string(pixel_x(hit.pixel)) + ", " + std::to_string(pixel_y(hit.pixel)) + ", " +
            std::to_string(calibration.energy_keV(hit.pixel, hit.tot).value()) + ", 0]\n";
  }
  return text;
}

/// All that a parser finds in the data as a whole.
template <class Parser>
std::vector<StreamItem> parse_all(const std::string& bytes, RowFaults* faults = nullptr) {
  Parser parser;
  const auto parsed = parser.parse(bytes);
  std::vector<StreamItem> items(parsed.begin(), parsed.end());
  const auto rest = parser.end();
  items.insert(items.end(), rest.begin(), rest.end());
  if (faults) *faults = parser.faults();
  return items;
}

/// How many of them are of a kind.
inline std::int64_t count_of(StreamItem::Kind kind, std::span<const StreamItem> items) {
  return std::count_if(items.begin(), items.end(), [&](const StreamItem& item) { return item.kind == kind; });
}

}  // namespace comptonaut
