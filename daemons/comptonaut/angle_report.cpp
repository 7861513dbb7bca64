// SPDX-License-Identifier: BSD-3-Clause
#include "angle_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"

namespace comptonaut {
namespace {

/// A diagram's place in the picture and what its axes show.
struct Frame {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  double x_min = 0.0, x_max = 1.0, y_min = 0.0, y_max = 1.0;

  [[nodiscard]] double x(double value) const { return left + width * (value - x_min) / (x_max - x_min); }
  [[nodiscard]] double y(double value) const {
    return top + height * (1.0 - (std::clamp(value, y_min, y_max) - y_min) / (y_max - y_min));
  }
};

std::string text(double x, double y, const std::string& what, const char* anchor = "middle") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", x, y, anchor, what);
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' {}/>\n", x1, y1, x2, y2, style);
}

constexpr const char* kGrid = "stroke='#ddd'";
constexpr const char* kGuide = "stroke='#999' stroke-dasharray='4 3'";

std::string density_diagram(const AngleReport& report) {
  const Frame frame{
      .left = 60, .top = 40, .width = 400, .height = 260, .x_min = -90, .x_max = 90, .y_min = -5, .y_max = 0};
  std::string svg = text(260, 25, fmt::format("{}: angular error of the cones, per degree", report.nuclide));
  for (int decade = -5; decade <= 0; ++decade) {
    svg += line(frame.left, frame.y(decade), frame.left + frame.width, frame.y(decade), kGrid);
    svg += text(frame.left - 6, frame.y(decade) + 4, fmt::format("1e{}", decade), "end");
  }
  for (int degrees = -90; degrees <= 90; degrees += 30) {
    svg += line(frame.x(degrees), frame.top, frame.x(degrees), frame.top + frame.height, kGrid);
    svg += text(frame.x(degrees), frame.top + frame.height + 16, fmt::format("{}", degrees));
  }
  std::string steps, curve;
  for (const AngleBin& bin : report.angles) {
    const double from = bin.from_rad / kDegree, to = bin.to_rad / kDegree;
    if (from < frame.x_min || to > frame.x_max) continue;
    const double measured = frame.y(std::log10(std::max(bin.measured_per_rad * kDegree, 1e-9)));
    const double model = frame.y(std::log10(std::max(bin.model_per_rad * kDegree, 1e-9)));
    steps += fmt::format("{:.1f},{:.1f} {:.1f},{:.1f} ", frame.x(from), measured, frame.x(to), measured);
    curve += fmt::format("{:.1f},{:.1f} ", frame.x(0.5 * (from + to)), model);
  }
  svg += fmt::format("<polyline points='{}' fill='none' stroke='#1f6fb4' stroke-width='1.5'/>\n", steps);
  svg += fmt::format("<polyline points='{}' fill='none' stroke='#d1580a' stroke-width='1.5'/>\n", curve);
  svg += text(260, frame.top + frame.height + 34, "delta = angle(source, axis) - beta, degrees");
  svg += "<text x='70' y='58' fill='#1f6fb4'>simulated</text><text x='70' y='74' fill='#d1580a'>density</text>\n";
  return svg;
}

std::string reliability_diagram(const AngleReport& report) {
  const Frame frame{.left = 540, .top = 40, .width = 260, .height = 260};
  std::string svg = text(670, 25, "Share of hypotheses that are true");
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double at = 0.1 * tenth;
    svg += line(frame.left, frame.y(at), frame.left + frame.width, frame.y(at), kGrid);
    svg += text(frame.left - 6, frame.y(at) + 4, fmt::format("{:.1f}", at), "end");
    svg += text(frame.x(at), frame.top + frame.height + 16, fmt::format("{:.1f}", at));
  }
  svg += line(frame.x(0), frame.y(0), frame.x(1), frame.y(1), kGuide);
  for (const ReliabilityBin& bin : report.probabilities) {
    if (!(bin.hypotheses > 0.0)) continue;
    const char* colour = bin.from < 1.0 ? "#1f6fb4" : "#d1580a";
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}'/>\n", frame.x(bin.stated), frame.y(bin.is_true),
                       colour);
  }
  svg += text(670, frame.top + frame.height + 34, "stated probability (orange: the only hypothesis kept)");
  return svg;
}

}  // namespace

std::string angle_csv(const AngleReport& report) {
  std::string csv = fmt::format("# command: {}\n# nuclide: {}\nquantity,from,to,samples,measured,stated\n",
                                report.command, report.nuclide);
  for (const AngleBin& bin : report.angles) {
    csv += fmt::format("delta_deg,{:.0f},{:.0f},{:.0f},{:.4g},{:.4g}\n", bin.from_rad / kDegree, bin.to_rad / kDegree,
                       bin.pairs, bin.measured_per_rad * kDegree, bin.model_per_rad * kDegree);
  }
  for (const ReliabilityBin& bin : report.probabilities) {
    csv += fmt::format("probability,{:.1f},{:.1f},{:.0f},{:.4f},{:.4f}\n", bin.from, bin.to, bin.hypotheses,
                       bin.is_true, bin.stated);
  }
  return csv;
}

std::string angle_svg(const AngleReport& report) {
  return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 830 350' font-family='sans-serif' font-size='12'>\n"
         "<rect width='830' height='350' fill='white'/>\n" +
         density_diagram(report) + reliability_diagram(report) + "</svg>\n";
}

}  // namespace comptonaut
