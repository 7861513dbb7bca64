// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "physics/specfile.h"

namespace comptonaut {

/// One subshell.
struct Shell {
  double binding_keV = 0.0;
  double electrons = 0.0;
};

/// One K X-ray line: an electron falls from a higher shell into the hole in K.
struct XRayLine {
  double energy_keV = 0.0;
  double probability = 0.0;  ///< per hole in K; what is missing to 1 are Auger electrons
};

/// What transport needs to know about an element's electrons.
struct Atom {
  int z = 0;
  std::vector<Shell> shells;  ///< K first
  std::vector<XRayLine> k_x_rays;
  [[nodiscard]] double fluorescence_yield_k() const;
};

/// Binding energies and K X-rays of EADL97 (Cullen et al., UCRL-50400 vol. 30, 1991) in `folder`; subshells hold
/// 2j+1 electrons each, the outermost what is left. Throws std::runtime_error (file, reason).
[[nodiscard]] Atom load_atom(int z, const std::filesystem::path& folder = kFisxFolder);

}  // namespace comptonaut
