// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/packed_row.h"

#include "radiation/simd.h"

namespace comptonaut {
namespace {

// Stored are the 5 low bits of a float's exponent and the 11 high bits of its mantissa, of the value times 2^-96.
// Moved to where float has them they are that number: unpacking takes a shift and a mask, no arithmetic.
constexpr int kShift = 12;
constexpr std::uint32_t kMask = 0xffffU << kShift;
constexpr float kStored = 0x1p-96F;

/// Half a block as GCC's vectors, readable at any address. A word holds a cell of the first half in its low bits and
/// the one of the second half in its high bits.
constexpr std::size_t kHalf = kBlock / 2;
using Halves = std::uint32_t __attribute__((vector_size(4 * kHalf), aligned(4), may_alias));
using Floats = float __attribute__((vector_size(4 * kHalf), aligned(4), may_alias));

/// Numbers of the blocks that are not all zeros; returns how many.
COMPTONAUT_SIMD_CLONES
std::size_t find_blocks(const float* dense, std::size_t n, std::uint32_t* blocks) {
  std::size_t found = 0;
  for (std::size_t b = 0; b < n; ++b) {
    const auto* half = reinterpret_cast<const Halves*>(dense + b * kBlock);
    const Halves any = half[0] | half[1];
    blocks[found] = static_cast<std::uint32_t>(b);
    found += ((any[0] | any[1] | any[2] | any[3]) | (any[4] | any[5] | any[6] | any[7])) != 0 ? 1 : 0;
  }
  return found;
}

[[gnu::always_inline]] inline void round_half(const Floats& values, Halves& low_bits) {
  const Floats stored = values * kStored;
  const Halves bits = reinterpret_cast<const Halves&>(stored);
  const Halves rounded = (bits + (((bits >> kShift) & 1) + ((1U << (kShift - 1)) - 1))) >> kShift;
  low_bits = reinterpret_cast<Halves>(values >= 0x1p-29F) & rounded;
}

COMPTONAUT_SIMD_CLONES
void pack_blocks(const float* dense, const std::vector<std::uint32_t>& blocks, std::uint32_t* words) {
  for (const std::uint32_t b : blocks) {
    const auto* half = reinterpret_cast<const Floats*>(dense + b * kBlock);
    Halves low, high;
    round_half(half[0], low);
    round_half(half[1], high);
    *reinterpret_cast<Halves*>(words) = low | (high << 16);
    words += kHalf;
  }
}

}  // namespace

PackedRow pack(std::span<const float> dense) {
  PackedRow row;
  std::vector<std::uint32_t> blocks(dense.size() / kBlock);
  blocks.resize(find_blocks(dense.data(), blocks.size(), blocks.data()));
  row.blocks = blocks;
  row.words.resize(blocks.size() * kWordsPerBlock);
  pack_blocks(dense.data(), row.blocks, row.words.data());
  return row;
}

COMPTONAUT_SIMD_CLONES
double packed_dot(const PackedRow& row, const float* lifted) {
  Floats low[2]{}, high[2]{};
  const std::uint32_t *words = row.words.data(), *blocks = row.blocks.data();
  const std::size_t n = row.blocks.size();
  for (std::size_t b = 0; b < n; ++b, words += kHalf) {
    const Halves w = *reinterpret_cast<const Halves*>(words);
    const auto* x = reinterpret_cast<const Floats*>(lifted + blocks[b] * kBlock);
    low[0] += reinterpret_cast<Floats>((w << kShift) & kMask) * x[0];
    high[0] += reinterpret_cast<Floats>((w >> (16 - kShift)) & kMask) * x[1];
    if (++b == n) break;
    words += kHalf;
    const Halves v = *reinterpret_cast<const Halves*>(words);
    const auto* y = reinterpret_cast<const Floats*>(lifted + blocks[b] * kBlock);
    low[1] += reinterpret_cast<Floats>((v << kShift) & kMask) * y[0];
    high[1] += reinterpret_cast<Floats>((v >> (16 - kShift)) & kMask) * y[1];
  }
  const Floats sum = (low[0] + high[0]) + (low[1] + high[1]);
  return static_cast<double>(((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7])));
}

COMPTONAUT_SIMD_CLONES
void packed_spread(const PackedRow& row, float lifted, float* u, const PackedRow& next) {
  const std::uint32_t *words = row.words.data(), *blocks = row.blocks.data(), *ahead = next.words.data();
  const std::size_t n = row.blocks.size();
  for (std::size_t b = 0; b < n; ++b, words += kHalf, ahead += kHalf) {
    __builtin_prefetch(ahead);
    const Halves w = *reinterpret_cast<const Halves*>(words);
    auto* half = reinterpret_cast<Floats*>(u + blocks[b] * kBlock);
    half[0] += reinterpret_cast<Floats>((w << kShift) & kMask) * lifted;
    half[1] += reinterpret_cast<Floats>((w >> (16 - kShift)) & kMask) * lifted;
  }
}

}  // namespace comptonaut
