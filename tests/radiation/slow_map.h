// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "radiation/joint_world.h"

namespace comptonaut {

inline const JointPhysics& physics() {
  static const JointPhysics shared = toy_physics();
  return shared;
}

inline const Cells& field() {
  static const Cells cells = flat_cells({0, 20, 0, 20}, 0.5);
  return cells;
}

/// Section 5.4, word for word, with every term of every cell.
struct SlowMap {
  const JointData& data;
  JointModel model;
  std::vector<ResponseColumn> columns;
  std::vector<double> s, lambda, ratio;  ///< the last step's factors

  SlowMap(const JointData& d, JointModel m)
      : data(d), model(std::move(m)), columns(field().size()), s(field().size()), ratio(field().size()) {
    double counted = static_cast<double>(data.pairs.size()), all_s = 0.0;
    for (const double n : data.viewpoints.singles) counted += n;
    for (std::size_t j = 0; j < s.size(); ++j) {
      fill_column(physics(), data, field().p_W(j), columns[j]);
      for (std::size_t k = 0; k < model.drones.size(); ++k) s[j] += model.drones[k].scale * columns[j].exposure_s[k];
      for (std::size_t v = 0; v < data.viewpoints.size(); ++v) s[j] += factor(v) * columns[j].singles[v];
      all_s += s[j];
    }
    lambda.assign(s.size(), 0.5 * counted / all_s);
  }
  double factor(std::size_t v) const { return model.drones[data.viewpoints.drone[v]].scale * model.scatter; }

  /// Returns the likelihood before the step.
  double step() {
    std::vector<double> mu(data.viewpoints.size()), f(data.pairs.size()), up(s.size(), 0.0);
    std::vector<double> singles(model.drones.size(), 0.0), pairs(model.drones.size(), 0.0);
    double log_l = 0.0;
    for (std::size_t v = 0; v < mu.size(); ++v) {
      const DroneModel& drone = model.drones[data.viewpoints.drone[v]];
      mu[v] = drone.singles_per_s * data.viewpoints.live_s[v];
      for (std::size_t j = 0; j < s.size(); ++j) mu[v] += factor(v) * columns[j].singles[v] * lambda[j];
      log_l += data.viewpoints.singles[v] * std::log(mu[v]) - mu[v];
      singles[data.viewpoints.drone[v]] += data.viewpoints.singles[v] / mu[v] * data.viewpoints.live_s[v];
    }
    for (std::size_t i = 0; i < f.size(); ++i) {
      const DroneModel& drone = model.drones[data.pairs[i].drone];
      f[i] = drone.pairs_per_s * kIsotropic_per_sr;
      for (std::size_t j = 0; j < s.size(); ++j) f[i] += drone.scale * columns[j].pairs[i] * lambda[j];
      log_l += std::log(f[i]);
      pairs[data.pairs[i].drone] += kIsotropic_per_sr / f[i];
    }
    for (std::size_t j = 0; j < s.size(); ++j) {
      for (std::size_t k = 0; k < model.drones.size(); ++k) {
        log_l -= model.drones[k].scale * columns[j].exposure_s[k] * lambda[j];
      }
      for (std::size_t v = 0; v < mu.size(); ++v) {
        up[j] += factor(v) * columns[j].singles[v] * data.viewpoints.singles[v] / mu[v];
      }
      for (std::size_t i = 0; i < f.size(); ++i) {
        up[j] += model.drones[data.pairs[i].drone].scale * columns[j].pairs[i] / f[i];
      }
      ratio[j] = up[j] / s[j];
      lambda[j] *= ratio[j];
    }
    for (std::size_t k = 0; k < model.drones.size(); ++k) {
      log_l -= model.drones[k].pairs_per_s * data.live_s[k];
      model.drones[k].singles_per_s *= singles[k] / data.live_s[k];
      model.drones[k].pairs_per_s *= pairs[k] / data.live_s[k];
    }
    return log_l;
  }
};

}  // namespace comptonaut
