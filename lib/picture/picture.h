// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace comptonaut {

/// What an axis (or a colour bar) shows. On a logarithmic one min must be positive; max > min.
struct Axis {
  std::string label;  ///< with the unit: "energy, keV"
  double min = 0.0;
  double max = 1.0;
  bool logarithmic = false;
};

/// A thing to compare with others of its chart, each in a colour of its own, in the order given.
struct Curve {
  enum class Style { kLine, kSteps, kDots };
  std::string name;  ///< in the legend; empty: not there
  std::vector<double> x;
  std::vector<double> y;  ///< as many; of steps, the value from each x to the next
  Style style = Style::kLine;
};

/// A thin line across the chart at x, its label above the chart; labels that are close are spread out.
struct Guide {
  double x = 0.0;
  std::string label;
};

struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<Guide> guides;
  bool legend_left = false;  ///< in the upper left corner instead of the right one
};

/// A place to point at: a cross with its label, which is left out where those of earlier marks leave it no room.
struct Mark {
  double x = 0.0;
  double y = 0.0;
  std::string label;
};

/// A closed line, such as the ellipse in which a place lies.
struct Outline {
  std::vector<double> x;
  std::vector<double> y;  ///< as many
};

/// Values on a grid, as colours, with a colour bar. One unit is as long in x as in y.
struct HeatMap {
  std::string title;
  Axis x, y;  ///< from edge to edge of the grid; linear
  int columns = 0;
  int rows = 0;
  std::vector<double> values;  ///< columns * rows, first the row at y.min; NaN, or on a logarithmic scale 0: no colour
  Axis scale;                  ///< values beyond it take the colour of its end
  std::vector<Mark> marks;
  std::vector<Outline> outlines;
};

using Panel = std::variant<Chart, HeatMap>;

/// Throws std::runtime_error that names the file unless its name ends in .png or .svg. An empty name is right.
void require_picture(const std::filesystem::path& file);

/// Panels side by side, as PNG or SVG by the name's ending; nothing where the name is empty. The same
/// first call of a process gives the same bytes. Throws std::runtime_error that names the file where it cannot be
/// written, std::invalid_argument where a panel's numbers contradict its sizes or an axis is empty.
void write_picture(const std::filesystem::path& file, const std::vector<Panel>& panels);

}  // namespace comptonaut
