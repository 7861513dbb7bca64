// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace comptonaut {

struct Finished {
  int exit_code = -1;
  std::string output;  ///< of stdout and stderr together
};

/// Runs a line of shell to its end.
inline Finished run_command(const std::string& line) {
  Finished finished;
  FILE* pipe = popen((line + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return finished;
  std::array<char, 4096> part;
  while (const std::size_t n = fread(part.data(), 1, part.size(), pipe)) finished.output.append(part.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) finished.exit_code = WEXITSTATUS(status);
  return finished;
}

}  // namespace comptonaut
