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
/// Throws std::runtime_error that names the file where it cannot be opened, is damaged (with the byte) or holds no
/// event.
void read_log(const std::filesystem::path& file, const std::function<void(const LogEvent&)>& handler);

/// Writes a recording that lcm-logplayer and read_log read. An event that was appended survives the end of the process;
/// one that was synced survives a power cut.
class LogWriter {
 public:
  /// Makes the file's folder where it is missing; appends where the file exists. Throws std::runtime_error that names
  /// the file where it cannot be written.
  explicit LogWriter(const std::filesystem::path& file);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// False where the disk takes no more: the event is not in the file then, and those before it are.
  [[nodiscard]] bool append(const LogEvent& event);
  /// False where the disk did not confirm.
  bool sync();

 private:
  int fd_;
  std::int64_t events_ = 0;
  bool broken_ = false;  // ends in half an event that could not be taken back
};

}  // namespace comptonaut
