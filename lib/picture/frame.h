// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "picture/canvas.h"
#include "picture/picture.h"

namespace comptonaut {

/// The place of a diagram in the picture and what its axes show.
struct Frame {
  Box box;
  Axis x, y;

  [[nodiscard]] Point at(double x_value, double y_value) const;
};

/// px that title, ticks and labels need around the box.
inline constexpr double kFrameLeft = 72.0, kFrameRight = 24.0, kFrameTop = 44.0, kFrameBottom = 56.0;

inline constexpr Pen kAxisPen = {.colour = {0.35, 0.35, 0.35}};
inline constexpr Pen kGridPen = {.colour = {0.88, 0.88, 0.88}};

/// Grid lines where `grid`, then the box, its ticks, the axes' labels.
void draw_axes(Canvas& canvas, const Frame& frame, bool grid);
/// In the middle above the box, `above` px over its edge.
void draw_title(Canvas& canvas, const Box& box, double above, const std::string& title);

/// Size of a panel in px, and the panel at its upper left corner.
[[nodiscard]] Point size_of(const Chart& chart);
[[nodiscard]] Point size_of(const HeatMap& map);
void draw(Canvas& canvas, Point corner, const Chart& chart);
void draw(Canvas& canvas, Point corner, const HeatMap& map);

}  // namespace comptonaut
