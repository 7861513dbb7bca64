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
double Calibration::Inverse::energy_keV(double tot) const {
  const double x = tot - double{b_plus_at}, root = std::sqrt(x * x + double{ac4});
  const double energy_keV = (tot - double{b_minus_at} + root) * double{half_per_a};
  return root >= -x && energy_keV > 0.0 ? energy_keV : 0.0;
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
    const double largest_keV = inverse.energy_keV(kSaturatedTot);
    // Energies grow with ToT: where the largest has none, none has.
    masked_[i] = !(a > 0.0 && largest_keV > 0.0 && std::isfinite(largest_keV));
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
  const double energy_keV = tot == 0 ? 0.0 : inverse_[pixel].energy_keV(tot);
  return energy_keV > 0.0 ? std::optional(energy_keV) : std::nullopt;
}

void Calibration::energies_keV(std::span<const Hit> hits, std::span<double> energies_keV) const {
  constexpr std::size_t kAhead = 48;  // the table is larger than the nearest caches
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Hit& hit = hits[i];
    if (i + kAhead < hits.size()) __builtin_prefetch(&inverse_[hits[i + kAhead].pixel]);
    const double energy_keV = inverse_[hit.pixel].energy_keV(hit.tot);
    energies_keV[i] = hit.energy_keV > 0.0F ? static_cast<double>(hit.energy_keV) : hit.tot == 0 ? 0.0 : energy_keV;
  }
}

std::uint16_t Calibration::tot(std::uint16_t pixel, double energy_keV) const {
  const PixelCalibration& p = pixels_[pixel];
  if (masked_[pixel] || !(energy_keV > p.t)) return 0;
  const double ticks = p.a * energy_keV + p.b - p.c / (energy_keV - p.t);
  return static_cast<std::uint16_t>(std::lround(std::clamp(ticks, 0.0, static_cast<double>(kSaturatedTot))));
}

}  // namespace comptonaut
