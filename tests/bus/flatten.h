// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bus/codec.h"

namespace comptonaut {

/// All numbers and all texts of a message, in the order of its struct: to compare two of them.
struct Flat {
  std::vector<double> numbers;
  std::vector<std::string> texts;

  template <class... Numbers>
  Flat& add(Numbers... values) {
    (numbers.push_back(static_cast<double>(values)), ...);
    return *this;
  }
  Flat& add_vector(const Eigen::Vector3d& v) { return add(v.x(), v.y(), v.z()); }
  Flat& add_quaternion(const Eigen::Quaterniond& q) { return add(q.w(), q.x(), q.y(), q.z()); }
  Flat& add_text(const std::string& text) {
    texts.push_back(text);
    return *this;
  }
  Flat& add_key(const BatchKey& key) { return add(key.mission, key.sender, key.boot_epoch, key.number); }
  Flat& add_basis(const Basis& basis) {
    for (const BasisEntry& entry : basis) {
      add(entry.sender, entry.boot_epoch, entry.number);
      for (const std::int64_t number : entry.skipped) add(number);
    }
    return *this;
  }
  Flat& add_counts(const std::vector<ChannelCounts>& channels) {
    for (const ChannelCounts& c : channels) add_text(c.nuclide).add(c.singles, c.pairs);
    return *this;
  }
};

inline Flat flatten(const EventBatch& b) {
  Flat flat;
  flat.add_key(b.key).add(b.utime, b.duration_us, b.live_us, b.utime_sigma_us, b.others).add_counts(b.channels);
  for (const PairEvent& p : b.pairs) {
    flat.add(p.offset_ns, p.channel, p.e1_keV, p.e2_keV);
    for (const ConeHypothesis& h : {p.a, p.b}) flat.add_vector(h.axis_D).add(h.cos_beta, h.probability);
  }
  return flat;
}

inline Flat flatten(const MeasurementBatch& b) {
  Flat flat;
  flat.add_key(b.key).add(b.utime, b.duration_us, b.live_us, b.utime_sigma_us);
  flat.add_vector(b.p_WD)
      .add_quaternion(b.q_WD)
      .add_vector(b.v_WD)
      .add(b.battery_percent, b.others)
      .add_counts(b.channels);
  for (const Cone& c : b.cones) {
    flat.add(c.offset_us, c.event, c.channel).add_vector(c.p_WS).add_vector(c.axis_W).add(c.cos_beta, c.weight);
  }
  return flat;
}

inline Flat flatten(const RangePoints& points) {
  Flat flat;
  flat.add(points.utime, points.range_max_m).add_vector(points.p_BR);
  for (const Eigen::Vector3f& p_B : points.points_B) flat.add_vector(p_B.cast<double>());
  return flat;
}

inline Flat flatten(const TerrainTile& tile) {
  Flat flat;
  flat.add_key(tile.key).add(tile.utime, tile.voxel_m);
  for (const auto& [voxel, occupancy] : tile.voxels) flat.add(voxel.x, voxel.y, voxel.z, static_cast<int>(occupancy));
  return flat;
}

inline Flat flatten(const StampedPose& p) {
  Flat flat;
  flat.add(p.utime).add_vector(p.p_WB).add_quaternion(p.q_WB);
  return flat.add_vector(p.v_WB_B).add_vector(p.w_WB_B).add_vector(p.a_WB_B);
}

inline Flat flatten(const PoseQuality& q) {
  return Flat().add(q.utime, q.position_sigma_m, q.height_sigma_m, q.yaw_sigma_rad, q.quality_percent, q.resets);
}

inline Flat flatten(const VehicleState& v) {
  Flat flat;
  flat.add(v.utime, v.sender, v.connected, v.armed, v.battery_percent).add_vector(v.p_WHome);
  for (const auto& corner : v.fence_m) flat.add(corner.x(), corner.y());
  flat.add(v.fence_floor_m, v.fence_ceiling_m, v.plan_number, v.waypoint);
  return flat.add_text(v.mode).add_text(v.hold_reason);
}

inline Flat flatten(const Plan& p) {
  Flat flat;
  flat.add(p.mission, p.utime, p.mav, p.term, p.number).add_basis(p.basis).add_text(p.status);
  for (const Waypoint& w : p.waypoints) flat.add_vector(w.p_W).add(w.speed_max_m_s, w.utime);
  return flat;
}

inline Flat flatten(const SourceReport& r) {
  Flat flat;
  flat.add(r.mission, r.utime, r.certificate, r.coverage).add_text(r.estimator);
  for (const SourceEstimate& s : r.sources) {
    flat.add_text(s.nuclide).add_vector(s.p_W).add(s.activity_Bq).add_vector(s.position_sigma_m);
    flat.add(s.position_cov_xy_m2, s.activity_sigma_Bq, s.significance);
  }
  return flat;
}

inline Flat flatten(const MapTile& t) {
  Flat flat;
  flat.add(t.mission, t.utime, t.cell_m, t.tile, t.tiles).add_text(t.nuclide);
  for (const MapCell& c : t.cells) flat.add(c.key.x, c.key.y, c.key.z, c.lambda_Bq, c.sensitivity_s);
  return flat;
}

inline Flat flatten(const ClearanceTile& t) {
  Flat flat;
  flat.add(t.mission, t.utime, t.chance, t.cell_m, t.tile, t.tiles).add_text(t.nuclide);
  for (const ClearanceCell& c : t.cells) flat.add(c.key.x, c.key.y, c.key.z, c.limit_Bq);
  return flat;
}

inline Flat flatten(const PatchReport& r) {
  Flat flat;
  flat.add(r.mission, r.utime);
  for (const PatchEstimate& p : r.patches) {
    flat.add_text(p.nuclide).add_vector(p.p_W).add(p.area_m2, p.activity_Bq, p.gain);
  }
  return flat;
}

inline Flat flatten(const CoordinatorState& s) {
  Flat flat;
  flat.add(s.mission, s.utime, s.sender, s.term, s.lease_us, s.cones, s.viewpoints).add_basis(s.basis);
  return flat.add_text(std::to_string(s.terrain_hash)).add_text(std::to_string(s.lambda_hash));
}

inline Flat flatten(const DaemonStatus& s) {
  Flat flat;
  flat.add(s.utime, s.sender).add_text(s.daemon).add_text(s.version).add_text(s.state);
  for (const Counter& c : s.counters) flat.add_text(c.name).add(c.value);
  return flat;
}

inline Flat flatten(const Truth& t) {
  Flat flat;
  flat.add(t.utime, t.start_utime, t.time_scale).add_text(t.scenario);
  flat.add(t.area.x_min_m, t.area.x_max_m, t.area.y_min_m, t.area.y_max_m);
  for (const TrueSource& s : t.sources) flat.add_text(s.nuclide).add_vector(s.p_W).add(s.activity_Bq);
  for (const TrueMav& m : t.mavs) flat.add(m.mav).add_vector(m.p_WB).add(m.yaw_rad, m.photons);
  return flat;
}

}  // namespace comptonaut
