// SPDX-License-Identifier: BSD-3-Clause
#include "picture/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "picture/frame.h"

namespace comptonaut {
namespace {

void check(const Axis& axis) {
  const bool right = std::isfinite(axis.min) && std::isfinite(axis.max) && axis.max > axis.min &&
                     (!axis.logarithmic || axis.min > 0.0);
  if (right) return;
  throw std::invalid_argument(fmt::format("axis '{}' from {} to {}: must go upwards{}", axis.label, axis.min, axis.max,
                                          axis.logarithmic ? " from above 0" : ""));
}

void check(const Chart& chart) {
  check(chart.x);
  check(chart.y);
  for (const Curve& curve : chart.curves) {
    if (curve.x.size() == curve.y.size()) continue;
    throw std::invalid_argument(
        fmt::format("curve '{}' has {} x and {} y: must be as many", curve.name, curve.x.size(), curve.y.size()));
  }
}

void check(const HeatMap& map) {
  for (const Axis& axis : {map.x, map.y, map.scale}) check(axis);
  if (map.columns > 0 && map.rows > 0 &&
      map.values.size() == static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows)) {
    return;
  }
  throw std::invalid_argument(fmt::format("map '{}' has {} values for {} columns and {} rows: must be one per cell",
                                          map.title, map.values.size(), map.columns, map.rows));
}

}  // namespace

void require_picture(const std::filesystem::path& file) {
  if (file.empty() || file.extension() == ".png" || file.extension() == ".svg") return;
  throw std::runtime_error(fmt::format("{}: a picture's name must end in .png or .svg", file.string()));
}

void write_picture(const std::filesystem::path& file, const std::vector<Panel>& panels) {
  if (file.empty()) return;
  require_picture(file);
  Point size;
  for (const Panel& panel : panels) {
    std::visit([](const auto& p) { check(p); }, panel);
    const Point more = std::visit([](const auto& p) { return size_of(p); }, panel);
    size = {size.x + more.x, std::max(size.y, more.y)};
  }
  Canvas canvas(file, size.x, size.y);
  double left = 0.0;
  for (const Panel& panel : panels) {
    std::visit([&](const auto& p) { draw(canvas, {left, 0.0}, p); }, panel);
    left += std::visit([](const auto& p) { return size_of(p); }, panel).x;
  }
  canvas.finish();
}

}  // namespace comptonaut
