// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/packed_rows.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/simd.h"

namespace comptonaut {
namespace {

// Stored are the 5 low bits of a float's exponent and the 11 high bits of its mantissa, of the value times 2^-96.
// Moved to where float has them they are that number: unpacking takes a shift, no arithmetic.
constexpr int kShift = 12;
constexpr float kStored = 0x1p-96F, kLeast = 0x1p-29F;

/// A block as GCC's vectors, readable at any address.
using Halves = std::uint16_t __attribute__((vector_size(2 * kBlock), aligned(2), may_alias));
using Words = std::uint32_t __attribute__((vector_size(4 * kBlock), aligned(4), may_alias));
using Floats = float __attribute__((vector_size(4 * kBlock), aligned(4), may_alias));

[[gnu::always_inline]] inline void unpack(const std::uint16_t* stored, Floats& values) {
  values = reinterpret_cast<Floats>(__builtin_convertvector(*reinterpret_cast<const Halves*>(stored), Words) << kShift);
}

using Halves2 = std::uint16_t __attribute__((vector_size(4 * kBlock), aligned(2), may_alias));
using Words2 = std::uint32_t __attribute__((vector_size(8 * kBlock), aligned(4), may_alias));
[[gnu::always_inline]] inline void pack(const Floats& values, float least, float scale, Halves& stored) {
  const Floats small = values * (scale * kStored);
  const Words rounded = (reinterpret_cast<const Words&>(small) + (1U << (kShift - 1))) >> kShift;
  stored = __builtin_convertvector(reinterpret_cast<Words>(values >= least) & rounded, Halves);
}

[[gnu::always_inline]] inline bool is_zero(const Halves& stored) {
  using Longs = std::uint64_t __attribute__((vector_size(kBlock)));
  const Longs* its = reinterpret_cast<const Longs*>(&stored);
  const Longs all = its[0] | its[1];
  return (all[0] | all[1]) == 0;
}

[[gnu::always_inline]] inline double sum_of(const Floats& a, const Floats& b) {
  const Floats s = a + b;
  const float first = ((s[0] + s[8]) + (s[4] + s[12])) + ((s[2] + s[10]) + (s[6] + s[14]));
  const float second = ((s[1] + s[9]) + (s[5] + s[13])) + ((s[3] + s[11]) + (s[7] + s[15]));
  return static_cast<double>(first + second);
}

COMPTONAUT_SIMD_CLONES
std::size_t pack_blocks(const std::uint32_t* blocks, const float* values, std::size_t n, std::uint32_t first_block,
                        float cut, float scale, std::uint16_t* to_blocks, std::uint16_t* to_values) {
  std::size_t packed = 0;
  const float least = cut > kLeast / scale ? cut : kLeast / scale;
  for (std::size_t b = 0; b < n; ++b) {
    Halves stored;
    pack(*reinterpret_cast<const Floats*>(values + b * kBlock), least, scale, stored);
    *reinterpret_cast<Halves*>(to_values + packed * kBlock) = stored;
    to_blocks[packed] = static_cast<std::uint16_t>(blocks[b] - first_block);
    packed += is_zero(stored) ? 0 : 1;
  }
  return packed;
}

}  // namespace

void append_packed(const std::uint32_t* blocks, const float* values, std::size_t n, std::uint32_t first_block,
                   float cut, float scale, PackedRows& rows) {
  const std::size_t before = rows.blocks.size();
  rows.blocks.resize(before + n);
  rows.values.resize((before + n) * kBlock);
  const std::size_t packed = pack_blocks(blocks, values, n, first_block, cut, scale, rows.blocks.data() + before,
                                         rows.values.data() + before * kBlock);
  rows.blocks.resize(before + packed);
  rows.values.resize((before + packed) * kBlock);
  rows.ends.push_back(static_cast<std::uint32_t>(rows.blocks.size()));
}

COMPTONAUT_SIMD_CLONES
float largest_of(const float* values, std::size_t n) {
  constexpr std::size_t kAtOnce = 4 * kBlock;
  std::array<std::int32_t, kAtOnce> largest{};  // floats that are not negative are ordered as their bits are
  const auto take = [&](std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto bits = std::bit_cast<std::int32_t>(values[first + i]);
      largest[i] = bits > largest[i] ? bits : largest[i];
    }
  };
  std::size_t i = 0;
  for (; i + kAtOnce <= n; i += kAtOnce) take(i, kAtOnce);
  for (; i < n; i += kBlock) take(i, kBlock);
  return std::bit_cast<float>(*std::max_element(largest.begin(), largest.end()));
}

