// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "bus/log.h"
#include "report/mission_recorder.h"

namespace comptonaut {

/// Decodes one message by its channel and hands it to the recorder. What does not decode is counted there.
void record_event(MissionRecorder& recorder, const LogEvent& event);

/// The mission in an lcm-logger recording of the ground bus. Of a damaged file what stands before the damage; the
/// record says so. Throws std::runtime_error, one line that names the file, where it cannot be read or holds no message
/// of a mission.
[[nodiscard]] MissionRecord read_mission(const std::filesystem::path& log);

}  // namespace comptonaut
