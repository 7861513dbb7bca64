// SPDX-License-Identifier: BSD-3-Clause
#include "report/source_list.h"

#include <gtest/gtest.h>

namespace comptonaut {
namespace {

MissionRecord record_with(const std::vector<SourceEstimate>& estimates) {
  MissionRecord record;
  record.reports.push_back({.utime = 1'000'000, .estimator = "joint", .sources = estimates});
  return record;
}

TEST(SourceList, SetsEachFoundSourceBesideItsTruthAndLeavesNoneOut) {
  MissionRecord record =
      record_with({{.p_W = {30, 30, 0}, .activity_Bq = 1e9}, {.p_W = {10.3, 20.4, 0}, .activity_Bq = 1.9e9}});
  record.truth = Truth{.area = {0, 50, 0, 50}};
  record.truth->sources = {{.p_W = {10, 20, 0}, .activity_Bq = 2e9}, {.p_W = {40, 5, 0}, .activity_Bq = 5e8}};
  EXPECT_EQ(source_list(record),
            "true source                     found                           off by\n"
            "( 10.00,  20.00) m     2 GBq  ( 10.30,  20.40) m   1.9 GBq  0.50 m\n"
            "( 40.00,   5.00) m   500 MBq  not found\n"
            "                                ( 30.00,  30.00) m     1 GBq  false\n");
}

TEST(SourceList, SaysWhatIsReportedWhereNobodyKnowsTheTruth) {
  EXPECT_EQ(source_list(record_with({{.p_W = {30, 30, 0}, .activity_Bq = 1e9}})),
            "reported source\n( 30.00,  30.00) m     1 GBq\n");
  EXPECT_EQ(source_list(MissionRecord{}), "");
}

}  // namespace
}  // namespace comptonaut
