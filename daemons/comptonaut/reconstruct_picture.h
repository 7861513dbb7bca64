// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "core/cells.h"
#include "radiation/reconstruction.h"

namespace comptonaut {

/// The map of activity with the sources on it, each with its 95 % ellipse where the estimator tells, as PNG or SVG by
/// the file's name; nothing where the name is empty.
void write_map_picture(const std::filesystem::path& file, const Cells& cells, const Reconstruction& result);

}  // namespace comptonaut
