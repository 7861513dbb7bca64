// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "search/lookahead.h"
#include "search/search_fixture.h"

namespace comptonaut {

inline SearchConfig information_config() { return {.strategy = "information"}; }

inline SourceEstimate source_at(double x_m, double y_m, double activity_Bq, double sigma_m) {
  return {.nuclide = "Cs-137",
          .p_W = {x_m, y_m, 0.0},
          .activity_Bq = activity_Bq,
          .position_sigma_m = {sigma_m, sigma_m, 0.0}};
}

/// A field with all that a flight is judged by, after `live_s` seconds above each square.
struct Outlook {
  explicit Outlook(const Field& field_, double live_s = 0.0, const std::vector<SourceEstimate>& sources = {},
                   SearchConfig config_ = information_config())
      : config(std::move(config_)), ground(field_.cells, config.information.square_m, 1600) {
    SearchState state = field_.state();
    state.sources = sources;
    const Kernels kernels = singles_kernels(ground, state, config.set_height_m);
    hover_W = hover_places(ground, state.world, config.route, config.set_height_m);
    prospect = make_prospect(
        ground, kernels, state, config,
        Eigen::ArrayXf::Constant(static_cast<Eigen::Index>(ground.size()), static_cast<float>(live_s)), hover_W);
  }

  [[nodiscard]] Lookahead lookahead() const {
    return {.ground = ground, .prospect = prospect, .config = config.information, .free = [](const Eigen::Vector3d&) {
              return true;
            }};
  }

  [[nodiscard]] Eigen::ArrayXf open() const { return open_weight(prospect.weight, prospect.known); }

  SearchConfig config;
  CoarseGround ground;
  HoverPlaces hover_W;
  Prospect prospect;
};

}  // namespace comptonaut
