// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/cells.h"
#include "radiation/reconstruction.h"

namespace comptonaut {

/// Where sources may lie, as people give it: flat ground in square cells.
struct GridOptions {
  std::string grid;       ///< x0:x1:y0:y1:cell, m; empty: around the viewpoints
  double ground_m = 0.0;  ///< height of the ground in W
};

/// Without a grid: the rectangle around all viewpoints of some live time and 10 m more to each side, cells of 0.5 m, or
/// larger ones where that were more than 10^5. Throws std::runtime_error that says what is wrong with --grid.
[[nodiscard]] Cells cells_of(const GridOptions& options, std::span<const MeasurementBatch> batches);

/// What is known of a nuclide's events.
struct NuclideTables {
  ReconstructionConfig config;
  ResponseTable response;
  ConeDensity cones;
};

/// The configuration is a coordinator's: nuclide, tables, what `joint` and `mlem` are set to. Another nuclide's tables
/// stand beside those of the configured one: response/co-60.csv, response/co-60-cones.csv. A nuclide without cones is
/// one of singles alone. Throws std::runtime_error that names file or nuclide.
[[nodiscard]] NuclideTables load_tables(const std::filesystem::path& config, const std::string& nuclide);

}  // namespace comptonaut
