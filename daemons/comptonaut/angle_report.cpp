// SPDX-License-Identifier: BSD-3-Clause
#include "angle_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/angle.h"

namespace comptonaut {
namespace {

constexpr double kFloor = 1e-9;  // below the diagram

Chart density_chart(const AngleReport& report) {
  Curve simulated{.name = "simulated", .style = Curve::Style::kSteps}, model{.name = "density"};
  for (const AngleBin& bin : report.angles) {
    simulated.x.push_back(bin.from_rad / kDegree);
    simulated.y.push_back(std::max(bin.measured_per_rad * kDegree, kFloor));
    model.x.push_back(0.5 * (bin.from_rad + bin.to_rad) / kDegree);
    model.y.push_back(std::max(bin.model_per_rad * kDegree, kFloor));
  }
  return {.title = report.nuclide + ": angular error of the cones",
          .x = {.label = "delta = angle(source, axis) - beta, degrees", .min = -90, .max = 90},
          .y = {.label = "share per degree", .min = 1e-5, .max = 1, .logarithmic = true},
          .curves = {simulated, model}};
}

Chart reliability_chart(const AngleReport& report) {
  Curve several{.name = "both hypotheses kept", .style = Curve::Style::kDots};
  Curve sole{.name = "the only one kept", .style = Curve::Style::kDots};
  for (const ReliabilityBin& bin : report.probabilities) {
    if (!(bin.hypotheses > 0.0)) continue;
    Curve& curve = bin.from < 1.0 ? several : sole;
    curve.x.push_back(bin.stated);
    curve.y.push_back(bin.is_true);
  }
  return {.title = "Share of hypotheses that are true",
          .x = {.label = "stated probability"},
          .y = {.label = "share that is true"},
          .curves = {several, sole, {.name = "as stated", .x = {0, 1}, .y = {0, 1}}},
          .legend_left = true};
}

}  // namespace

std::string angle_csv(const AngleReport& report) {
  std::string csv = fmt::format("# command: {}\n# nuclide: {}\nquantity,from,to,samples,measured,stated\n",
                                report.command, report.nuclide);
  for (const AngleBin& bin : report.angles) {
    csv += fmt::format("delta_deg,{:.0f},{:.0f},{:.0f},{:.4g},{:.4g}\n", bin.from_rad / kDegree, bin.to_rad / kDegree,
                       bin.pairs, bin.measured_per_rad * kDegree, bin.model_per_rad * kDegree);
  }
  for (const ReliabilityBin& bin : report.probabilities) {
    csv += fmt::format("probability,{:.1f},{:.1f},{:.0f},{:.4f},{:.4f}\n", bin.from, bin.to, bin.hypotheses,
                       bin.is_true, bin.stated);
  }
  return csv;
}

std::vector<Panel> angle_picture(const AngleReport& report) {
  return {density_chart(report), reliability_chart(report)};
}

}  // namespace comptonaut
