// SPDX-License-Identifier: BSD-3-Clause
#include "sim/campaign_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace comptonaut {
namespace {

std::string field(double value) { return std::isnan(value) ? std::string() : fmt::format("{:.4f}", value); }

void add_rows(std::string& text, const CampaignNames& names, const MissionResult& mission) {
  for (const Judgement& step : mission.steps) {
    const Localisation& l = step.localisation;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.0f},{},{},{},{},{},{},{},{},{}\n", names.scenario,
                   names.strategy, names.estimator, mission.seed, step.t_s, field(l.rmse_nearest_m), field(l.rmse_m),
                   l.found_2m, l.found_half_m, l.reported, l.false_reports, field(step.coverage),
                   field(l.activity_error_rel), field(step.crb_m));
  }
}

void add_source_rows(std::string& text, const std::string& begin, const MissionResult& mission) {
  for (const Judgement& step : mission.steps) {
    const std::vector<double>& nearest_m = step.localisation.nearest_m;
    for (std::size_t i = 0; i < nearest_m.size(); ++i) {
      const SourceError e = i < step.errors.size() ? step.errors[i] : SourceError{};
      fmt::format_to(std::back_inserter(text), "{}{},{:.0f},{},{:.4f},{},{},{},{},{},{}\n", begin, mission.seed,
                     step.t_s, i + 1, nearest_m[i], field(e.x_m), field(e.y_m), field(e.x_sigma_m), field(e.y_sigma_m),
                     field(e.activity_rel), field(e.activity_rel_sigma));
    }
  }
}

}  // namespace

std::string campaign_csv(std::span<const CampaignPart> parts) {
  std::string text =
      "scenario,strategy,estimator,seed,t_s,rmse_nearest_m,rmse_m,found_2m,found_0.5m,reported,false,coverage,"
      "activity_error_rel,crb_m\n";
  for (const CampaignPart& part : parts) {
    for (const MissionResult& mission : part.missions) add_rows(text, part.names, mission);
  }
  return text;
}

std::string per_source_csv(std::span<const CampaignPart> parts) {
  const bool named = parts.size() > 1;
  std::string text = named ? "scenario,strategy,estimator," : "";
  text += "seed,t_s,source,error_m,x_error_m,y_error_m,x_sigma_m,y_sigma_m,activity_error_rel,activity_sigma_rel\n";
  for (const auto& [names, missions] : parts) {
    const std::string begin =
        named ? fmt::format("{},{},{},", names.scenario, names.strategy, names.estimator) : std::string();
    for (const MissionResult& mission : missions) add_source_rows(text, begin, mission);
  }
  return text;
}

}  // namespace comptonaut
