// SPDX-License-Identifier: BSD-3-Clause
#include "report/reconstruction_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace comptonaut {
namespace {

constexpr double kSigmas95 = 1.959964;         // of a Gaussian
constexpr double kSigmas95InPlane = 2.447747;  // sqrt(-2 ln 0.05)

nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json to_json(const SourceEstimate& source) {
  const ActivityInterval activity = interval_95(source);
  const PositionEllipse ellipse = ellipse_95(source);
  return {{"nuclide", source.nuclide},
          {"x_m", source.p_W.x()},
          {"y_m", source.p_W.y()},
          {"z_m", source.p_W.z()},
          {"x_sigma_m", number_or_null(source.position_sigma_m.x())},
          {"y_sigma_m", number_or_null(source.position_sigma_m.y())},
          {"xy_covariance_m2", number_or_null(source.position_cov_xy_m2)},
          {"ellipse_95_major_m", number_or_null(ellipse.major_m)},
          {"ellipse_95_minor_m", number_or_null(ellipse.minor_m)},
          {"ellipse_95_direction_rad", number_or_null(ellipse.direction_rad)},
          {"activity_Bq", source.activity_Bq},
          {"activity_sigma_Bq", number_or_null(source.activity_sigma_Bq)},
          {"activity_95_low_Bq", number_or_null(activity.low_Bq)},
          {"activity_95_high_Bq", number_or_null(activity.high_Bq)},
          {"log_likelihood_gain", number_or_null(source.significance)}};
}

}  // namespace

std::string lambda_csv(const Cells& cells, const Reconstruction& result) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "x_m,y_m,z_m,lambda_Bq,sensitivity_s\n");
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", p_W.x(), p_W.y(), p_W.z(), result.lambda_Bq[j],
                   result.sensitivity_s[j]);
  }
  return fmt::to_string(text);
}

std::string sources_json(const Reconstruction& result) {
  nlohmann::ordered_json json = {
      {"estimator", result.estimator},  {"nuclide", result.nuclide},        {"viewpoints", result.events.viewpoints},
      {"live_s", result.events.live_s}, {"singles", result.events.singles}, {"pairs", result.events.photons},
      {"cones", result.events.cones}};
  if (result.estimator == "joint") {
    json["converged"] = result.converged;
    json["updates"] = result.updates;
    json["log_likelihood"] = number_or_null(result.log_likelihood);
    json["certificate_s"] = number_or_null(result.certificate_s);
    json["coverage"] = number_or_null(result.coverage);
  }
  json["map_change"] = number_or_null(result.map_change);
  json["sources"] = nlohmann::ordered_json::array();
  for (const SourceEstimate& source : result.sources) json["sources"].push_back(to_json(source));
  return json.dump(2) + "\n";
}

ActivityInterval interval_95(const SourceEstimate& source) {
  const double factor = std::exp(kSigmas95 * source.activity_sigma_Bq / source.activity_Bq);
  return {.low_Bq = source.activity_Bq / factor, .high_Bq = source.activity_Bq * factor};
}

PositionEllipse ellipse_95(const SourceEstimate& source) {
  const double xx = source.position_sigma_m.x() * source.position_sigma_m.x();
  const double yy = source.position_sigma_m.y() * source.position_sigma_m.y();
  const double xy = source.position_cov_xy_m2;
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  return {.major_m = kSigmas95InPlane * std::sqrt(mean + half),
          .minor_m = kSigmas95InPlane * std::sqrt(std::max(mean - half, 0.0)),
          .direction_rad = 0.5 * std::atan2(2.0 * xy, xx - yy)};
}

}  // namespace comptonaut
