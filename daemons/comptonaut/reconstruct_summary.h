// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/cells.h"
#include "radiation/reconstruction.h"

namespace comptonaut {

/// What was measured, how far the estimator came, and its sources with their units, for people.
[[nodiscard]] std::string reconstruction_summary(const Cells& cells, const Reconstruction& result);

}  // namespace comptonaut
