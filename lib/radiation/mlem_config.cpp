// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/mlem_config.h"

#include "config/config.h"

namespace comptonaut {

MlemConfig read_mlem_config(Config& config) {
  MlemConfig mlem;
  config.read("attenuation_per_m", mlem.attenuation_per_m, {.min = 0.0, .max = 10.0});
  config.read("cone_sigma_rad", mlem.cone_sigma_rad, {.min = 1e-3, .max = 3.0});
  config.read("core_cut", mlem.core_cut, {.min = 1e-12, .max = 0.5});
  config.read("row_cut", mlem.row_cut, {.min = 0.0, .max = 0.5});
  config.read("iterations", mlem.iterations, {.min = 1, .max = 1000});
  config.read("source_radius_m", mlem.source_radius_m, {.min = 0.0, .max = 100.0});
  return mlem;
}

}  // namespace comptonaut
