// SPDX-License-Identifier: BSD-3-Clause
#include "detect_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "detector/pair.h"

namespace comptonaut {
namespace {

/// Empty columns where the hypothesis is not physical.
std::string hypothesis(const ConeHypothesis& cone) {
  if (cone.probability <= 0.0) return ",,,,";
  return fmt::format("{:.4f},{:.6f},{:.6f},{:.6f},{:.6f}", cone.probability, std::acos(cone.cos_beta), cone.axis_D.x(),
                     cone.axis_D.y(), cone.axis_D.z());
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& path, const char* header) : path_(path) {
  if (path.empty()) return;
  file_ = std::fopen(path.c_str(), "w");
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
  fmt::print(file_, "{}\n", header);
}

CsvFile::~CsvFile() {
  if (file_) std::fclose(file_);
}

void CsvFile::add(const Cluster& c) {
  if (!file_) return;
  fmt::print(file_, "{:.3f},{:.3f},{:.3f},{},{},{:.3f}\n", time_ns(c), c.x_px, c.y_px, c.size_px, c.tot_sum,
             c.energy_keV);
}

void CsvFile::add(const SensorConfig& sensor, const DetectorEvent& pair) {
  if (!file_) return;
  const Cluster &c1 = pair.first, &c2 = pair.second;
  fmt::print(file_, "{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f},{},{}\n", time_ns(c1),
             between_ns(c1, c2), c1.x_px, c1.y_px, c1.energy_keV, c2.x_px, c2.y_px, c2.energy_keV,
             depth_difference_um(sensor, c1, c2), hypothesis(pair.hypotheses->a), hypothesis(pair.hypotheses->b));
}

void CsvFile::finish() {
  if (!file_) return;
  const bool failed = std::fflush(file_) != 0 || std::ferror(file_) != 0;
  if (failed) throw std::runtime_error(fmt::format("{}: could not be written to its end", path_.string()));
}

}  // namespace comptonaut
