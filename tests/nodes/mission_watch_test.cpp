// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/mission_watch.h"

#include <gtest/gtest.h>

#include "start_time.h"

namespace comptonaut {
namespace {

MeasurementBatch batch_at(double t_s, int singles, int pairs, int others) {
  return {.utime = kStart_us + static_cast<Utime>(1e6 * t_s),
          .others = others,
          .channels = {{.nuclide = "Cs-137", .singles = singles, .pairs = pairs}}};
}

TEST(MissionWatch, SpeaksBeforeAnythingIsKnown) {
  EXPECT_EQ(MissionWatch().line(), "   0 s   coverage   0 %   sources none yet   events 0 (0 pairs)");
}

TEST(MissionWatch, CountsTimeAndEventsInWhateverOrderTheyCome) {
  MissionWatch watch;
  watch.on_measurements(batch_at(3.0, 10, 2, 1));
  watch.on_measurements(batch_at(0.0, 5, 0, 0));
  watch.on_measurements(batch_at(2.0, 1, 1, 0));
  EXPECT_EQ(watch.elapsed_s(), 3);
  EXPECT_EQ(watch.line(), "   3 s   coverage   0 %   sources none yet   events 20 (3 pairs)");
}

TEST(MissionWatch, TellsFoundFromReportedOnlyWhereTheTruthIsKnown) {
  MissionWatch watch;
  watch.on_sources({.utime = kStart_us + 60 * kSecond_us,
                    .estimator = "mlem",
                    .coverage = 0.41,
                    .sources = {{.nuclide = "Cs-137", .p_W = {10, 10, 0}, .activity_Bq = 2e9},
                                {.nuclide = "Cs-137", .p_W = {40, 10, 0}, .activity_Bq = 1e9}}});
  EXPECT_EQ(watch.line(), "   0 s   coverage  41 %   sources 2 reported   events 0 (0 pairs)");
  watch.on_truth({.time_scale = 12.34,
                  .area = {0, 50, 0, 50},
                  .sources = {{.nuclide = "Cs-137", .p_W = {11, 10, 0}, .activity_Bq = 2e9},
                              {.nuclide = "Cs-137", .p_W = {20, 40, 0}, .activity_Bq = 2e9}},
                  .mavs = {}});
  EXPECT_EQ(watch.line(), "   0 s   coverage  41 %   sources found 1 of 2   events 0 (0 pairs)   12.3 x real time");
}

}  // namespace
}  // namespace comptonaut
