// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/map_sources.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace comptonaut {
namespace {

double squared_m2(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).squaredNorm(); }

/// Which of the maxima that are near in x a cell belongs to: all maxima, sorted by x, cut to |dx| <= radius.
class NearestMaximum {
 public:
  NearestMaximum(const Cells& cells, std::span<const std::uint32_t> maxima, double radius_m)
      : cells_(cells), maxima_(maxima), radius_m_(radius_m) {
    for (std::size_t i = 0; i < maxima.size(); ++i) by_x_.push_back(i);
    std::sort(by_x_.begin(), by_x_.end(), [this](std::size_t a, std::size_t b) { return x_m(a) < x_m(b); });
  }

  /// Rank of the maximum, nullopt where none is within the radius.
  [[nodiscard]] std::optional<std::size_t> of(const Eigen::Vector3d& p_W) const {
    std::optional<std::size_t> nearest;
    double nearest_m2 = radius_m_ * radius_m_;
    auto it = std::lower_bound(by_x_.begin(), by_x_.end(), p_W.x() - radius_m_,
                               [this](std::size_t i, double x) { return x_m(i) < x; });
    for (; it != by_x_.end() && x_m(*it) <= p_W.x() + radius_m_; ++it) {
      const double m2 = squared_m2(cells_.p_W(maxima_[*it]), p_W);
      if (m2 > nearest_m2 || (m2 == nearest_m2 && nearest && *nearest < *it)) continue;
      nearest = *it;
      nearest_m2 = m2;
    }
    return nearest;
  }

 private:
  [[nodiscard]] double x_m(std::size_t i) const { return cells_.p_W(maxima_[i]).x(); }

  const Cells& cells_;
  std::span<const std::uint32_t> maxima_;
  double radius_m_;
  std::vector<std::size_t> by_x_;
};

}  // namespace

std::vector<SourceEstimate> sources_of_map(const Cells& cells, std::span<const double> lambda_Bq,
                                           std::span<const std::uint32_t> maxima, const std::string& nuclide,
                                           double radius_m) {
  std::vector<SourceEstimate> sources;
  for (std::size_t i = 0; i < std::min(maxima.size(), kMaxSources); ++i) {
    sources.push_back({.nuclide = nuclide, .p_W = cells.p_W(maxima[i])});
  }
  const NearestMaximum nearest(cells, maxima, radius_m);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (!(lambda_Bq[j] > 0.0)) continue;
    const auto source = nearest.of(cells.p_W(j));
    if (source && *source < sources.size()) sources[*source].activity_Bq += lambda_Bq[j];
  }
  return sources;
}

}  // namespace comptonaut
