// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/metrics.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "radiation/assignment.h"

namespace comptonaut {
namespace {

constexpr double kApart_m = std::numeric_limits<double>::infinity();

/// Infinite between different nuclides.
Eigen::MatrixXd distances(std::span<const PointSource> truth, std::span<const PointSource> estimates) {
  Eigen::MatrixXd d_m = Eigen::MatrixXd::Constant(truth.size(), estimates.size(), kApart_m);
  for (Eigen::Index i = 0; i < d_m.rows(); ++i) {
    for (Eigen::Index j = 0; j < d_m.cols(); ++j) {
      if (truth[i].nuclide == estimates[j].nuclide) d_m(i, j) = (truth[i].p_W - estimates[j].p_W).norm();
    }
  }
  return d_m;
}

/// `cost` and beside it one column per row for "no estimate".
Eigen::MatrixXd with_none(const Eigen::MatrixXd& cost, double none) {
  Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(cost.rows(), cost.cols() + cost.rows(), none);
  wide.leftCols(cost.cols()) = cost;
  return wide;
}

double least_rmse_m(const Eigen::MatrixXd& d_m, double no_estimate_m) {
  const Eigen::MatrixXd cost = with_none(d_m.cwiseMin(no_estimate_m), no_estimate_m).array().square();
  const std::vector<int> column_of = assign_rows(cost);
  double sum_m2 = 0.0;
  for (Eigen::Index i = 0; i < cost.rows(); ++i) sum_m2 += cost(i, column_of[i]);
  return std::sqrt(sum_m2 / static_cast<double>(cost.rows()));
}

/// As many rows as possible get a column within the distance; among the ways to do so, that of the least squares.
std::vector<int> match_within(const Eigen::MatrixXd& d_m, double within_m) {
  const double rows = static_cast<double>(d_m.rows());
  const auto cost_of = [&](double d) { return d <= within_m ? d * d / (within_m * within_m * (rows + 1.0)) : 1.0; };
  std::vector<int> column_of = assign_rows(with_none(d_m.unaryExpr(cost_of), 1.0));
  for (Eigen::Index i = 0; i < d_m.rows(); ++i) {
    if (column_of[i] >= d_m.cols() || d_m(i, column_of[i]) > within_m) column_of[i] = -1;
  }
  return column_of;
}

int matched(const std::vector<int>& column_of) {
  return static_cast<int>(std::count_if(column_of.begin(), column_of.end(), [](int j) { return j >= 0; }));
}

double activity_error_rel(std::span<const PointSource> truth, std::span<const PointSource> estimates,
                          const std::vector<int>& found_by) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (found_by[i] < 0) continue;
    errors.push_back(std::abs(estimates[found_by[i]].activity_Bq - truth[i].activity_Bq) / truth[i].activity_Bq);
  }
  return median(errors);
}

}  // namespace

Localisation localise(std::span<const PointSource> truth, std::span<const PointSource> estimates,
                      double no_estimate_m) {
  Localisation result{.reported = static_cast<int>(estimates.size()),
                      .false_reports = static_cast<int>(estimates.size())};
  if (truth.empty()) return result;
  const Eigen::MatrixXd d_m = distances(truth, estimates);
  for (Eigen::Index i = 0; i < d_m.rows(); ++i) {
    const double nearest_m = estimates.empty() ? kApart_m : d_m.row(i).minCoeff();
    result.nearest_m.push_back(nearest_m < kApart_m ? nearest_m : no_estimate_m);
    result.rmse_nearest_m += result.nearest_m.back() * result.nearest_m.back() / static_cast<double>(truth.size());
  }
  result.rmse_nearest_m = std::sqrt(result.rmse_nearest_m);
  result.rmse_m = least_rmse_m(d_m, no_estimate_m);
  result.found_by = match_within(d_m, kFoundWithin_m);
  result.found_2m = matched(result.found_by);
  result.found_half_m = matched(match_within(d_m, 0.5));
  result.false_reports -= result.found_2m;
  result.activity_error_rel = activity_error_rel(truth, estimates, result.found_by);
  return result;
}

bool all_found_none_false(const Localisation& localisation) {
  return localisation.found_2m == static_cast<int>(localisation.nearest_m.size()) && localisation.false_reports == 0;
}

std::vector<PointSource> compared_estimates(const SourceReport& report, std::size_t n_true) {
  std::size_t n = report.sources.size();
  if (report.estimator == "mlem") n = std::min(n, n_true);
  std::vector<PointSource> estimates;
  for (std::size_t i = 0; i < n; ++i) {
    const SourceEstimate& source = report.sources[i];
    estimates.push_back({.p_W = source.p_W, .activity_Bq = source.activity_Bq, .nuclide = source.nuclide});
  }
  return estimates;
}

}  // namespace comptonaut
