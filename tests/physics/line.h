// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace comptonaut {

inline constexpr double kLine_keV = 661.657;  ///< of Cs-137

}  // namespace comptonaut
