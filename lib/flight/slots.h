// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "flight/envelope.h"
#include "flight/trajectory.h"

namespace comptonaut {

/// A flight in slots of time, all of the same length: within each it is nearer than bulge_m to the slot's straight leg.
/// After the last one the MAV stays where that ends.
struct Slots {
  std::vector<Leg> legs;  ///< one at least
  double bulge_m = 0.0;
  Box box;  ///< about all legs

  [[nodiscard]] Leg leg(std::size_t i) const {
    return i < legs.size() ? legs[i] : Leg{.from_W = legs.back().to_W, .to_W = legs.back().to_W};
  }
};

/// The trajectory from from_s on until it rests. At most a slot^2 / 8 off a chord: that is how far a flight of bounded
/// acceleration can bulge.
[[nodiscard]] Slots slots_of(const Trajectory& trajectory, double from_s, double slot_s, double acceleration_max_m_s2);

/// Whether two flights keep the separation from each other at all times, also where one is a slot early or late: in
/// each slot the separation's ellipsoid, swept along one leg, misses the legs of the same slot, the one before and the
/// one after of the other. Two that begin nearer must not get nearer still.
[[nodiscard]] bool keep_apart(const Envelope& separation, const Slots& a, const Slots& b);

}  // namespace comptonaut
