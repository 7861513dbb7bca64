// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace comptonaut {

/// A bar on stderr, written over at each call; for terminals only. Share in 0..1.
void show_progress(double share);
/// Takes the bar away again.
void hide_progress();

/// To be asked before minutes of work, not after them. An empty path is no file and right.
/// Throws std::runtime_error that names the file.
void require_writable(const std::filesystem::path& file);

/// The whole file. Throws std::runtime_error that names it where it cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// The whole file; none where the path is empty. Throws std::runtime_error that names it where it cannot be written.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace comptonaut
