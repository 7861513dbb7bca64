// SPDX-License-Identifier: BSD-3-Clause
#include "flight/fence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/segment.h"

namespace comptonaut {
namespace {

using Point = Eigen::Vector2d;

constexpr double kHand_m = 0.1;
constexpr double kOnBorder_m = 1e-9;

/// Twice the area to the left of a -> b, of the triangle with p.
double side(const Point& a, const Point& b, const Point& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

Point nearest_on_border(const Polygon& polygon, const Point& p) {
  Point best = polygon.front();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point near = nearest_on(polygon[i], polygon[(i + 1) % polygon.size()], p);
    if ((near - p).squaredNorm() < (best - p).squaredNorm()) best = near;
  }
  return best;
}

/// Where a stretch meets the border, as shares of it in order, its own ends included: between two of them it is on one
/// side.
std::vector<double> meetings(const Polygon& polygon, const Point& from, const Point& to) {
  std::vector<double> shares = {0.0, 1.0};
  const Point along = to - from;
  const auto add = [&](double share) {
    if (share > 0.0 && share < 1.0) shares.push_back(share);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double left_a = side(from, to, a), left_b = side(from, to, b);
    if ((left_a > 0.0 && left_b > 0.0) || (left_a < 0.0 && left_b < 0.0)) continue;
    if (left_a != left_b) {
      const Point at = a + left_a / (left_a - left_b) * (b - a);
      add((at - from).dot(along) / along.squaredNorm());
    } else {  // along the edge
      add((a - from).dot(along) / along.squaredNorm());
      add((b - from).dot(along) / along.squaredNorm());
    }
  }
  std::ranges::sort(shares);
  return shares;
}

/// How far a point is on the wrong side of a polygon's border; 0 on the right one.
double wrong_m(const Polygon& polygon, bool inside_is_right, const Point& p) {
  const double border_m = (nearest_on_border(polygon, p) - p).norm();
  return border_m <= kOnBorder_m || contains(polygon, p) == inside_is_right ? 0.0 : border_m;
}

bool allows(const Polygon& polygon, bool inside_is_right, const Point& from, const Point& to) {
  const double before_m = wrong_m(polygon, inside_is_right, from), after_m = wrong_m(polygon, inside_is_right, to);
  if (after_m > 0.0 && after_m >= before_m) return false;
  const std::vector<double> shares = meetings(polygon, from, to);
  bool back = before_m == 0.0;
  for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
    const bool right = wrong_m(polygon, inside_is_right, from + 0.5 * (shares[i] + shares[i + 1]) * (to - from)) == 0.0;
    if (back && !right) return false;
    back = right;
  }
  return true;
}

bool allows(const Disc& disc, const Point& from, const Point& to) {
  const double before_m = (from - disc.p_W).norm();
  const double nearest_m = (nearest_on(from, to, disc.p_W) - disc.p_W).norm();
  if (before_m >= disc.radius_m) return nearest_m >= disc.radius_m;
  return nearest_m >= before_m - kOnBorder_m && (to - disc.p_W).norm() > before_m;
}

double outside_m(double low_m, double high_m, double z_m) { return std::max({0.0, low_m - z_m, z_m - high_m}); }

/// From the wrong side to a hand's breadth behind the border; less in a sharp corner.
Point moved_behind(const Polygon& polygon, bool inside_is_right, const Point& p) {
  const Point border = nearest_on_border(polygon, p);
  for (double hand_m = kHand_m; hand_m > kOnBorder_m; hand_m *= 0.5) {
    const Point behind = border + (border - p).normalized() * hand_m;
    if (wrong_m(polygon, inside_is_right, behind) == 0.0) return behind;
  }
  return border;
}

}  // namespace

Polygon polygon_of(const Area& area, double margin_m) {
  const double x0 = area.x_min_m - margin_m, x1 = area.x_max_m + margin_m;
  const double y0 = area.y_min_m - margin_m, y1 = area.y_max_m + margin_m;
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

bool is_simple(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  const auto meet = [&](const Point& a, const Point& b, const Point& c, const Point& d) {
    const bool apart = side(a, b, c) * side(a, b, d) > 0.0 || side(c, d, a) * side(c, d, b) > 0.0;
    const Point low = a.cwiseMin(b).cwiseMax(c.cwiseMin(d)), high = a.cwiseMax(b).cwiseMin(c.cwiseMax(d));
    const bool boxes_apart = (low.array() > high.array()).any();
    return !apart && !boxes_apart;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
    const bool turns_back = side(a, b, c) == 0.0 && (b - a).dot(c - b) <= 0.0;
    if (turns_back) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      const bool neighbours = i == 0 && j + 1 == n;
      if (!neighbours && meet(a, b, polygon[j], polygon[(j + 1) % n])) return false;
    }
  }
  return n >= 3;
}

// A ray to the east crosses the border an odd number of times.
bool contains(const Polygon& polygon, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((nearest_on(a, b, p) - p).norm() <= kOnBorder_m) return true;
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool Fence::within_border(const Eigen::Vector3d& p_W) const {
  return outside_m(floor_m, ceiling_m, p_W.z()) == 0.0 &&
         (border.empty() || wrong_m(border, true, p_W.head<2>()) == 0.0);
}

bool Fence::contains(const Eigen::Vector3d& p_W) const {
  const Point p = p_W.head<2>();
  return within_border(p_W) &&
         std::ranges::none_of(excluded, [&](const Polygon& area) { return wrong_m(area, false, p) > 0.0; }) &&
         std::ranges::none_of(keep_out, [&](const Disc& disc) { return (p - disc.p_W).norm() < disc.radius_m; });
}

bool Fence::allows(const Leg& leg) const {
  const Point from = leg.from_W.head<2>(), to = leg.to_W.head<2>();
  const double after_m = outside_m(floor_m, ceiling_m, leg.to_W.z());
  if (after_m > 0.0 && after_m >= outside_m(floor_m, ceiling_m, leg.from_W.z())) return false;
  if (!border.empty() && !comptonaut::allows(border, true, from, to)) return false;
  return std::ranges::all_of(excluded, [&](const Polygon& p) { return comptonaut::allows(p, false, from, to); }) &&
         std::ranges::all_of(keep_out, [&](const Disc& disc) { return comptonaut::allows(disc, from, to); });
}

Eigen::Vector3d Fence::nearest_allowed(const Eigen::Vector3d& p_W) const {
  Point p = p_W.head<2>();
  for (const Disc& disc : keep_out) {
    const Point away = p - disc.p_W;
    if (away.norm() >= disc.radius_m) continue;
    const Point direction = away.norm() > kOnBorder_m ? Point(away.normalized()) : Point::UnitX();
    p = disc.p_W + (disc.radius_m + kHand_m) * direction;
  }
  for (const Polygon& area : excluded) {
    if (wrong_m(area, false, p) > 0.0) p = moved_behind(area, false, p);
  }
  return {p.x(), p.y(), p_W.z()};
}

}  // namespace comptonaut
