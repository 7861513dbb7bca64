// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "picture/picture.h"
#include "report/reconstruction_files.h"
#include "report/scores.h"

namespace comptonaut {
namespace {

constexpr std::size_t kLabelled = 12;  // sources with a label; more would cover the map
constexpr double kDecades = 1e-3;      // of the scale below its top
constexpr double kSourceShare = 0.1;   // weaker maxima of a map are noise beside the strongest

/// Columns and rows of the grid that the cells lie on.
struct Extent {
  std::int32_t x0 = std::numeric_limits<std::int32_t>::max(), x1 = std::numeric_limits<std::int32_t>::min();
  std::int32_t y0 = x0, y1 = x1;

  explicit Extent(const Cells& cells) {
    for (std::size_t j = 0; j < cells.size(); ++j) {
      const VoxelKey key = cells.key(j);
      x0 = std::min(x0, key.x), x1 = std::max(x1, key.x);
      y0 = std::min(y0, key.y), y1 = std::max(y1, key.y);
    }
  }
  [[nodiscard]] int columns() const { return x1 - x0 + 1; }
  [[nodiscard]] int rows() const { return y1 - y0 + 1; }
};

Outline outline_of(const SourceEstimate& source, const PositionEllipse& ellipse) {
  constexpr int kPoints = 72;
  Outline outline;
  const double c = std::cos(ellipse.direction_rad), s = std::sin(ellipse.direction_rad);
  for (int i = 0; i < kPoints; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kPoints;
    const double along_m = ellipse.major_m * std::cos(angle_rad), across_m = ellipse.minor_m * std::sin(angle_rad);
    outline.x.push_back(source.p_W.x() + c * along_m - s * across_m);
    outline.y.push_back(source.p_W.y() + s * along_m + c * across_m);
  }
  return outline;
}

std::string label_of(const SourceEstimate& source) {
  const ActivityInterval interval = interval_95(source);
  const std::string activity = activity_text(source.activity_Bq);
  if (!std::isfinite(interval.high_Bq)) return activity;
  return fmt::format("{} ± {:.0f} %", activity, 50.0 * (interval.high_Bq - interval.low_Bq) / source.activity_Bq);
}

/// All sources of an estimator that tells sources; of a map its higher maxima.
std::vector<SourceEstimate> marked_sources(const Reconstruction& result) {
  std::vector<SourceEstimate> sources = result.sources;
  if (result.estimator == "joint" || sources.empty()) return sources;
  double most_Bq = 0.0;
  for (const SourceEstimate& source : sources) most_Bq = std::max(most_Bq, source.activity_Bq);
  std::erase_if(sources, [&](const SourceEstimate& source) { return source.activity_Bq < kSourceShare * most_Bq; });
  return sources;
}

std::string title_of(const Reconstruction& result) {
  if (result.estimator != "joint")
    return fmt::format("{}: map of pairs (MLEM) and its strongest maxima", result.nuclide);
  const std::size_t n = result.sources.size();
  return fmt::format("{}: {} {} with 95 % ellipses, on the map of pairs", result.nuclide, n,
                     n == 1 ? "source" : "sources");
}

Axis scale_of(const std::vector<double>& lambda_Bq) {
  const double highest_Bq = lambda_Bq.empty() ? 0.0 : *std::max_element(lambda_Bq.begin(), lambda_Bq.end());
  const double top_Bq = highest_Bq > 0.0 ? highest_Bq : 1.0;
  return {.label = "activity of a cell, Bq", .min = kDecades * top_Bq, .max = top_Bq, .logarithmic = true};
}

}  // namespace

void write_map_picture(const std::filesystem::path& file, const Cells& cells, const Reconstruction& result) {
  const Extent extent(cells);
  const double cell_m = cells.cell_m();
  HeatMap map;
  map.title = title_of(result);
  map.x = {.label = "x (east), m", .min = extent.x0 * cell_m, .max = (extent.x1 + 1) * cell_m};
  map.y = {.label = "y (north), m", .min = extent.y0 * cell_m, .max = (extent.y1 + 1) * cell_m};
  map.columns = extent.columns();
  map.rows = extent.rows();
  map.values.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows),
                    std::numeric_limits<double>::quiet_NaN());
  map.scale = scale_of(result.lambda_Bq);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const VoxelKey key = cells.key(j);
    const auto at = static_cast<std::size_t>(key.y - extent.y0) * static_cast<std::size_t>(map.columns) +
                    static_cast<std::size_t>(key.x - extent.x0);
    map.values[at] = std::max(result.lambda_Bq[j], map.scale.min);
  }
  for (const SourceEstimate& source : marked_sources(result)) {
    const PositionEllipse ellipse = ellipse_95(source);
    if (std::isfinite(ellipse.major_m)) map.outlines.push_back(outline_of(source, ellipse));
    map.marks.push_back({.x = source.p_W.x(), .y = source.p_W.y(), .label = label_of(source)});
  }
  write_picture(file, {map});
}

}  // namespace comptonaut
