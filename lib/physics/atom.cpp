// SPDX-License-Identifier: BSD-3-Clause
#include "physics/atom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace comptonaut {
namespace {

/// The row of element z in a scan whose first column is Z.
const std::vector<double>& row_of(const SpecScan& scan, int z) {
  for (const std::vector<double>& row : scan.rows) {
    if (row.front() == z) return row;
  }
  throw std::runtime_error(fmt::format("{}: no row for Z = {}", scan.file.string(), z));
}

/// Electrons that fill a subshell, from EADL's name of it: "M5(3d5/2)" holds 2j + 1 = 6.
double capacity(const std::string& name, const std::filesystem::path& file) {
  const auto slash = name.find("/2)");
  if (slash == std::string::npos || slash == 0 || name[slash - 1] < '1' || name[slash - 1] > '9') {
    throw std::runtime_error(fmt::format("{}: '{}' names no subshell", file.string(), name));
  }
  return name[slash - 1] - '0' + 1.0;
}

std::vector<Shell> load_shells(int z, const std::filesystem::path& folder) {
  const SpecScan scan = read_spec_scan(folder / "EADL97_BindingEnergies.dat", 1);
  const std::vector<double>& row = row_of(scan, z);
  std::vector<Shell> shells;
  double left = z;
  for (std::size_t i = 1; i < row.size() && left > 0.0; ++i) {
    if (!(row[i] > 0.0)) continue;
    shells.push_back({.binding_keV = row[i], .electrons = std::min(left, capacity(scan.columns[i], scan.file))});
    left -= shells.back().electrons;
  }
  if (left > 0.0) throw std::runtime_error(fmt::format("{}: Z = {} lacks subshells", scan.file.string(), z));
  return shells;
}

std::vector<XRayLine> load_k_x_rays(int z, const std::filesystem::path& folder) {
  const SpecScan binding = read_spec_scan(folder / "EADL97_BindingEnergies.dat", 1);
  const SpecScan rates = read_spec_scan(folder / "EADL97_KShellRadiativeRates.dat", 1);
  const std::vector<double>& binding_row = row_of(binding, z);
  const std::vector<double>& rates_row = row_of(rates, z);
  std::vector<XRayLine> lines;
  for (const char* shell : {"L1", "L2", "L3", "M1", "M2", "M3", "M4", "M5", "N1", "N2", "N3", "N4", "N5", "O2", "O3"}) {
    const double probability = rates_row[rates.column(fmt::format("K{}", shell))];
    if (!(probability > 0.0)) continue;
    const auto named = [&](const std::string& column) { return column.starts_with(fmt::format("{}(", shell)); };
    const auto column = std::find_if(binding.columns.begin(), binding.columns.end(), named);
    if (column == binding.columns.end()) {
      throw std::runtime_error(fmt::format("{}: no column of shell {}", binding.file.string(), shell));
    }
    const double outer_keV = binding_row[static_cast<std::size_t>(column - binding.columns.begin())];
    lines.push_back({.energy_keV = binding_row[1] - outer_keV, .probability = probability});
  }
  return lines;
}

}  // namespace

double Atom::fluorescence_yield_k() const {
  double sum = 0.0;
  for (const XRayLine& line : k_x_rays) sum += line.probability;
  return sum;
}

Atom load_atom(int z, const std::filesystem::path& folder) {
  return {.z = z, .shells = load_shells(z, folder), .k_x_rays = load_k_x_rays(z, folder)};
}

}  // namespace comptonaut
