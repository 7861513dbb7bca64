// SPDX-License-Identifier: BSD-3-Clause
#include "spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace comptonaut {
namespace {

constexpr double kEndLeast_keV = 100.0, kEndStep_keV = 50.0;
constexpr double kRareShare = 0.0005;
constexpr double kGuideLeast_per_decay = 0.03;
constexpr double kSameLine_keV = 0.5;  // of two channels of one nuclide

/// Exactly two clusters are left once fluorescence is merged.
bool is_pair(const DetectorEvent& event, double distance_min_px) {
  if (event.second.size_px == 0) return false;
  const double both_keV = event.first.energy_keV + event.second.energy_keV;
  return std::abs(event.energy_keV - both_keV) <= 1e-6 * event.energy_keV &&
         std::hypot(event.first.x_px - event.second.x_px, event.first.y_px - event.second.y_px) >= distance_min_px;
}

/// "Co-60" of "Co-60-1332": channels of a nuclide have its name and more.
std::string nuclide_name(const std::string& channel) {
  return channel.substr(0, channel.find('-', channel.find('-') + 1));
}

void add_lines(const NuclideChannel& nuclide, double max_keV, std::vector<Guide>& guides) {
  for (const GammaLine& line : emitted_lines(nuclide)) {
    const std::string label =
        fmt::format("{} {:.{}f}", nuclide_name(nuclide.name), line.energy_keV, line.energy_keV < 100.0 ? 1 : 0);
    const bool known = std::any_of(guides.begin(), guides.end(), [&](const Guide& guide) {
      return guide.label == label && std::abs(guide.x - line.energy_keV) < kSameLine_keV;
    });
    if (known || line.per_decay < kGuideLeast_per_decay || line.energy_keV > max_keV) continue;
    guides.push_back({.x = line.energy_keV, .label = label});
  }
}

}  // namespace

Spectrum::Spectrum(double bin_keV, std::size_t bins) : bin_keV_(bin_keV), cluster_bins_(bins), pair_bins_(bins) {}

void Spectrum::add(std::span<const Cluster> clusters, std::span<const DetectorEvent> events,
                   double pair_distance_min_px) {
  for (const Cluster& cluster : clusters) count(cluster.energy_keV, cluster_bins_);
  clusters_ += std::ssize(clusters);
  for (const DetectorEvent& event : events) {
    if (!is_pair(event, pair_distance_min_px)) continue;
    ++pairs_;
    count(event.energy_keV, pair_bins_);
  }
}

void Spectrum::count(double energy_keV, std::vector<std::int64_t>& histogram) const {
  const double bin = energy_keV / bin_keV_;
  if (bin >= 0.0 && bin < static_cast<double>(histogram.size())) ++histogram[static_cast<std::size_t>(bin)];
}

double Spectrum::end_keV() const {
  const std::int64_t all = std::reduce(cluster_bins_.begin(), cluster_bins_.end());
  const auto rare = static_cast<std::int64_t>(kRareShare * static_cast<double>(all));
  std::size_t end = cluster_bins_.size();
  for (std::int64_t above = 0; end > 0; --end) {
    above += cluster_bins_[end - 1] + pair_bins_[end - 1];
    if (above > rare) break;
  }
  return std::max(kEndLeast_keV, kEndStep_keV * std::ceil(static_cast<double>(end) * bin_keV_ / kEndStep_keV));
}

std::size_t Spectrum::bins_to(double max_keV) const {
  return std::min(cluster_bins_.size(), static_cast<std::size_t>(std::ceil(max_keV / bin_keV_ - 1e-9)));
}

std::string Spectrum::csv(double max_keV) const {
  std::string rows = "from_keV,to_keV,clusters,pair_sums\n";
  for (std::size_t i = 0; i < bins_to(max_keV); ++i) {
    const auto from = static_cast<double>(i);
    fmt::format_to(std::back_inserter(rows), "{:g},{:g},{},{}\n", from * bin_keV_, (from + 1.0) * bin_keV_,
                   cluster_bins_[i], pair_bins_[i]);
  }
  return rows;
}

Chart Spectrum::picture(const std::string& title, double max_keV, const std::vector<NuclideChannel>& nuclides) const {
  const auto curve = [&](const std::string& name, std::int64_t total, const std::vector<std::int64_t>& bins) {
    Curve steps{.name = fmt::format("{}: {}", name, total), .style = Curve::Style::kSteps};
    for (std::size_t i = 0; i <= bins_to(max_keV); ++i) {
      steps.x.push_back(bin_keV_ * static_cast<double>(i));
      steps.y.push_back(i < bins.size() ? static_cast<double>(bins[i]) : 0.0);
    }
    return steps;
  };
  const auto most = static_cast<double>(*std::max_element(cluster_bins_.begin(), cluster_bins_.end()));
  Chart chart{.title = title,
              .x = {.label = "energy, keV", .min = 0, .max = max_keV},
              .y = {.label = fmt::format("number per {:g} keV", bin_keV_),
                    .min = 0.7,
                    .max = std::max(10.0, 2.0 * most),
                    .logarithmic = true},
              .curves = {curve("clusters", clusters_, cluster_bins_), curve("pair sums", pairs_, pair_bins_)}};
  for (const NuclideChannel& nuclide : nuclides) add_lines(nuclide, max_keV, chart.guides);
  return chart;
}

}  // namespace comptonaut
