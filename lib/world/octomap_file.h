// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <filesystem>
#include <memory>

namespace comptonaut {

/// Reads a .bt or .ot file as octomap writes it, and checks it first: octomap itself descends without end into a file
/// that is cut short. Voxels of the result are free or occupied at full certainty, and merged where they can be.
/// Throws std::runtime_error that names the file and what is wrong with it.
[[nodiscard]] std::unique_ptr<octomap::OcTree> read_octomap(const std::filesystem::path& file);

}  // namespace comptonaut
