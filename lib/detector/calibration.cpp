// SPDX-License-Identifier: BSD-3-Clause
#include "detector/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace comptonaut {
namespace {

[[noreturn]] void refuse(const std::string& file, int line, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file, line, what));
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; }

/// Appends the numbers of one line; false where something is not a number.
bool read_numbers(std::string_view line, std::vector<double>& values) {
  while (true) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (line.empty()) return true;
    const char* end = line.data() + line.size();
    const auto [next, error] = std::from_chars(line.data(), end, values.emplace_back());
    if (error != std::errc() || (next != end && !is_blank(*next))) return false;
    line.remove_prefix(static_cast<std::size_t>(next - line.data()));
  }
}

std::vector<double> load_matrix(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read; a calibration is a.txt b.txt c.txt t.txt", file.string()));
  }
  return read_calibration_matrix(in, file.string());
}

}  // namespace

std::vector<double> read_calibration_matrix(std::istream& in, const std::string& file) {
  std::vector<double> values;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::size_t before = values.size();
    if (!read_numbers(line, values)) refuse(file, number, "must hold numbers only");
    const std::size_t columns = values.size() - before;
    if (columns == 0) continue;
    if (columns != kChipPixels) refuse(file, number, fmt::format("{} numbers; must be {}", columns, kChipPixels));
    if (values.size() > Calibration::kPixels) refuse(file, number, fmt::format("more than {} rows", kChipPixels));
  }
  if (values.size() < Calibration::kPixels) {
    refuse(file, number, fmt::format("{} rows; must be {}", values.size() / kChipPixels, kChipPixels));
  }
  return values;
}

/// The root of a E^2 + B E + C = 0 with B = b - a t - ToT, C = t ToT - b t - c, on the branch above the pole t. It is
///   E = (ToT - b + a t + sqrt((ToT - b - a t)^2 + 4 a c)) / (2 a),
/// and E >= t where that square root is at least b + a t - ToT. Not a number where there is no real root: no comparison
/// with it holds.
float Calibration::Inverse::energy_keV(float tot) const {
  const float x = tot - b_plus_at, root = std::sqrt(x * x + ac4);
  const float energy_keV = (tot - b_minus_at + root) * half_per_a;
  return root >= -x && energy_keV > 0.0F && tot > 0.0F ? energy_keV : 0.0F;
}

/// The energies of four hits, the same bits as of one after another.
inline void Calibration::four_energies_keV(const Hit* hits, double* energies_keV) const {
  using Floats = float __attribute__((vector_size(16), may_alias));
  using Doubles = double __attribute__((vector_size(32), aligned(8), may_alias));
  const auto inverse = [&](std::size_t i) { return reinterpret_cast<const Floats&>(inverse_[hits[i].pixel]); };
  const Floats first = inverse(0), second = inverse(1), third = inverse(2), fourth = inverse(3);
  const Floats b_of_two = __builtin_shufflevector(first, second, 0, 4, 1, 5);
  const Floats b_of_others = __builtin_shufflevector(third, fourth, 0, 4, 1, 5);
  const Floats ac_of_two = __builtin_shufflevector(first, second, 2, 6, 3, 7);
  const Floats ac_of_others = __builtin_shufflevector(third, fourth, 2, 6, 3, 7);
  const Floats b_minus_at = __builtin_shufflevector(b_of_two, b_of_others, 0, 1, 4, 5);
  const Floats b_plus_at = __builtin_shufflevector(b_of_two, b_of_others, 2, 3, 6, 7);
  const Floats ac4 = __builtin_shufflevector(ac_of_two, ac_of_others, 0, 1, 4, 5);
  const Floats half_per_a = __builtin_shufflevector(ac_of_two, ac_of_others, 2, 3, 6, 7);

  const Floats tot{float(hits[0].tot), float(hits[1].tot), float(hits[2].tot), float(hits[3].tot)}, zero{};
  const Floats given_keV{hits[0].energy_keV, hits[1].energy_keV, hits[2].energy_keV, hits[3].energy_keV};
  const Floats x = tot - b_plus_at, square = x * x + ac4;
  const Floats root{std::sqrt(square[0]), std::sqrt(square[1]), std::sqrt(square[2]), std::sqrt(square[3])};
  const Floats energy_keV = (tot - b_minus_at + root) * half_per_a;
  const Floats measured_keV = (root >= -x) & (energy_keV > zero) & (tot > zero) ? energy_keV : zero;
  const Floats all_keV = given_keV > zero ? given_keV : measured_keV;
  reinterpret_cast<Doubles&>(*energies_keV) = __builtin_convertvector(all_keV, Doubles);
}

