// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "search/strategy.h"
#include "world/world.h"

namespace comptonaut {

/// A field with MAVs that fly their courses exactly and fast, one tick a second.
struct Field {
  explicit Field(const Area& area, double cell_m = 1.0)
      : cells(flat_cells(area, cell_m)), lambda_Bq(cells.size(), 0.0), sensitivity_s(cells.size(), 0.0) {}

  void add_mav(std::int32_t mav, double x_m, double y_m) {
    mavs.push_back({.mav = mav, .p_W = {x_m, y_m, 2.0}, .track_W = {{x_m, y_m, 2.0}}});
  }

  [[nodiscard]] SearchState state() const {
    return {.cells = cells,
            .world = world,
            .lambda_Bq = lambda_Bq,
            .sensitivity_s = sensitivity_s,
            .mavs = mavs,
            .utime = utime};
  }

  /// One second of flight at `speed_m_s`, in steps of 0.05 s; each step adds what a detector would see.
  void fly(const std::vector<Course>& courses, double speed_m_s, bool see = true) {
    utime += kSecond_us;
    for (std::size_t i = 0; i < mavs.size(); ++i) {
      Searcher& mav = mavs[i];
      mav.track_W = {mav.p_W};
      mav.v_W.setZero();
      std::size_t next = 0;
      for (int step = 0; step < 20; ++step) {
        double left_m = 0.05 * speed_m_s;
        while (next < courses[i].points_W.size() && left_m > 0.0) {
          const Eigen::Vector3d to_W = courses[i].points_W[next] - mav.p_W;
          const double go_m = std::min(left_m, to_W.norm());
          if (to_W.norm() > 0.0) {
            mav.p_W += to_W.normalized() * go_m;
            mav.v_W = to_W.normalized() * speed_m_s;
          }
          left_m -= go_m;
          if (go_m >= to_W.norm()) ++next;
        }
        mav.track_W.push_back(mav.p_W);
        if (see) look(mav.p_W);
      }
    }
  }

  void look(const Eigen::Vector3d& p_W) {
    for (std::size_t j = 0; j < cells.size(); ++j) {
      sensitivity_s[j] += 0.05 * 3e-8 / (cells.p_W(j) - p_W).squaredNorm();
    }
  }

  Cells cells;
  World world = World::flat();
  std::vector<double> lambda_Bq, sensitivity_s;
  std::vector<Searcher> mavs;
  Utime utime = 1'700'000'000'000'000;
};

}  // namespace comptonaut
