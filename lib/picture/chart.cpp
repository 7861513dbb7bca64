// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "picture/frame.h"

namespace comptonaut {
namespace {

constexpr double kWidth = 560.0, kHeight = 320.0;  // of the box
constexpr double kGuideRoom = 84.0;                // above it, for the guides' labels
constexpr double kGuideText = 10.5;
constexpr double kLeader = 14.0;  // from the box to a guide's label, which may stand aside

double guide_room(const Chart& chart) { return chart.guides.empty() ? 0.0 : kGuideRoom; }

/// Points of a histogram's outline, from the axis up and back to it.
std::vector<Point> step_points(const Frame& frame, const Curve& curve) {
  std::vector<Point> points;
  const double floor = frame.box.bottom() + 2.0;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const Point p = frame.at(curve.x[i], curve.y[i]);
    points.push_back({p.x, points.empty() ? floor : points.back().y});
    points.push_back({p.x, std::min(p.y, floor)});
  }
  return points;
}

void draw_curve(Canvas& canvas, const Frame& frame, const Curve& curve, Colour colour) {
  const Pen pen{.colour = colour, .width = 1.5};
  if (curve.style == Curve::Style::kSteps) return canvas.polyline(step_points(frame, curve), pen, frame.box);
  std::vector<Point> points;
  for (std::size_t i = 0; i < curve.x.size(); ++i) points.push_back(frame.at(curve.x[i], curve.y[i]));
  if (curve.style == Curve::Style::kLine) return canvas.polyline(points, pen, frame.box);
  for (const Point& p : points) canvas.disc(p, 4.0, colour);
}

void draw_legend(Canvas& canvas, const Frame& frame, const Chart& chart) {
  const std::vector<Curve>& curves = chart.curves;
  double widest = 0.0;
  for (const Curve& curve : curves) widest = std::max(widest, canvas.text_width(curve.name, 12.0));
  const double left = chart.legend_left ? frame.box.left + 14.0 : frame.box.right() - widest - 38.0;
  double y = frame.box.top + 16.0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (curves[i].name.empty()) continue;
    canvas.fill({left - 4.0, y - 9.0, widest + 38.0, 18.0}, {1, 1, 1});
    if (curves[i].style == Curve::Style::kDots) {
      canvas.disc({left + 10.0, y}, 4.0, category_colour(i));
    } else {
      canvas.line({left, y}, {left + 20.0, y}, {.colour = category_colour(i), .width = 2.0});
    }
    canvas.text({left + 26.0, y}, curves[i].name, {.size = 12.0, .anchor = 0.0});
    y += 18.0;
  }
}

/// Places of labels that want to be at `wanted` (ascending), `apart` px from each other: neighbours that are too close
/// are spread around their common middle.
std::vector<double> spread(const std::vector<double>& wanted, double apart) {
  struct Group {
    double middle;
    std::size_t count;
    [[nodiscard]] double half(double each) const { return 0.5 * each * static_cast<double>(count); }
  };
  std::vector<Group> groups;
  for (const double x : wanted) {
    groups.push_back({x, 1});
    while (groups.size() > 1) {
      const Group last = groups.back(), before = groups[groups.size() - 2];
      if (last.middle - last.half(apart) >= before.middle + before.half(apart)) break;
      const double both = static_cast<double>(last.count + before.count);
      const double middle =
          (last.middle * static_cast<double>(last.count) + before.middle * static_cast<double>(before.count)) / both;
      groups.pop_back();
      groups.back() = {middle, last.count + before.count};
    }
  }
  std::vector<double> places;
  for (const Group& group : groups) {
    for (std::size_t i = 0; i < group.count; ++i) {
      places.push_back(group.middle - group.half(apart) + (static_cast<double>(i) + 0.5) * apart);
    }
  }
  return places;
}

void draw_guides(Canvas& canvas, const Frame& frame, std::vector<Guide> guides) {
  std::sort(guides.begin(), guides.end(), [](const Guide& a, const Guide& b) { return a.x < b.x; });
  std::vector<double> wanted;
  for (const Guide& guide : guides) wanted.push_back(frame.at(guide.x, frame.y.min).x);
  const std::vector<double> places = spread(wanted, kGuideText + 2.5);
  const Pen pen{.colour = {0.45, 0.45, 0.45}, .width = 0.8, .dashed = true};
  const Pen leader{.colour = {0.45, 0.45, 0.45}, .width = 0.8};
  const double top = frame.box.top;
  for (std::size_t i = 0; i < guides.size(); ++i) {
    canvas.line({wanted[i], frame.box.bottom()}, {wanted[i], top}, pen);
    canvas.line({wanted[i], top}, {places[i], top - kLeader}, leader);
    canvas.text({places[i], top - kLeader - 3.0}, guides[i].label,
                {.size = kGuideText, .anchor = 0.0, .upwards = true});
  }
}

}  // namespace

Point size_of(const Chart& chart) {
  return {kFrameLeft + kWidth + kFrameRight, kFrameTop + guide_room(chart) + kHeight + kFrameBottom};
}

void draw(Canvas& canvas, Point corner, const Chart& chart) {
  const double top = kFrameTop + guide_room(chart);
  const Frame frame{{corner.x + kFrameLeft, corner.y + top, kWidth, kHeight}, chart.x, chart.y};
  draw_axes(canvas, frame, true);
  draw_guides(canvas, frame, chart.guides);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) draw_curve(canvas, frame, chart.curves[i], category_colour(i));
  draw_legend(canvas, frame, chart);
  draw_title(canvas, frame.box, top - 22.0, chart.title);
}

}  // namespace comptonaut
