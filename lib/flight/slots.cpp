// SPDX-License-Identifier: BSD-3-Clause
#include "flight/slots.h"

#include <algorithm>
#include <cmath>

#include "flight/route.h"

namespace comptonaut {

Slots slots_of(const Trajectory& trajectory, double from_s, double slot_s, double acceleration_max_m_s2) {
  Slots slots{.legs = {}, .bulge_m = acceleration_max_m_s2 * slot_s * slot_s / 8.0, .box = {}};
  Eigen::Vector3d from_W = trajectory.sample(from_s).p_W;
  slots.box = {.min_W = from_W, .max_W = from_W};
  double t_s = from_s;
  do {
    t_s += slot_s;
    const Eigen::Vector3d to_W = trajectory.sample(t_s).p_W;
    slots.legs.push_back({.from_W = from_W, .to_W = to_W});
    slots.box.min_W = slots.box.min_W.cwiseMin(to_W);
    slots.box.max_W = slots.box.max_W.cwiseMax(to_W);
    from_W = to_W;
  } while (t_s < trajectory.duration_s());
  return slots;
}

bool keep_apart(const Envelope& separation, const Slots& a, const Slots& b) {
  // Two that are just far enough may come nearer by the allowance of kept_share, tick by tick.
  constexpr double kSpare_m = 0.02;
  const double more_m = a.bulge_m + b.bulge_m + kSpare_m;
  const Envelope wide{.radius_m = separation.radius_m + more_m, .half_height_m = separation.half_height_m + more_m};
  const Eigen::Vector3d reach =
      Eigen::Vector3d(wide.radius_m, wide.radius_m, wide.half_height_m).array() + kCollisionTolerance_m;
  if (!Box{.min_W = a.box.min_W - reach, .max_W = a.box.max_W + reach}.touches(b.box)) return true;
  const Eigen::Vector3d &a_W = a.legs.front().from_W, &b_W = b.legs.front().from_W;
  const double share = kept_share(wide, a_W, Leg{.from_W = b_W, .to_W = b_W});
  if (share <= 0.0) return true;
  const Envelope kept{.radius_m = share * wide.radius_m, .half_height_m = share * wide.half_height_m};
  const std::size_t n = std::max(a.legs.size(), b.legs.size()) + 1;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i > 0 ? i - 1 : 0; j <= i + 1; ++j) {
      if (sweep_meets(kept, a.leg(i), b.leg(j))) return false;
    }
  }
  return true;
}

}  // namespace comptonaut
