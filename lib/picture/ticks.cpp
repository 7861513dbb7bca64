// SPDX-License-Identifier: BSD-3-Clause
#include "picture/ticks.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace comptonaut {
namespace {

constexpr double kRounding = 1e-9;  // of a step: an end that is meant to be a tick is one

double round_step(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1.0 - kRounding)) return factor * decade;
  }
  return 10.0 * decade;
}

std::string superscript(int number) {
  static const char* const kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number)) text += c == '-' ? "⁻" : kDigits[c - '0'];
  return text;
}

std::string label_of(int factor, int decade) {
  if (std::abs(decade) <= 3) return fmt::format("{:g}", factor * std::pow(10.0, decade));
  return (factor == 1 ? "" : std::to_string(factor) + "·") + "10" + superscript(decade);
}

std::vector<Tick> linear_ticks(const Axis& axis, int wanted) {
  const double step = round_step((axis.max - axis.min) / wanted);
  std::vector<Tick> ticks;
  for (double i = std::ceil(axis.min / step - kRounding); i * step <= axis.max + kRounding * step; ++i) {
    ticks.push_back({i * step, fmt::format("{:.10g}", i == 0.0 ? 0.0 : i * step)});
  }
  return ticks;
}

std::vector<Tick> logarithmic_ticks(const Axis& axis, int wanted) {
  const double low = std::log10(axis.min), high = std::log10(axis.max);
  const int every = std::max(1, static_cast<int>(std::ceil((high - low) / wanted)));
  const bool between = high - low < 2.5;
  std::vector<Tick> ticks;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high + kRounding; ++decade) {
    if (decade % every != 0) continue;
    for (const int factor : {1, 2, 5}) {
      const double at = decade + std::log10(factor);
      const bool inside = at >= low - kRounding && at <= high + kRounding;
      if (inside && (factor == 1 || between)) ticks.push_back({std::pow(10.0, at), label_of(factor, decade)});
    }
  }
  return ticks;
}

}  // namespace

std::vector<Tick> ticks(const Axis& axis, int wanted) {
  return axis.logarithmic ? logarithmic_ticks(axis, wanted) : linear_ticks(axis, wanted);
}

double share(const Axis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.min) / (axis.max - axis.min);
  if (value <= 0.0) return -std::numeric_limits<double>::infinity();
  return std::log(value / axis.min) / std::log(axis.max / axis.min);
}

}  // namespace comptonaut
