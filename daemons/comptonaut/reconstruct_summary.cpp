// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/reconstruction_files.h"
#include "report/scores.h"

namespace comptonaut {
namespace {

constexpr std::size_t kShown = 10;  // maxima of a map; the file of sources has them all

std::string measured(const Cells& cells, const MeasuredEvents& events) {
  return fmt::format(
      "viewpoints  {:>9}  {:.1f} s of live time\n"
      "singles     {:>9}\n"
      "pairs       {:>9}  {} cones\n"
      "cells       {:>9}  of {} m\n",
      events.viewpoints, events.live_s, events.singles, events.photons, events.cones, cells.size(), cells.cell_m());
}

std::string convergence(const Reconstruction& result) {
  std::string text;
  if (std::isfinite(result.map_change)) {
    text += fmt::format("map         the last iteration moved {:.2f} % of the events; {} cones meet no cell\n",
                        100.0 * result.map_change, result.cones_outside);
  }
  if (result.estimator != "joint") return text;
  return text + fmt::format(
                    "sources     {} after {} updates; largest score anywhere {:.2g} s; {:.1f} % of the ground "
                    "searched\n",
                    result.converged ? "converged" : "NOT converged", result.updates, result.certificate_s,
                    100.0 * result.coverage);
}

std::string row_of(const SourceEstimate& source) {
  std::string row =
      fmt::format("({:9.2f}, {:9.2f}) m  {:>9}", source.p_W.x(), source.p_W.y(), activity_text(source.activity_Bq));
  const ActivityInterval activity = interval_95(source);
  if (!std::isfinite(activity.high_Bq)) return row + "\n";
  const PositionEllipse ellipse = ellipse_95(source);
  return row + fmt::format("  {:>9} .. {:<9}  {:5.2f} x {:.2f} m  {:8.0f}\n", activity_text(activity.low_Bq),
                           activity_text(activity.high_Bq), ellipse.major_m, ellipse.minor_m, source.significance);
}

}  // namespace

std::string reconstruction_summary(const Cells& cells, const Reconstruction& result) {
  const std::vector<SourceEstimate>& sources = result.sources;
  std::string text = measured(cells, result.events) + convergence(result) + "\n";
  if (result.estimator == "joint") {
    text += fmt::format("{} of {}{}\n", sources.size() == 1 ? "1 source" : fmt::format("{} sources", sources.size()),
                        result.nuclide,
                        sources.empty() ? ""
                                        : ":\n       x         y             activity   its 95 % interval       "
                                          "95 % ellipse  log likelihood");
  } else {
    text += fmt::format("{} maxima of the map of {}, highest first; it does not say which of them are sources\n",
                        sources.size(), result.nuclide);
  }
  const std::size_t shown = result.estimator == "joint" ? sources.size() : std::min(kShown, sources.size());
  for (std::size_t k = 0; k < shown; ++k) text += row_of(sources[k]);
  return shown < sources.size() ? text + "...\n" : text;
}

}  // namespace comptonaut
