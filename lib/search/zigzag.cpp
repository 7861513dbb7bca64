// SPDX-License-Identifier: BSD-3-Clause
#include "search/zigzag.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

/// Height of the highest surface of each column of cells.
class Heights {
 public:
  explicit Heights(const Cells& cells) : cell_m_(cells.cell_m()) {
    for (std::size_t j = 0; j < cells.size(); ++j) {
      const auto [it, is_new] = z_m_.try_emplace({cells.key(j).x, cells.key(j).y}, cells.p_W(j).z());
      it->second = std::max(it->second, cells.p_W(j).z());
    }
  }

  /// Where there is no column: as high as the highest, which is safe.
  [[nodiscard]] double at(const Eigen::Vector2d& p) const {
    const auto it = z_m_.find({static_cast<std::int32_t>(std::floor(p.x() / cell_m_)),
                               static_cast<std::int32_t>(std::floor(p.y() / cell_m_))});
    if (it != z_m_.end()) return it->second;
    const auto by_height = [](const auto& a, const auto& b) { return a.second < b.second; };
    return std::max_element(z_m_.begin(), z_m_.end(), by_height)->second;
  }

 private:
  double cell_m_;
  std::map<std::pair<std::int32_t, std::int32_t>, double> z_m_;
};

/// The corners at set height, with a point before and after each step of the ground between them.
std::vector<Eigen::Vector3d> over_ground(const std::vector<Eigen::Vector2d>& corners, const Heights& heights,
                                         double set_height_m, double step_m) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i > 0 ? i - 1 : 0];
    const int steps = std::max(1, static_cast<int>((corners[i] - from).norm() / step_m));
    for (int k = 1; k < steps; ++k) {
      const Eigen::Vector2d here = from + (corners[i] - from) * k / steps;
      const Eigen::Vector2d next = from + (corners[i] - from) * (k + 1) / steps;
      const double z_m = heights.at(here);
      if (z_m == points.back().z() - set_height_m && z_m == heights.at(next)) continue;
      points.emplace_back(here.x(), here.y(), z_m + set_height_m);
    }
    points.emplace_back(corners[i].x(), corners[i].y(), heights.at(corners[i]) + set_height_m);
  }
  return points;
}

/// The sweep of a strip that begins nearest to p, of those that begin at its four corners.
std::vector<Eigen::Vector2d> sweep_from(const Eigen::Vector2d& p, const Area& strip, double lane_m, bool along_x) {
  const std::vector<Eigen::Vector2d> lanes = lane_corners(strip, lane_m, along_x);
  const Eigen::Vector2d twice_centre(strip.x_min_m + strip.x_max_m, strip.y_min_m + strip.y_max_m);
  std::vector<Eigen::Vector2d> best = lanes;
  for (int mirrored = 1; mirrored < 4; ++mirrored) {
    std::vector<Eigen::Vector2d> sweep = lanes;
    for (Eigen::Vector2d& corner : sweep) {
      if ((mirrored & 1) != 0) corner.x() = twice_centre.x() - corner.x();
      if ((mirrored & 2) != 0) corner.y() = twice_centre.y() - corner.y();
    }
    if ((sweep.front() - p).norm() < (best.front() - p).norm()) best = sweep;
  }
  return best;
}

/// Strip `i` of `n`, side by side across the lanes.
Area strip_of(const Area& area, std::size_t i, std::size_t n, bool lanes_along_x) {
  const double begin = static_cast<double>(i) / static_cast<double>(n);
  const double end = static_cast<double>(i + 1) / static_cast<double>(n);
  Area strip = area;
  double& min_m = lanes_along_x ? strip.y_min_m : strip.x_min_m;
  double& max_m = lanes_along_x ? strip.y_max_m : strip.x_max_m;
  const double low_m = min_m, width_m = max_m - min_m;
  min_m = low_m + begin * width_m;
  max_m = low_m + end * width_m;
  return strip;
}

}  // namespace

std::vector<Eigen::Vector2d> lane_corners(const Area& strip, double lane_m, bool lanes_along_x) {
  const double low_m = lanes_along_x ? strip.y_min_m : strip.x_min_m;
  const double width_m = (lanes_along_x ? strip.y_max_m : strip.x_max_m) - low_m;
  const double from_m = lanes_along_x ? strip.x_min_m : strip.y_min_m;
  const double to_m = lanes_along_x ? strip.x_max_m : strip.y_max_m;
  // 16.7 m in lanes of 16.7 / 8 m would still be one lane more: forgive rounding.
  const int lanes = std::max(1, static_cast<int>(std::ceil(width_m / lane_m - 1e-9)));
  const double spacing_m = width_m / lanes;
  const double inset_m = std::min(0.5 * spacing_m, 0.5 * (to_m - from_m));
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < lanes; ++k) {
    const double across_m = low_m + (k + 0.5) * spacing_m;
    const double ends_m[2] = {from_m + inset_m, to_m - inset_m};
    for (const double along_m : {ends_m[k % 2], ends_m[1 - k % 2]}) {
      corners.emplace_back(lanes_along_x ? along_m : across_m, lanes_along_x ? across_m : along_m);
    }
  }
  return corners;
}

Zigzag::Zigzag(const SearchConfig& config) : config_(config) {
  config_.route_tries = 1;  // lanes have their order: a MAV in whose way another one is waits
}

std::vector<Course> Zigzag::plan(const SearchState& state) {
  const bool same_team =
      state.mavs.size() == sweeps_.size() &&
      std::all_of(state.mavs.begin(), state.mavs.end(), [&](const Searcher& mav) { return sweeps_.contains(mav.mav); });
  if (!same_team) make_lists(state);
  for (const Searcher& mav : state.mavs) {
    take_reached(targets_[mav.mav], mav.track_W, config_.reach_m);
    if (!targets_[mav.mav].empty()) continue;
    std::reverse(sweeps_[mav.mav].begin(), sweeps_[mav.mav].end());
    targets_[mav.mav] = sweeps_[mav.mav];
  }
  return make_courses(state, config_, targets_);
}

void Zigzag::make_lists(const SearchState& state) {
  sweeps_.clear();
  targets_.clear();
  const Area area = bounding_area(state.cells);
  const bool along_x = area.x_max_m - area.x_min_m > area.y_max_m - area.y_min_m;
  // Strips go to the MAVs in the order in which these stand, so that nobody crosses another's strip.
  std::vector<Searcher> mavs(state.mavs.begin(), state.mavs.end());
  std::stable_sort(mavs.begin(), mavs.end(), [along_x](const Searcher& a, const Searcher& b) {
    return along_x ? a.p_W.y() < b.p_W.y() : a.p_W.x() < b.p_W.x();
  });
  const Heights heights(state.cells);
  for (std::size_t i = 0; i < mavs.size(); ++i) {
    const Area strip = strip_of(area, i, mavs.size(), along_x);
    const auto sweep = sweep_from(mavs[i].p_W.head<2>(), strip, config_.zigzag.lane_m, along_x);
    sweeps_[mavs[i].mav] = over_ground(sweep, heights, config_.set_height_m, state.cells.cell_m());
    targets_[mavs[i].mav] = sweeps_[mavs[i].mav];
  }
}

}  // namespace comptonaut
