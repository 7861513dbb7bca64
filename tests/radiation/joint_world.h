// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.h"
#include "radiation/joint_model.h"
#include "radiation/measurement_batch.h"
#include "radiation/toy_response.h"
#include "response/response_table.h"

namespace comptonaut {

/// The toy response as a table of 10 degrees; singles are 25 times as many as pairs, with a shape of their own.
inline ResponseTable toy_table() {
  std::vector<ResponseEntry> entries;
  for (int theta = 0; theta <= 180; theta += 10) {
    for (int phi = -180; phi < 180; phi += theta % 180 == 0 ? 360 : 10) {
      ResponseEntry entry{.phi_rad = phi * std::numbers::pi / 180, .theta_rad = theta * std::numbers::pi / 180};
      const Eigen::Vector3d u_D = direction_D(entry.phi_rad, entry.theta_rad);
      entry.pair = toy_pair_response(u_D);
      entry.single = 25.0 * 3e-8 * (1.0 - 0.2 * u_D.x() * u_D.x());
      entries.push_back(entry);
    }
  }
  return ResponseTable(std::move(entries));
}

/// A narrow core and a wide tail, the same for all cones.
inline ConeDensity toy_cones() {
  const std::vector<ConeDensity::Node> nodes = {{.beta_rad = 0.0, .weights = {0, 0, 0.4, 0.3, 0.2, 0.06, 0.02, 0.02}}};
  return {nodes, nodes};
}

inline JointPhysics toy_physics() {
  return {.response = SmoothResponse(toy_table()), .cones = ConeTable(toy_cones(), 0.01), .attenuation_per_m = 0.0093};
}

/// What two drones measure of point sources in a simulated field that is what the likelihood believes.
struct ToyField {
  std::vector<PointSource> sources;
  double singles_background_per_s = 3.0;
  double scatter = 1.2;

  /// One batch at p_WD, its photons drawn by `random`.
  [[nodiscard]] MeasurementBatch measure(const JointPhysics& physics, int sender, const Eigen::Vector3d& p_WD,
                                         Random& random) const {
    MeasurementBatch batch{.live_us = 50'000, .p_WD = p_WD, .channels = {{.nuclide = "Cs-137"}}};
    batch.key.sender = sender;
    batch.q_WD = Eigen::AngleAxisd(random.uniform(0.0, 6.0), Eigen::Vector3d::UnitZ()) *
                 Eigen::AngleAxisd(std::numbers::pi + 0.1 * random.normal(), Eigen::Vector3d::UnitX());
    double singles = singles_background_per_s * 0.05;
    for (const PointSource& source : sources) {
      const Eigen::Vector3d to_W = source.p_W - p_WD, u_D = batch.q_WD.conjugate() * to_W;
      const double decays = 0.05 * source.activity_Bq * std::exp(-0.0093 * to_W.norm()) / to_W.squaredNorm();
      const Response L = physics.response(u_D.x(), u_D.y(), u_D.z());
      singles += scatter * decays * L.single;
      for (auto n = random.poisson(decays * L.pair); n > 0; --n) add_pair(batch, to_W.normalized(), random);
    }
    batch.channels[0].singles = static_cast<int>(random.poisson(singles));
    return batch;
  }

  /// Two drones sweep [0, edge]^2 in lanes of `lane_m`, 0.4 m a batch, 2 m high.
  [[nodiscard]] std::vector<MeasurementBatch> sweep(const JointPhysics& physics, double edge_m, double lane_m,
                                                    std::uint64_t seed) const {
    Random random(seed);
    std::vector<MeasurementBatch> batches;
    for (double y_m = 0.5 * lane_m; y_m < edge_m; y_m += lane_m) {
      for (double x_m = 0.0; x_m < edge_m; x_m += 0.4) {
        batches.push_back(measure(physics, y_m < 0.5 * edge_m ? 1 : 2, {x_m, y_m, 2.0}, random));
      }
    }
    return batches;
  }

 private:
  /// The true reading passes the source by a draw of a narrow core and a wide tail; the false one lies anywhere.
  static void add_pair(MeasurementBatch& batch, const Eigen::Vector3d& u_W, Random& random) {
    const int event = batch.cones.empty() ? 0 : batch.cones.back().event + 1;
    const double beta_rad = random.uniform(0.3, 1.6);
    const double delta_rad = (random.uniform() < 0.6 ? 0.06 : 0.25) * random.normal();
    const Eigen::Vector3d across_W = u_W.cross(random.unit_vector()).normalized();
    const Eigen::Vector3d axis_W = Eigen::AngleAxisd(beta_rad + delta_rad, across_W) * u_W;
    batch.cones.push_back(
        {.event = event, .p_WS = batch.p_WD, .axis_W = axis_W, .cos_beta = std::cos(beta_rad), .weight = 0.6});
    batch.cones.push_back(
        {.event = event, .p_WS = batch.p_WD, .axis_W = -axis_W, .cos_beta = random.uniform(-0.5, 0.9), .weight = 0.4});
  }
};

inline JointData data_of(const std::vector<MeasurementBatch>& batches) {
  JointData data;
  for (const MeasurementBatch& batch : batches) add(data, batch, "Cs-137");
  return data;
}

/// Of two sources on 20 x 20 m.
inline JointData some_data(std::uint64_t seed) {
  const ToyField toy{
      .sources = {{.p_W = {6.2, 7.3, 0.0}, .activity_Bq = 2e9}, {.p_W = {14.7, 12.1, 0.0}, .activity_Bq = 1e9}}};
  return data_of(toy.sweep(toy_physics(), 20.0, 3.0, seed));
}

/// Backgrounds and response scales that differ by drone; no sources.
inline JointModel some_model(const JointData& data) {
  JointModel model;
  for (std::size_t d = 0; d < data.senders.size(); ++d) {
    model.drones.push_back({.singles_per_s = 2.0 + d, .pairs_per_s = 0.02, .scale = 1.0 + 0.05 * d});
  }
  return model;
}

}  // namespace comptonaut
