// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/time.h"

namespace comptonaut {

inline constexpr Utime kStart_us = 1'700'000'000 * kSecond_us;  ///< when what a test plays begins

}  // namespace comptonaut
