// SPDX-License-Identifier: BSD-3-Clause
#include "search/open_questions.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/simd.h"

namespace comptonaut {
namespace {

constexpr std::size_t kLanes = View::kLanes;
using Floats = float __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));
/// Of a question that is answered for good: what is smaller makes arithmetic slow.
constexpr float kLeastOpen = 1e-30F;

/// exp(-x) for x >= 0, within 3e-6 of its value; 1e-35 or so beyond x = 80. As exp_minus_inline: 2^-n exp(r), exp(r) by
/// its series up to r^5.
[[gnu::always_inline]] inline float exp_minus(float x) {
  constexpr float kLog2E = 1.44269504F, kLn2High = 0.693359375F, kLn2Low = -2.12194440e-4F;
  constexpr float kRounder = 0x1.8p23F;  // adding it leaves the nearest whole number in the low bits
  x = x < 80.0F ? x : 80.0F;
  const float shifted = x * kLog2E + kRounder;
  const float n = shifted - kRounder;
  const float r = (n * kLn2High - x) + n * kLn2Low;
  float series = r * (1.0F / 120.0F) + 1.0F / 24.0F;
  series = series * r + 1.0F / 6.0F;
  series = series * r + 0.5F;
  series = series * r + 1.0F;
  series = series * r + 1.0F;
  const std::int32_t whole = std::bit_cast<std::int32_t>(shifted) - std::bit_cast<std::int32_t>(kRounder);
  return series * std::bit_cast<float>((127 - whole) << 23);
}

COMPTONAUT_SIMD_CLONES
void add_blocks(const std::uint32_t* blocks, const float* per_s, std::size_t n, float time_s, float* known) {
  for (std::size_t k = 0; k < n; ++k) {
    *reinterpret_cast<Floats*>(known + blocks[k]) += *reinterpret_cast<const Floats*>(per_s + k * kLanes) * time_s;
  }
}

COMPTONAUT_SIMD_CLONES
void answer_blocks(const float* __restrict__ known, const std::uint8_t* touched, std::size_t n,
                   float* __restrict__ open, float* __restrict__ sums) {
  for (std::size_t k = 0; k < n; ++k, known += kLanes, open += kLanes) {
    if (touched[k] == 0) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float left = open[lane] * exp_minus(known[lane]);
      const float kept = left > kLeastOpen ? left : kLeastOpen;
      sums[lane] += open[lane] - kept;
      open[lane] = kept;
    }
  }
}

}  // namespace

std::vector<View> views_of(const Eigen::ArrayXXf& per_s) {
  constexpr float kNothing_per_s = 5e-4F;
  constexpr auto kBlock = static_cast<Eigen::Index>(kLanes);
  std::vector<View> views(static_cast<std::size_t>(per_s.cols()));
  for (Eigen::Index i = 0; i < per_s.cols(); ++i) {
    View& view = views[static_cast<std::size_t>(i)];
    for (Eigen::Index first = 0; first < per_s.rows(); first += kBlock) {
      const auto block = per_s.col(i).segment(first, std::min(kBlock, per_s.rows() - first));
      if (block.maxCoeff() < kNothing_per_s) continue;
      view.blocks.push_back(static_cast<std::uint32_t>(first));
      view.per_s.insert(view.per_s.end(), block.begin(), block.end());
      view.per_s.resize(view.blocks.size() * kLanes, 0.0F);
    }
  }
  return views;
}

Eigen::ArrayXf open_weight(const Eigen::ArrayXf& weight, const Eigen::ArrayXf& known) {
  constexpr auto kBlock = static_cast<Eigen::Index>(kLanes);
  Eigen::ArrayXf open = Eigen::ArrayXf::Constant((weight.size() + kBlock - 1) / kBlock * kBlock, kLeastOpen);
  open.head(weight.size()) = (weight * (-known).exp()).max(kLeastOpen);
  return open;
}

void Looks::add(const View& view, double time_s) {
  add_blocks(view.blocks.data(), view.per_s.data(), view.blocks.size(), static_cast<float>(time_s), known_.data());
  for (const std::uint32_t first : view.blocks) touched_[first / kLanes] = 1;
}

double Looks::answer(Eigen::ArrayXf& open) const {
  std::array<float, kLanes> sums{};
  answer_blocks(known_.data(), touched_.data(), touched_.size(), open.data(), sums.data());
  double sum = 0.0;
  for (const float lane : sums) sum += static_cast<double>(lane);
  return sum;
}

}  // namespace comptonaut
