// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/system_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/simd.h"

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

AlignedVector<float> lifted(std::span<const double> values, double scale) {
  AlignedVector<float> result(values.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<float>(values[i] * scale * kLift);
  return result;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

COMPTONAUT_SIMD_CLONES
void move_to(double* __restrict all, float* __restrict few, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    all[j] += static_cast<double>(few[j]);
    few[j] = 0.0F;
  }
}

std::size_t rows_of(const SystemRows::Tile& tile) { return tile.front().ends.size(); }

/// A tile's sums over cells, one per row, where they stand in `sums`.
void tile_dots(const SystemRows::Tile& tile, std::size_t first, const float* lifted, double* sums,
               const SystemRows::Tile& next) {
  for (std::size_t p = 0; p < tile.size(); ++p) packed_dots(tile[p], first, lifted + p * kPanelCells, sums, next[p]);
}

void tile_spread(const SystemRows::Tile& tile, std::size_t first, const float* lifted, float* u,
                 const SystemRows::Tile& next) {
  for (std::size_t p = 0; p < tile.size(); ++p) packed_spread(tile[p], first, lifted, u + p * kPanelCells, next[p]);
}

/// A tile's rows from `first` on are read for both projections while they are in the cache.
void spread_ratio(const SystemRows::Tile& tile, std::size_t first, const SystemRows::Tile& next, const float* lambda,
                  BackSum& update) {
  std::array<double, SystemRows::kTileRows> sums{};
  std::array<float, SystemRows::kTileRows> ratio{};
  const std::size_t n = rows_of(tile) - first;
  tile_dots(tile, first, lambda, sums.data(), next);
  for (std::size_t i = 0; i < n; ++i) ratio[i] = sums[i] > kHardly ? static_cast<float>(kRatioLift / sums[i]) : 0.0F;
  tile_spread(tile, first, ratio.data(), update.next_rows(n), next);
}

}  // namespace

float* BackSum::next_rows(std::size_t n) {
  if (rows_ % kFewRows == 0) move_to(all_.data(), few_.data(), all_.size());
  rows_ += n;
  return few_.data();
}

std::vector<double> BackSum::total() const {
  std::vector<double> sum = all_;
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += static_cast<double>(few_[j]);
  return sum;
}

SystemRows::SystemRows(std::size_t cells)
    : cells_(cells), ones_(padded(cells), static_cast<float>(0.5 * kLift)), uniform_ratio_(padded(cells)) {}

/// With room for as much as the last one holds.
SystemRows::Tile SystemRows::new_tile() const {
  Tile tile((cells_ + kPanelCells - 1) / kPanelCells);
  for (std::size_t p = 0; p < tile.size() && !tiles_.empty(); ++p) {
    const std::size_t blocks = tiles_.back()[p].blocks.size();
    tile[p].blocks.reserve(blocks + blocks / 8 + kPanelBlocks);
    tile[p].values.reserve((blocks + blocks / 8 + kPanelBlocks) * kBlock);
  }
  return tile;
}

bool SystemRows::add(const SparseRow& row, double row_cut) {
  const float largest = largest_of(row.values.data(), row.blocks.size() * kBlock);
  if (!(largest > 0.0F)) return false;
  if (size_ % kTileRows == 0) tiles_.push_back(new_tile());
  Tile& tile = tiles_.back();
  std::size_t at = 0;
  for (std::size_t p = 0; p < tile.size(); ++p) {
    const std::size_t first = at;
    const auto past = std::lower_bound(row.blocks.begin() + first, row.blocks.end(), (p + 1) * kPanelBlocks);
    at = static_cast<std::size_t>(past - row.blocks.begin());
    append_packed(&row.blocks[first], &row.values[first * kBlock], at - first,
                  static_cast<std::uint32_t>(p * kPanelBlocks), largest * static_cast<float>(row_cut), 1.0F / largest,
                  tile[p]);
  }
  spread_ratio(tile, size_++ % kTileRows, tile, ones_.data(), uniform_ratio_);
  return true;
}

std::vector<double> SystemRows::uniform_ratio() const {
  return scaled(uniform_ratio_.total(), 0.5 * kLift / kRatioLift);
}

std::vector<double> forward(const SystemRows& rows, std::span<const double> x) {
  const double scale = brought_to_one(x);
  const AlignedVector<float> from = lifted(x, scale);
  std::vector<double> sums(rows.size(), 0.0);
  for (std::size_t t = 0; t < rows.tiles().size(); ++t) {
    tile_dots(rows.tiles()[t], 0, from.data(), &sums[t * SystemRows::kTileRows], rows.tiles()[t]);
  }
  return scaled(std::move(sums), 1.0 / scale);
}

std::vector<double> back(const SystemRows& rows, std::span<const double> y) {
  const double scale = brought_to_one(y);
  const AlignedVector<float> from = lifted(y, scale);
  BackSum update(padded(rows.cells()));
  for (std::size_t t = 0; t < rows.tiles().size(); ++t) {
    const SystemRows::Tile& tile = rows.tiles()[t];
    tile_spread(tile, 0, &from[t * SystemRows::kTileRows], update.next_rows(rows_of(tile)), tile);
  }
  return scaled(update.total(), 1.0 / scale);
}

std::vector<double> ratio_back(const SystemRows& rows, std::span<const double> lambda) {
  const double scale = brought_to_one(lambda);
  const AlignedVector<float> from = lifted(lambda, scale);
  BackSum update(lambda.size());
  const std::vector<SystemRows::Tile>& all = rows.tiles();
  for (std::size_t t = 0; t < all.size(); ++t) spread_ratio(all[t], 0, all[(t + 1) % all.size()], from.data(), update);
  return scaled(update.total(), scale * kLift / kRatioLift);
}

}  // namespace comptonaut
