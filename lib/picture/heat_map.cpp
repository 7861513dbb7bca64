// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "picture/frame.h"
#include "picture/ticks.h"

namespace comptonaut {
namespace {

constexpr double kLongest = 512.0;  // of the box's edges
constexpr double kBarGap = 24.0, kBarWidth = 18.0, kBarRoom = 132.0;
constexpr int kBarSteps = 256;

std::uint32_t argb(Colour c) {
  const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255.0 * value)); };
  return 0xff000000u | byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

Point box_size(const HeatMap& map) {
  const double width = map.x.max - map.x.min, height = map.y.max - map.y.min;
  const double px_per_unit = kLongest / std::max(width, height);
  return {px_per_unit * width, px_per_unit * height};
}

/// First the top row.
std::vector<std::uint32_t> cell_colours(const HeatMap& map) {
  std::vector<std::uint32_t> cells;
  cells.reserve(map.values.size());
  for (int row = map.rows - 1; row >= 0; --row) {
    for (int column = 0; column < map.columns; ++column) {
      const double value = map.values[static_cast<std::size_t>(row * map.columns + column)];
      const bool blank = std::isnan(value) || (map.scale.logarithmic && value <= 0.0);
      cells.push_back(blank ? 0 : argb(scale_colour(share(map.scale, value))));
    }
  }
  return cells;
}

void draw_bar(Canvas& canvas, const Box& map_box, const Axis& scale) {
  const Box bar{map_box.right() + kBarGap, map_box.top, kBarWidth, map_box.height};
  std::vector<std::uint32_t> colours;
  for (int i = 0; i < kBarSteps; ++i) colours.push_back(argb(scale_colour(1.0 - (i + 0.5) / kBarSteps)));
  canvas.image(bar, 1, kBarSteps, colours);
  for (const Tick& tick : ticks(scale, std::max(2, static_cast<int>(bar.height / 60.0)))) {
    const double y = bar.bottom() - bar.height * share(scale, tick.value);
    canvas.line({bar.right(), y}, {bar.right() + 4.0, y}, kAxisPen);
    canvas.text({bar.right() + 8.0, y}, tick.label, {.size = 11.0, .anchor = 0.0});
  }
  canvas.text({bar.right() + 58.0, bar.top + 0.5 * bar.height}, scale.label, {.size = 12.5, .upwards = true});
}

/// Drawn one over the other: to be seen on any colour.
constexpr Pen kRim = {.colour = {1, 1, 1}, .width = 4.0}, kMark = {.colour = {0, 0.45, 0.7}, .width = 2.0};

void draw_outline(Canvas& canvas, const Frame& frame, const Outline& outline) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < outline.x.size(); ++i) points.push_back(frame.at(outline.x[i], outline.y[i]));
  if (points.empty()) return;
  points.push_back(points.front());
  for (const Pen& pen : {kRim, kMark}) canvas.polyline(points, pen, frame.box);
}

constexpr double kArm = 6.0;  // of a cross

void draw_cross(Canvas& canvas, Point p) {
  for (const Pen& pen : {kRim, kMark}) {
    canvas.line({p.x - kArm, p.y}, {p.x + kArm, p.y}, pen);
    canvas.line({p.x, p.y - kArm}, {p.x, p.y + kArm}, pen);
  }
}

bool apart(const Box& a, const Box& b) {
  return a.right() <= b.left || b.right() <= a.left || a.bottom() <= b.top || b.bottom() <= a.top;
}

/// Beside each mark, at the first of four corners where the label lies on no other one, on no cross, and inside of the
/// map. Those that have no such place are left out.
void draw_labels(Canvas& canvas, const Frame& frame, const std::vector<Mark>& marks) {
  constexpr double kSize = 11.5, kTextHeight = 15.0, kAside = 9.0;
  std::vector<Box> taken;
  for (const Mark& mark : marks) {
    const Point p = frame.at(mark.x, mark.y);
    taken.push_back({p.x - kArm, p.y - kArm, 2.0 * kArm, 2.0 * kArm});
  }
  for (const Mark& mark : marks) {
    if (mark.label.empty()) continue;
    const Point p = frame.at(mark.x, mark.y);
    const double width = canvas.text_width(mark.label, kSize);
    for (const Point side : {Point{1, -1}, Point{1, 1}, Point{-1, -1}, Point{-1, 1}}) {
      const double left = side.x > 0 ? p.x + kAside : p.x - kAside - width, middle = p.y + side.y * kAside;
      const Box box{left, middle - 0.5 * kTextHeight, width, kTextHeight};
      const bool inside = box.left >= frame.box.left && box.right() <= frame.box.right() && box.top >= frame.box.top &&
                          box.bottom() <= frame.box.bottom();
      if (!inside || !std::all_of(taken.begin(), taken.end(), [&](const Box& b) { return apart(box, b); })) continue;
      canvas.text({left, middle}, mark.label, {.size = kSize, .anchor = 0.0, .haloed = true});
      taken.push_back(box);
      break;
    }
  }
}

}  // namespace

Point size_of(const HeatMap& map) {
  const Point box = box_size(map);
  return {kFrameLeft + box.x + kBarRoom, kFrameTop + box.y + kFrameBottom};
}

void draw(Canvas& canvas, Point corner, const HeatMap& map) {
  const Point size = box_size(map);
  const Frame frame{{corner.x + kFrameLeft, corner.y + kFrameTop, size.x, size.y}, map.x, map.y};
  canvas.image(frame.box, map.columns, map.rows, cell_colours(map));
  draw_axes(canvas, frame, false);
  draw_bar(canvas, frame.box, map.scale);
  for (const Outline& outline : map.outlines) draw_outline(canvas, frame, outline);
  for (const Mark& mark : map.marks) draw_cross(canvas, frame.at(mark.x, mark.y));
  draw_labels(canvas, frame, map.marks);
  draw_title(canvas, frame.box, kFrameTop - 22.0, map.title);
}

}  // namespace comptonaut
