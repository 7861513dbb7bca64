// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "input.h"

namespace comptonaut {

/// One stream of bytes after the other, each from a file descriptor of its own. While nothing comes from one, the
/// reader is told of the silence, so that what is certain leaves.
class StreamInput : public Input {
 public:
  explicit StreamInput(InputPorts ports);
  ~StreamInput() override;

  void finish() override { close_stream(); }

 protected:
  /// Takes the descriptor, in place of the one before.
  void open_stream(int fd);
  void close_stream();

  /// Bytes have come from the stream that is open.
  [[nodiscard]] bool has_begun() const { return fd_ >= 0 && newest_s_ > 0.0; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  /// The stream has ended: what to read now, -1: nothing yet.
  [[nodiscard]] virtual int next_stream() { return -1; }

  InputPorts ports_;

 private:
  void read_some();
  void tell_silence();

  int fd_ = -1;
  double newest_s_ = 0.0;  ///< when the newest bytes of this stream came, monotonic; 0: none yet
  std::array<char, 65536> buffer_{};
};

}  // namespace comptonaut
