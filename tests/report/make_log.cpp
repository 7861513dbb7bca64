// SPDX-License-Identifier: BSD-3-Clause
// Writes the log of a synthetic mission, to look at the report without flying one:
// synthetic_log FILE [seed [duration_s [edge_m [drones [joint|mlem [without-truth]]]]]]
#include <cstdlib>

#include "report/synthetic_mission.h"

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  comptonaut::SyntheticConfig config{.duration_s = 300};
  if (argc > 2) config.seed = std::strtoull(argv[2], nullptr, 10);
  if (argc > 3) config.duration_s = std::atoi(argv[3]);
  if (argc > 4) config.edge_m = std::atof(argv[4]);
  if (argc > 5) config.drones = std::atoi(argv[5]);
  if (argc > 6) config.estimator = argv[6];
  config.with_truth = argc <= 7;
  comptonaut::write_log(comptonaut::synthetic_mission(config), argv[1]);
  return 0;
}
