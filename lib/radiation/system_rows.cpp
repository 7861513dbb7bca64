// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/system_rows.h"

#include <algorithm>
#include <cmath>

namespace comptonaut {
namespace {

/// Rows that are summed in single precision.
constexpr int kFewRows = 64;
/// Ratios are lifted less, since rows may be hardly reached: down to 1e-30 their reciprocals fit a float.
constexpr double kRatioLift = 0x1p20;
constexpr double kHardly = 1e-30;

/// A power of two that brings the largest of `values` to 1 or a little below.
double brought_to_one(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest > 0.0 ? std::exp2(-1 - std::ilogb(largest)) : 1.0;
}

std::vector<float> lifted(std::span<const double> values, double scale) {
  std::vector<float> result(values.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<float>(values[i] * scale * kLift);
  return result;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

/// A row is read for both projections while it is in the cache.
void spread_ratio(const PackedRow& row, const PackedRow& next, const float* lambda, BackSum& update) {
  const double sum = packed_dot(row, lambda);
  if (sum > kHardly) packed_spread(row, static_cast<float>(kRatioLift / sum), update.next_row(), next);
}

}  // namespace

float* BackSum::next_row() {
  if (rows_++ % kFewRows == 0) {
    for (std::size_t j = 0; j < all_.size(); ++j) {
      all_[j] += static_cast<double>(few_[j]);
      few_[j] = 0.0F;
    }
  }
  return few_.data();
}

std::vector<double> BackSum::total() const {
  std::vector<double> sum = all_;
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += static_cast<double>(few_[j]);
  return sum;
}

SystemRows::SystemRows(std::size_t cells)
    : cells_(cells), ones_(padded(cells), static_cast<float>(0.5 * kLift)), uniform_ratio_(padded(cells)) {}

bool SystemRows::add(std::span<const float> dense) {
  PackedRow row = pack(dense);
  if (!(packed_dot(row, ones_.data()) > 0.0)) return false;
  spread_ratio(row, row, ones_.data(), uniform_ratio_);
  rows_.push_back(std::move(row));
  return true;
}

std::vector<double> SystemRows::uniform_ratio() const {
  return scaled(uniform_ratio_.total(), 0.5 * kLift / kRatioLift);
}

std::vector<double> forward(const SystemRows& rows, std::span<const double> x) {
  const double scale = brought_to_one(x);
  const std::vector<float> from = lifted(x, scale);
  std::vector<double> sums;
  for (const PackedRow& row : rows.rows()) sums.push_back(packed_dot(row, from.data()) / scale);
  return sums;
}

std::vector<double> back(const SystemRows& rows, std::span<const double> y) {
  const double scale = brought_to_one(y);
  BackSum update(padded(rows.cells()));
  for (std::size_t i = 0; i < y.size(); ++i) {
    const PackedRow& row = rows.rows()[i];
    packed_spread(row, static_cast<float>(y[i] * scale * kLift), update.next_row(), row);
  }
  return scaled(update.total(), 1.0 / scale);
}

std::vector<double> ratio_back(const SystemRows& rows, std::span<const double> lambda) {
  const double scale = brought_to_one(lambda);
  const std::vector<float> from = lifted(lambda, scale);
  BackSum update(lambda.size());
  const std::vector<PackedRow>& all = rows.rows();
  for (std::size_t i = 0; i < all.size(); ++i) spread_ratio(all[i], all[(i + 1) % all.size()], from.data(), update);
  return scaled(update.total(), scale * kLift / kRatioLift);
}

}  // namespace comptonaut