Calibration::Calibration(std::vector<PixelCalibration> pixels)
    : pixels_(std::move(pixels)), inverse_(pixels_.size()), masked_(pixels_.size()) {
  if (pixels_.size() != kPixels) {
    throw std::invalid_argument(fmt::format("calibration of {} pixels; must be {}", pixels_.size(), kPixels));
  }
  for (std::size_t i = 0; i < kPixels; ++i) {
    const auto& [a, b, c, t] = pixels_[i];
    const Inverse inverse{.b_minus_at = static_cast<float>(b - a * t),
                          .b_plus_at = static_cast<float>(b + a * t),
                          .ac4 = static_cast<float>(4.0 * a * c),
                          .half_per_a = static_cast<float>(0.5 / a)};
    const float largest_keV = inverse.energy_keV(kSaturatedTot);
    // Energies grow with ToT: where the largest has none, none has.
    masked_[i] = !(a > 0.0 && largest_keV > 0.0F && std::isfinite(largest_keV));
    masked_pixels_ += masked_[i] ? 1 : 0;
    if (!masked_[i]) inverse_[i] = inverse;
  }
}

Calibration Calibration::load(const std::filesystem::path& folder) {
  const auto a = load_matrix(folder / "a.txt");
  const auto b = load_matrix(folder / "b.txt");
  const auto c = load_matrix(folder / "c.txt");
  const auto t = load_matrix(folder / "t.txt");
  std::vector<PixelCalibration> pixels(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) pixels[i] = {.a = a[i], .b = b[i], .c = c[i], .t = t[i]};
  Calibration calibration(std::move(pixels));
  if (calibration.masked_pixels() == static_cast<int>(kPixels)) {
    throw std::runtime_error(fmt::format("{}: no pixel has a valid calibration", folder.string()));
  }
  return calibration;
}

Calibration Calibration::uniform(const PixelCalibration& pixel) {
  return Calibration(std::vector<PixelCalibration>(kPixels, pixel));
}

std::optional<double> Calibration::energy_keV(std::uint16_t pixel, std::uint16_t tot) const {
  const float energy_keV = inverse_[pixel].energy_keV(tot);
  return energy_keV > 0.0F ? std::optional<double>(energy_keV) : std::nullopt;
}

void Calibration::energies_keV(std::span<const Hit> hits, std::span<double> energies_keV) const {
  constexpr std::size_t kAhead = 48;  // the table is larger than the nearest caches
  constexpr std::size_t kFour = 4;
  std::size_t i = 0;
  for (; i + kAhead + kFour <= hits.size(); i += kFour) {
    for (std::size_t k = 0; k < kFour; ++k) __builtin_prefetch(&inverse_[hits[i + kAhead + k].pixel]);
    four_energies_keV(&hits[i], &energies_keV[i]);
  }
  for (; i < hits.size(); ++i) {
    const Hit& hit = hits[i];
    energies_keV[i] = hit.energy_keV > 0.0F ? hit.energy_keV : inverse_[hit.pixel].energy_keV(hit.tot);
  }
}

std::uint16_t Calibration::tot(std::uint16_t pixel, double energy_keV) const {
  const PixelCalibration& p = pixels_[pixel];
  if (masked_[pixel] || !(energy_keV > p.t)) return 0;
  const double ticks = p.a * energy_keV + p.b - p.c / (energy_keV - p.t);
  return static_cast<std::uint16_t>(std::lround(std::clamp(ticks, 0.0, static_cast<double>(kSaturatedTot))));
}

}  // namespace comptonaut
