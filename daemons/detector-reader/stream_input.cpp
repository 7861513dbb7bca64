// SPDX-License-Identifier: BSD-3-Clause
#include "stream_input.h"

#include <unistd.h>

#include <cerrno>

namespace comptonaut {
namespace {

constexpr std::chrono::milliseconds kSilencePeriod{10};

class StandardInput : public StreamInput {
 public:
  explicit StandardInput(InputPorts ports) : StreamInput(std::move(ports)) { open_stream(dup(STDIN_FILENO)); }
  [[nodiscard]] std::string state() const override { return "reads standard input"; }

 private:
  [[nodiscard]] int next_stream() override {
    ports_.loop.stop();
    return -1;
  }
};

}  // namespace

StreamInput::StreamInput(InputPorts ports) : ports_(std::move(ports)) {
  ports_.loop.every(kSilencePeriod, [this] { tell_silence(); });
}

StreamInput::~StreamInput() {
  if (fd_ >= 0) close(fd_);
}

void StreamInput::open_stream(int fd) {
  close_stream();
  fd_ = fd;
  newest_s_ = 0.0;
  ports_.loop.watch(fd, [this] { read_some(); });
}

void StreamInput::close_stream() {
  if (fd_ < 0) return;
  ports_.loop.unwatch(fd_);
  close(fd_);
  fd_ = -1;
  ports_.publish(ports_.reader.on_end());
}

void StreamInput::read_some() {
  const ssize_t count = read(fd_, buffer_.data(), buffer_.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) {
    const int next = next_stream();
    close_stream();
    if (next >= 0) open_stream(next);
    return;
  }
  newest_s_ = ports_.now_s();
  ports_.publish(ports_.reader.on_bytes(std::span(buffer_).first(static_cast<std::size_t>(count)), wall_clock_utime()));
}

void StreamInput::tell_silence() {
  if (has_begun()) ports_.publish(ports_.reader.on_silence(1e3 * (ports_.now_s() - newest_s_)));
}

std::unique_ptr<Input> open_standard_input(InputPorts ports) {
  return std::make_unique<StandardInput>(std::move(ports));
}

}  // namespace comptonaut
