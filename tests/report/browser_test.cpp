// SPDX-License-Identifier: BSD-3-Clause
// The page in a real browser: its script runs, says the headline and obeys the time in the address.
#include "report/browser.h"

#include "report/page.h"

namespace comptonaut {
namespace {

constexpr SyntheticConfig kMission{.seed = 21, .duration_s = 20, .edge_m = 20};

TEST_F(Browser, ShowsTheHeadlineTheMapAndAllTables) {
  const std::string page = rendered(page_html(record_of(synthetic_mission(kMission))));
  EXPECT_NE(element(page, "headline").find("of 5 sources found within 2 m"), std::string::npos)
      << element(page, "headline");
  EXPECT_NE(element(page, "time-text").find("20 of 20 s"), std::string::npos) << element(page, "time-text");
  for (const char* text : {"S5", "MAV2 detector-reader", "rows_refused", "93.4 %", "not yet"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST_F(Browser, DrawsBuildingsBelowTheTracksAndOffersToHideThem) {
  MissionRecord record = record_of(synthetic_mission(kMission));
  const std::string flat = rendered(page_html(record));
  EXPECT_EQ(flat.find("class=\"building\""), std::string::npos);
  EXPECT_EQ(flat.find(">buildings</label>"), std::string::npos);
  record.buildings = {{2, 6, 3, 9.5}, {10, 15, 0, 0.5}};
  const std::string town = rendered(page_html(record));
  const std::size_t building = town.find("class=\"building\"");
  ASSERT_NE(building, std::string::npos);
  EXPECT_EQ(town.find("class=\"building\"", building + 1), std::string::npos) << "one path of all";
  EXPECT_NE(town.find(">buildings</label>"), std::string::npos);
  const std::size_t panel = town.rfind("<svg", building);
  EXPECT_EQ(town.substr(panel, building - panel).find("<circle"), std::string::npos) << "tracks and drones lie above";
}

TEST_F(Browser, ShowsTheTimeOfTheAddress) {
  const std::string page = rendered(page_html(record_of(synthetic_mission(kMission))), "#t=3");
  EXPECT_NE(element(page, "time-text").find("3 of 20 s"), std::string::npos) << element(page, "time-text");
  EXPECT_NE(element(page, "sources-title").find("at 3 s"), std::string::npos);
}

TEST_F(Browser, ShowsWhatThereIsOfARealFlight) {
  SyntheticConfig config = kMission;
  config.with_truth = false;
  const std::string page = rendered(page_html(record_of(synthetic_mission(config))));
  EXPECT_NE(element(page, "headline").find("5 sources reported after 20 s"), std::string::npos);
  EXPECT_EQ(page.find(">S1<"), std::string::npos);
}

TEST_F(Browser, ShowsAnEmptyMission) {
  const std::string page = rendered(page_html({}));
  EXPECT_NE(element(page, "headline").find("No estimate was recorded"), std::string::npos);
  EXPECT_EQ(element(page, "sources"), "No estimate was recorded.");
  EXPECT_EQ(element(page, "now"), "no estimate was recorded");
}

TEST_F(Browser, ShowsAMissionOfASingleMoment) {
  SyntheticConfig config = kMission;
  config.duration_s = 0;
  EXPECT_NE(rendered(page_html(record_of(synthetic_mission(config)))).find("0 of 5 sources"), std::string::npos);
}

}  // namespace
}  // namespace comptonaut
