// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "physics/specfile.h"

namespace comptonaut {

/// Ways in which a photon interacts.
enum class Process { kRayleigh, kCompton, kPhotoelectric, kPair };
inline constexpr std::size_t kProcesses = 4;

/// One number per process, in the order of Process.
struct Coefficients {
  std::array<double, kProcesses> value{};

  [[nodiscard]] double of(Process process) const { return value[static_cast<std::size_t>(process)]; }
  [[nodiscard]] double total() const { return value[0] + value[1] + value[2] + value[3]; }
};

/// Mass attenuation coefficients of one element, cm^2/g, from NIST's XCOM (Berger and Hubbell 1987), interpolated
/// log-log between its energies. At an absorption edge XCOM lists the energy twice; the edge itself counts as above.
/// Relative error of XCOM: 1 to 2 % between 30 keV and 3 MeV; of the interpolation, below 1e-3 there.
class CrossSections {
 public:
  /// Throws std::runtime_error (file, line, reason) if the file is not readable or malformed.
  static CrossSections load(int z, const std::filesystem::path& folder = kFisxFolder);

  /// Throws std::invalid_argument outside the table, 0.1 keV to 100 GeV.
  [[nodiscard]] Coefficients at(double energy_keV) const;

  /// Share of photoelectric absorptions above the K edge that take place in the K shell, from the jump at the edge.
  [[nodiscard]] double k_shell_share() const { return k_shell_share_; }
  [[nodiscard]] double k_edge_keV() const { return k_edge_keV_; }

 private:
  std::vector<double> energy_keV_;
  std::vector<Coefficients> cm2_g_;
  double k_edge_keV_ = 0.0;
  double k_shell_share_ = 0.0;
};

}  // namespace comptonaut