COMPTONAUT_SIMD_CLONES
void packed_dots(const PackedRows& rows, std::size_t first, const float* lifted, double* sums, const PackedRows& next) {
  const std::uint32_t* ends = rows.ends.data();
  const std::uint16_t *blocks = rows.blocks.data(), *values = rows.values.data(), *ahead = next.values.data();
  std::size_t b = first == 0 ? 0 : ends[first - 1];
  const std::size_t n = rows.ends.size();
  for (std::size_t i = first; i < n; ++i) {
    Floats sum[4]{};
    const std::size_t end = ends[i];
    for (; b + 3 < end; b += 4) {
      __builtin_prefetch(ahead + b * kBlock, 0, 2);
      const Words2 t = __builtin_convertvector(*reinterpret_cast<const Halves2*>(values + b * kBlock), Words2)
                       << kShift;
      const Words2 w = __builtin_convertvector(*reinterpret_cast<const Halves2*>(values + (b + 2) * kBlock), Words2)
                       << kShift;
      sum[0] += reinterpret_cast<const Floats*>(&t)[0] * *reinterpret_cast<const Floats*>(lifted + blocks[b] * kBlock);
      sum[1] +=
          reinterpret_cast<const Floats*>(&t)[1] * *reinterpret_cast<const Floats*>(lifted + blocks[b + 1] * kBlock);
      sum[2] +=
          reinterpret_cast<const Floats*>(&w)[0] * *reinterpret_cast<const Floats*>(lifted + blocks[b + 2] * kBlock);
      sum[3] +=
          reinterpret_cast<const Floats*>(&w)[1] * *reinterpret_cast<const Floats*>(lifted + blocks[b + 3] * kBlock);
    }
    for (; b < end; ++b) {
      Floats t;
      unpack(values + b * kBlock, t);
      sum[0] += t * *reinterpret_cast<const Floats*>(lifted + blocks[b] * kBlock);
    }
    sums[i - first] += sum_of(sum[0] + sum[1], sum[2] + sum[3]);
  }
}

COMPTONAUT_SIMD_CLONES
void packed_spread(const PackedRows& rows, std::size_t first, const float* lifted, float* u, const PackedRows& next) {
  const std::uint32_t* ends = rows.ends.data();
  const std::uint16_t *blocks = rows.blocks.data(), *values = rows.values.data(), *ahead = next.values.data();
  std::size_t b = first == 0 ? 0 : ends[first - 1];
  const std::size_t n = rows.ends.size();
  for (std::size_t i = first; i < n; ++i) {
    const float y = lifted[i - first];
    const std::size_t end = ends[i];
    for (; b + 3 < end; b += 4) {
      __builtin_prefetch(ahead + (b + 2) * kBlock, 0, 2);
      const Words2 t = __builtin_convertvector(*reinterpret_cast<const Halves2*>(values + b * kBlock), Words2)
                       << kShift;
      const Words2 w = __builtin_convertvector(*reinterpret_cast<const Halves2*>(values + (b + 2) * kBlock), Words2)
                       << kShift;
      *reinterpret_cast<Floats*>(u + blocks[b] * kBlock) += reinterpret_cast<const Floats*>(&t)[0] * y;
      *reinterpret_cast<Floats*>(u + blocks[b + 1] * kBlock) += reinterpret_cast<const Floats*>(&t)[1] * y;
      *reinterpret_cast<Floats*>(u + blocks[b + 2] * kBlock) += reinterpret_cast<const Floats*>(&w)[0] * y;
      *reinterpret_cast<Floats*>(u + blocks[b + 3] * kBlock) += reinterpret_cast<const Floats*>(&w)[1] * y;
    }
    for (; b < end; ++b) {
      Floats t;
      unpack(values + b * kBlock, t);
      *reinterpret_cast<Floats*>(u + blocks[b] * kBlock) += t * y;
    }
  }
}

}  // namespace comptonaut
