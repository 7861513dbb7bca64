// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "config/config.h"
#include "nodes/coordinator_config.h"
#include "nuclides.h"

namespace comptonaut {
namespace {

constexpr double kMargin_m = 10.0;
constexpr double kCell_m = 0.5;
constexpr double kCellsWanted = 1e5;

struct Grid {
  Area area;
  double cell_m = kCell_m;
};

Grid parsed_grid(const std::string& text) {
  const auto refuse = [&](const char* why) {
    return std::runtime_error(
        fmt::format("--grid {}: {}; must be x0:x1:y0:y1:cell in metres, such as 0:50:0:50:0.5", text, why));
  };
  std::array<double, 5> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ':')) throw refuse("not five numbers");
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc{} || !std::isfinite(numbers[i])) throw refuse("not five numbers");
    at = next;
  }
  if (at != end) throw refuse("not five numbers");
  const auto [x0, x1, y0, y1, cell_m] = numbers;
  if (x1 <= x0) throw refuse("x1 is not above x0");
  if (y1 <= y0) throw refuse("y1 is not above y0");
  if (cell_m < 0.01) throw refuse("a cell is 0.01 at least");
  return {.area = {x0, x1, y0, y1}, .cell_m = cell_m};
}

Grid grid_around(std::span<const MeasurementBatch> batches) {
  Grid grid{.area = {1e300, -1e300, 1e300, -1e300}};
  Area& area = grid.area;
  for (const MeasurementBatch& batch : batches) {
    if (batch.live_us <= 0) continue;
    area.x_min_m = std::min(area.x_min_m, std::floor(batch.p_WD.x() - kMargin_m));
    area.x_max_m = std::max(area.x_max_m, std::ceil(batch.p_WD.x() + kMargin_m));
    area.y_min_m = std::min(area.y_min_m, std::floor(batch.p_WD.y() - kMargin_m));
    area.y_max_m = std::max(area.y_max_m, std::ceil(batch.p_WD.y() + kMargin_m));
  }
  if (area.x_max_m < area.x_min_m)
    throw std::runtime_error("the recording has no viewpoint with live time: give --grid");
  const double area_m2 = (area.x_max_m - area.x_min_m) * (area.y_max_m - area.y_min_m);
  while (area_m2 / (grid.cell_m * grid.cell_m) > kCellsWanted) grid.cell_m *= 2.0;
  return grid;
}

/// An isotropic one, for nuclides that give no pairs.
ConeDensity no_cones() {
  const std::vector<ConeDensity::Node> nodes = {{.beta_rad = 0.0, .weights = {0, 0, 0, 0, 0, 0, 0, 1}}};
  return {nodes, nodes};
}

}  // namespace

Cells cells_of(const GridOptions& options, std::span<const MeasurementBatch> batches) {
  const Grid grid = options.grid.empty() ? grid_around(batches) : parsed_grid(options.grid);
  try {
    Cells cells = flat_cells(grid.area, grid.cell_m, options.ground_m);
    if (cells.size() > 0) return cells;
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("--grid {}: {}", options.grid, error.what()));
  }
  throw std::runtime_error(fmt::format("--grid {}: has no cell, must be larger than one", options.grid));
}

NuclideTables load_tables(const std::filesystem::path& config, const std::string& nuclide) {
  CoordinatorConfig coordinator = load_config(config, read_coordinator_config);
  const std::string name = nuclide.empty() ? coordinator.nuclide : nuclide;
  if (name != coordinator.nuclide) {
    const std::filesystem::path folder = coordinator.response_table.parent_path();
    coordinator.response_table = folder / (lower_case(name) + ".csv");
    coordinator.cone_density = folder / (lower_case(name) + "-cones.csv");
    if (!std::filesystem::exists(coordinator.response_table)) {
      throw std::runtime_error(fmt::format("--nuclide {}: has no response table {}; 'comptonaut response' makes one",
                                           name, coordinator.response_table.string()));
    }
    if (!std::filesystem::exists(coordinator.cone_density)) coordinator.cone_density.clear();
  }
  NuclideTables tables{.config = {.nuclide = name, .mlem = coordinator.mlem, .joint = coordinator.joint},
                       .response = ResponseTable::load(coordinator.response_table),
                       .cones = load_cone_density(coordinator).value_or(no_cones())};
  if (coordinator.cone_density.empty()) tables.config.joint.use_pairs = false;
  const auto fact = tables.response.facts().find("nuclide");
  if (fact != tables.response.facts().end() && fact->second != name) {
    throw std::runtime_error(
        fmt::format("--nuclide {}: {} is of {}", name, coordinator.response_table.string(), fact->second));
  }
  return tables;
}

}  // namespace comptonaut
