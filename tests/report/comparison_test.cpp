// SPDX-License-Identifier: BSD-3-Clause
#include "report/comparison.h"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "report/browser.h"

namespace comptonaut {
namespace {

ComparedTeam team(const std::string& strategy, double median_s, double worst_s) {
  ComparedTeam team{.strategy = strategy, .estimator = "joint", .runs = 2};
  team.success_s = {median_s, worst_s};
  team.success_median_s = median_s;
  team.success_worst_s = worst_s;
  team.never = worst_s > 1e9 ? 1 : 0;
  team.distance_min_m = 2.5;
  team.collisions = 3;
  team.outside_s = 1.25;
  team.at_home = 5;
  team.flights = 6;
  for (QuartileCurve* curve : {&team.rmse_m, &team.found}) {
    for (int t_s = 1; t_s <= 20; ++t_s) {
      curve->lower.push_back(1.0 / t_s);
      curve->median.push_back(2.0 / t_s);
      curve->upper.push_back(3.0 / t_s);
    }
  }
  team.run.sources_W = {{10, 10}, {30, 40}};
  team.run.tracks_W = {{{0, 0}, {5, 5}}, {{9, 9}}};
  team.run.moments = {{.t_s = 5, .rmse_m = 3, .found = 1, .reported = {{{10, 11}, false}, {{44, 44}, true}}}};
  return team;
}

Comparison comparison(std::vector<ComparedTeam> teams) {
  return {.scenario = "field </script>",
          .area = {0, 50, 0, 50},
          .horizon_s = 20,
          .seeds = "1:2",
          .run = 2,
          .mavs = 2,
          .sources = 2,
          .teams = std::move(teams)};
}

TEST(Comparison, IsASelfContainedPage) {
  const std::string page = comparison_html(comparison({team("zigzag", 7, 9)}));
  std::string text = page;
  const std::string svg_name = "http://www.w3.org/2000/svg";  // a name, not an address
  text.replace(text.find(svg_name), svg_name.size(), "");
  const std::regex outside(
      R"((src|href|action|srcset)=(?!["']?data:)|url\((?!#)|@import|fetch\(|import\(|XMLHttp|https?:)");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(text, match, outside)) << match.str();
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_EQ(page.find("field </script>"), std::string::npos);
}

TEST_F(Browser, NamesTheQuickestOfACampaign) {
  const double never = std::numeric_limits<double>::infinity();
  const std::string page = rendered(comparison_html(comparison({team("zigzag", 9, never), team("information", 7, 9)})));
  EXPECT_EQ(element(page, "headline"),
            "information joint is quickest: all 2 found, none false, after 7 s (worst run 9 s)");
  for (const char* text : {"&gt; 20 s", "1 of 2 found · 1 false", "seed 2", "2.50 m", "1 of 2", "5 of 6", "missed\">3<",
                           "missed\">1.3 s<"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST_F(Browser, DrawsBuildingsBelowTheFlightsOfEachMapAndInItsKey) {
  const auto count = [](const std::string& page, const std::string& text) {
    int found = 0;
    for (std::size_t at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) ++found;
    return found;
  };
  Comparison town = comparison({team("zigzag", 7, 9), team("information", 7, 9)});
  const std::string flat = rendered(comparison_html(town));
  EXPECT_EQ(count(flat, "class=\"building\""), 0);
  EXPECT_EQ(count(flat, "building, wall</p>"), 0);
  town.buildings = {{10, 20, 30, 40.5}, {0, 50, 0, 0.5}};
  const std::string page = rendered(comparison_html(town));
  EXPECT_EQ(count(page, "class=\"building\""), 3) << "two maps and the key";
  EXPECT_EQ(count(page, "building, wall</p>"), 1);
  // 240 px show the 50 m and a twenty-fifth of them on either side.
  const std::size_t drawn = page.rfind("d=\"M53.3 51.1H97.8V97.8H53.3ZM8.9 228.9H231.1V231.1H8.9Z\"");
  ASSERT_NE(drawn, std::string::npos);
  EXPECT_LT(drawn, page.find("<circle", drawn));
  EXPECT_LT(page.rfind("<svg", drawn), drawn);
  EXPECT_EQ(page.substr(page.rfind("<svg", drawn), drawn - page.rfind("<svg", drawn)).find("<circle"),
            std::string::npos)
      << "sources, tracks and drones lie above";
}

TEST_F(Browser, ShowsACampaignOfNothingAndOneWithoutSuccess) {
  EXPECT_EQ(element(rendered(comparison_html(comparison({}))), "headline"), "No mission came to its end");
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(element(rendered(comparison_html(comparison({team("none", never, never)}))), "headline"),
            "No configuration succeeds in most of its runs");
}

}  // namespace
}  // namespace comptonaut
