// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "picture/colour.h"

namespace comptonaut {

/// px from the picture's upper left corner, y downwards.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

struct Box {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  [[nodiscard]] double right() const { return left + width; }
  [[nodiscard]] double bottom() const { return top + height; }
};

struct Pen {
  Colour colour;
  double width = 1.0;
  bool dashed = false;
};

struct TextStyle {
  double size = 12.0;
  double anchor = 0.5;   ///< share of the text that lies before the point: 0 starts, 1 ends there
  bool upwards = false;  ///< reads from below
  bool bold = false;
  bool haloed = false;  ///< on colours: with a white rim
  Colour colour = {0.13, 0.13, 0.13};
};

/// A white picture to draw on: the only user of cairo.
class Canvas {
 public:
  /// A PNG of two pixels per px, else an SVG. Throws std::runtime_error that names the file.
  Canvas(const std::filesystem::path& file, double width, double height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(const Box& box, Colour colour);
  void line(Point from, Point to, const Pen& pen);
  /// Nothing of the line is drawn outside of the box.
  void polyline(std::span<const Point> points, const Pen& pen, const Box& inside);
  void disc(Point centre, double radius, Colour colour);
  /// The point is in the middle of the text's height.
  void text(Point at, const std::string& what, const TextStyle& style);
  [[nodiscard]] double text_width(const std::string& what, double size);
  /// A grid of 0xAARRGGBB (alpha 0 or 255) over the whole box, first the top row.
  void image(const Box& box, int columns, int rows, std::span<const std::uint32_t> argb);

  /// Throws std::runtime_error that names the file where it cannot be written.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace comptonaut
