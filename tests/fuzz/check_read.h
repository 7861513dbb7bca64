// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "fuzz/targets.h"

namespace comptonaut {

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const char> bytes) : fd_(memfd_create("fuzz", MFD_CLOEXEC)) {
    require_law(write(fd_, bytes.data(), bytes.size()) == std::ssize(bytes), "memory takes what is written");
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

/// Reads, and lets pass what a reader says of wrong input: one line that begins with the file.
template <class Read>
void check_read(std::string_view file, Read&& read) {
  try {
    read();
  } catch (const std::runtime_error& e) {
    const std::string_view what = e.what();
    require_law(what.starts_with(file), "an error names the file");
    require_law(what.find('\n') == what.npos && what.size() < 600, "an error is one line");
  }
}

}  // namespace comptonaut
