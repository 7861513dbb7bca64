// SPDX-License-Identifier: BSD-3-Clause
#include "input.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace comptonaut {

std::unique_ptr<Input> open_input(const std::string& what, const InputConfig& config, InputPorts ports) {
  if (what == "-") return open_standard_input(std::move(ports));
  if (what.starts_with("file:")) return open_playback(what.substr(5), config.speed, std::move(ports));
  if (what.starts_with("pipe:")) return open_named_pipe(what.substr(5), std::move(ports));
  int port = 0;
  const char* const end = what.data() + what.size();
  if (what.starts_with("tcp:")) {
    const auto [next, error] = std::from_chars(what.data() + 4, end, port);
    if (error == std::errc() && next == end && port > 0 && port < 65536) {
      return open_server(port, config.bind_address, std::move(ports));
    }
  }
  throw std::runtime_error(fmt::format("--input {}: must be tcp:PORT (1..65535), pipe:PATH, file:PATH or -", what));
}

}  // namespace comptonaut
