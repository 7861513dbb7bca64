// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/system_rows.h"

#include <algorithm>
#include <array>
#include <bit>

#include "radiation/simd.h"

namespace comptonaut {
namespace {

// A value is stored as the 5 low bits of a double's exponent and the 11 high bits of its mantissa. These 16 bits, moved
// to where double has them, are the value times 2^-993: unpacking takes a shift and a mask, no arithmetic. Factors are
// lifted by 2^500, so that products are the true ones times 2^-493, far from the ends of double's range.
constexpr int kShift = 41;
constexpr std::uint64_t kMask = std::uint64_t{0xffff} << kShift;
constexpr double kStored = 0x1p-993;
constexpr double kLift = 0x1p500;
constexpr double kUnlift = 0x1p493;

/// Four cells as GCC's vectors, readable at any address. A block's words hold its cells in four such groups, first
/// group in the low 16 bits.
constexpr std::size_t kLanes = 4;
static_assert(kBlock == 4 * kLanes);
using Words = std::uint64_t __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));
using Doubles = double __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));

std::uint64_t stored(float value) {
  if (value < 0x1p-29F) return 0;
  const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value) * kStored);
  const std::uint64_t to_even = (std::uint64_t{1} << (kShift - 1)) - 1 + ((bits >> kShift) & 1);
  return (bits + to_even) >> kShift;
}

void append_block(std::span<const float, kBlock> block, std::vector<std::uint64_t>& words) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    words.push_back(stored(block[k]) | stored(block[k + 4]) << 16 | stored(block[k + 8]) << 32 |
                    stored(block[k + 12]) << 48);
  }
}

SystemRows::Row compressed(std::span<const float> dense) {
  SystemRows::Row row;
  const auto blocks = static_cast<std::uint32_t>(dense.size() / kBlock);
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const std::span<const float, kBlock> block(dense.data() + b * kBlock, kBlock);
    if (std::all_of(block.begin(), block.end(), [](float t) { return t == 0.0F; })) continue;
    const bool goes_on = !row.runs.empty() && row.runs.back().first_block + row.runs.back().blocks == b;
    if (!goes_on) row.runs.push_back({.first_block = b, .blocks = 0});
    ++row.runs.back().blocks;
    append_block(block, row.words);
  }
  row.words.shrink_to_fit();
  return row;
}

std::vector<double> scaled(std::span<const double> values, double factor) {
  std::vector<double> result(values.begin(), values.end());
  for (double& value : result) value *= factor;
  return result;
}

/// sum_j t_j x_j / kUnlift for x lifted.
COMPTONAUT_SIMD_CLONES
double dot(const SystemRows::Row& row, const double* lifted) {
  Doubles sum0{}, sum1{}, sum2{}, sum3{};
  const std::uint64_t* words = row.words.data();
  for (const SystemRows::Run& run : row.runs) {
    const double* x = lifted + run.first_block * kBlock;
    for (std::uint32_t b = 0; b < run.blocks; ++b, words += kLanes, x += kBlock) {
      const Words w = *reinterpret_cast<const Words*>(words);
      const auto* group = reinterpret_cast<const Doubles*>(x);
      sum0 += reinterpret_cast<Doubles>((w << kShift) & kMask) * group[0];
      sum1 += reinterpret_cast<Doubles>((w << (kShift - 16)) & kMask) * group[1];
      sum2 += reinterpret_cast<Doubles>((w << (kShift - 32)) & kMask) * group[2];
      sum3 += reinterpret_cast<Doubles>((w >> (48 - kShift)) & kMask) * group[3];
    }
  }
  const Doubles sum = (sum0 + sum1) + (sum2 + sum3);
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/// update_j += t_j y / kUnlift for y lifted. Meanwhile `next`, the words that are read after it, is fetched to the
/// cache.
COMPTONAUT_SIMD_CLONES
void spread(const SystemRows::Row& row, double lifted, double* update, const std::uint64_t* next) {
  const std::uint64_t* words = row.words.data();
  for (const SystemRows::Run& run : row.runs) {
    double* u = update + run.first_block * kBlock;
    for (std::uint32_t b = 0; b < run.blocks; ++b, words += kLanes, next += kLanes, u += kBlock) {
      __builtin_prefetch(next);
      const Words w = *reinterpret_cast<const Words*>(words);
      auto* group = reinterpret_cast<Doubles*>(u);
      group[0] += reinterpret_cast<Doubles>((w << kShift) & kMask) * lifted;
      group[1] += reinterpret_cast<Doubles>((w << (kShift - 16)) & kMask) * lifted;
      group[2] += reinterpret_cast<Doubles>((w << (kShift - 32)) & kMask) * lifted;
      group[3] += reinterpret_cast<Doubles>((w >> (48 - kShift)) & kMask) * lifted;
    }
  }
}

/// A row is read for both projections while it is in the cache.
void spread_ratio(const SystemRows::Row& row, const SystemRows::Row& next, const double* lifted_lambda,
                  double* update) {
  const double sum = dot(row, lifted_lambda) * kUnlift;
  if (sum > 0.0) spread(row, kLift / sum, update, next.words.data());
}

}  // namespace

SystemRows::SystemRows(std::size_t cells)
    : cells_(cells), ones_(padded(cells), kLift), uniform_ratio_(padded(cells), 0.0) {}

bool SystemRows::add(std::span<const float> dense) {
  Row row = compressed(dense);
  if (!(dot(row, ones_.data()) > 0.0)) return false;
  spread_ratio(row, row, ones_.data(), uniform_ratio_.data());
  rows_.push_back(std::move(row));
  return true;
}

std::vector<double> SystemRows::uniform_ratio() const { return scaled(uniform_ratio_, kUnlift); }

std::vector<double> forward(const SystemRows& rows, std::span<const double> x) {
  const std::vector<double> lifted = scaled(x, kLift);
  std::vector<double> sums;
  for (const SystemRows::Row& row : rows.rows()) sums.push_back(dot(row, lifted.data()) * kUnlift);
  return sums;
}

std::vector<double> back(const SystemRows& rows, std::span<const double> y) {
  std::vector<double> update(padded(rows.cells()), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i)
    spread(rows.rows()[i], y[i] * kLift, update.data(), rows.rows()[i].words.data());
  return scaled(update, kUnlift);
}

std::vector<double> ratio_back(const SystemRows& rows, std::span<const double> lambda) {
  const std::vector<double> lifted = scaled(lambda, kLift);
  std::vector<double> update(lambda.size(), 0.0);
  const std::vector<SystemRows::Row>& all = rows.rows();
  for (std::size_t i = 0; i < all.size(); ++i) {
    spread_ratio(all[i], all[(i + 1) % all.size()], lifted.data(), update.data());
  }
  return scaled(update, kUnlift);
}

}  // namespace comptonaut
