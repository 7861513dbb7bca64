// SPDX-License-Identifier: BSD-3-Clause
#include "physics/cross_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr std::array<const char*, kProcesses> kColumns = {"Rayleigh(coherent)[cm2/g]", "Compton(incoherent)[cm2/g]",
                                                          "Photoelectric[cm2/g]", "PairProduction[cm2/g]"};

/// Between two entries; linear where one is zero (pair production at its threshold).
double log_log(double low, double high, double log_fraction, double linear_fraction) {
  if (low > 0.0 && high > 0.0) return low * std::pow(high / low, log_fraction);
  return low + (high - low) * linear_fraction;
}

}  // namespace

CrossSections CrossSections::load(int z, const std::filesystem::path& folder) {
  const SpecScan scan = read_spec_scan(folder / "XCOM_CrossSections.dat", z);
  const std::size_t energy_column = scan.column("PhotonEnergy[keV]");
  CrossSections result;
  for (const std::vector<double>& row : scan.rows) {
    const double energy_keV = row[energy_column];
    Coefficients cm2_g;
    for (std::size_t p = 0; p < kProcesses; ++p) cm2_g.value[p] = row[scan.column(kColumns[p])];
    const bool in_order = result.energy_keV_.empty() ? energy_keV > 0.0 : energy_keV >= result.energy_keV_.back();
    const auto negative = [](double value) { return !(value >= 0.0); };
    if (!in_order || std::any_of(cm2_g.value.begin(), cm2_g.value.end(), negative)) {
      throw std::runtime_error(fmt::format("{}: Z = {} at {} keV: energies must grow and no coefficient be negative",
                                           scan.file.string(), z, energy_keV));
    }
    const double below = result.cm2_g_.empty() ? 0.0 : result.cm2_g_.back().of(Process::kPhotoelectric);
    const double above = cm2_g.of(Process::kPhotoelectric);
    if (!result.energy_keV_.empty() && energy_keV == result.energy_keV_.back() && above > below) {
      result.k_edge_keV_ = energy_keV;  // the last edge upwards is that of the K shell
      result.k_shell_share_ = 1.0 - below / above;
    }
    result.energy_keV_.push_back(energy_keV);
    result.cm2_g_.push_back(cm2_g);
  }
  return result;
}

Coefficients CrossSections::at(double energy_keV) const {
  if (!(energy_keV >= energy_keV_.front() && energy_keV <= energy_keV_.back())) {
    throw std::invalid_argument(fmt::format("no cross sections at {} keV: they go from {} to {} keV", energy_keV,
                                            energy_keV_.front(), energy_keV_.back()));
  }
  const auto above = std::upper_bound(energy_keV_.begin(), energy_keV_.end() - 1, energy_keV);
  const auto i = static_cast<std::size_t>(above - energy_keV_.begin());
  const double low_keV = energy_keV_[i - 1], high_keV = energy_keV_[i];
  if (high_keV == low_keV) return cm2_g_[i];
  const double linear_fraction = (energy_keV - low_keV) / (high_keV - low_keV);
  const double log_fraction = std::log(energy_keV / low_keV) / std::log(high_keV / low_keV);
  Coefficients result;
  for (std::size_t p = 0; p < kProcesses; ++p) {
    result.value[p] = log_log(cm2_g_[i - 1].value[p], cm2_g_[i].value[p], log_fraction, linear_fraction);
  }
  return result;
}

}  // namespace comptonaut
