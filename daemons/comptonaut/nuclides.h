// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "detector/nuclide.h"

namespace comptonaut {

/// The nuclide of a file, or by its name (Cs-137, in letters of any size) of those that come with Comptonaut: in
/// config/nuclides of the sources that the program was built of, or /etc/comptonaut/nuclides of an installed one.
/// Throws std::runtime_error that names those that there are.
[[nodiscard]] NuclideChannel find_nuclide(const std::string& name_or_file);

/// All that come with Comptonaut, by name; none where they are not found.
[[nodiscard]] std::vector<NuclideChannel> known_nuclides();

/// As names of nuclides are compared and their files named: Cs-137 -> cs-137.
[[nodiscard]] std::string lower_case(std::string text);

}  // namespace comptonaut
