// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/daemon.h"
#include "nodes/detector_reader.h"

namespace comptonaut {

/// Brings bytes of a detector into the reader and its batches out, on the loop's thread.
class Input {
 public:
  virtual ~Input() = default;
  /// In words, for the status.
  [[nodiscard]] virtual std::string state() const = 0;
  /// The daemon ends: everything that came leaves.
  virtual void finish() = 0;
};

/// What an input works with; all must outlive it.
struct InputPorts {
  EventLoop& loop;
  DetectorReader& reader;
  std::function<void(const std::vector<EventBatch>&)> publish;
  std::function<double()> now_s;  ///< monotonic
};

/// `what` is tcp:PORT (a server socket; one client at a time, the newest), pipe:PATH (a named pipe; one writer after
/// the other), - (standard input) or file:PATH (a recording with its side file, played at the pace of its stamps).
/// Throws std::runtime_error that names what is wrong.
[[nodiscard]] std::unique_ptr<Input> open_input(const std::string& what, const InputConfig& config, InputPorts ports);

/// The kinds of it.
[[nodiscard]] std::unique_ptr<Input> open_server(int port, const std::string& bind_address, InputPorts ports);
[[nodiscard]] std::unique_ptr<Input> open_named_pipe(const std::string& path, InputPorts ports);
[[nodiscard]] std::unique_ptr<Input> open_standard_input(InputPorts ports);
[[nodiscard]] std::unique_ptr<Input> open_playback(const std::string& path, double speed, InputPorts ports);

}  // namespace comptonaut
