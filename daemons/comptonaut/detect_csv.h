// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>

#include "detector/events.h"

namespace comptonaut {

/// A text file that is written line by line; no file where the path is empty.
class CsvFile {
 public:
  /// Throws std::runtime_error that names the file where it cannot be written.
  CsvFile(const std::filesystem::path& path, const char* header);
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  void add(const Cluster& cluster);
  /// Of an event that is a pair.
  void add(const SensorConfig& sensor, const DetectorEvent& pair);
  /// Throws std::runtime_error where not everything could be written.
  void finish();

 private:
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
};

inline constexpr const char* kClusterColumns = "t_ns,x_px,y_px,size_px,tot_sum,energy_keV";
inline constexpr const char* kPairColumns =
    "t_ns,dt_ns,x1_px,y1_px,e1_keV,x2_px,y2_px,e2_keV,dz_um,"
    "p_a,beta_a_rad,axis_a_x,axis_a_y,axis_a_z,p_b,beta_b_rad,axis_b_x,axis_b_y,axis_b_z";

}  // namespace comptonaut
