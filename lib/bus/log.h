// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "core/time.h"

namespace comptonaut {

/// One message of an lcm-logger recording.
struct LogEvent {
  Utime logged_utime = 0;  ///< when the logger got it, not when the thing happened
  std::string channel;
  std::span<const std::uint8_t> bytes;
};

/// Calls `handler` for each message in the order of the recording. A last event that is cut short is left out.
/// Throws std::runtime_error that names the file where it cannot be opened or holds no event.
void read_log(const std::filesystem::path& file, const std::function<void(const LogEvent&)>& handler);

}  // namespace comptonaut
