// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "stream_input.h"

namespace comptonaut {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw std::runtime_error(fmt::format("--input pipe:{}: {}", path, what));
}

/// Readable once a writer has come and written.
int open_pipe(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) refuse(path, std::generic_category().message(errno) + "; make it with: mkfifo " + path);
  struct stat status {};
  if (fstat(fd, &status) == 0 && S_ISFIFO(status.st_mode)) return fd;
  close(fd);
  refuse(path, "must be a named pipe, as mkfifo makes one; file:PATH plays a recording");
}

/// When a writer goes away the stream ends, and the pipe waits for the next one. That is opened before the old one is
/// closed, so that what a quick writer has already put in is not lost.
class NamedPipe : public StreamInput {
 public:
  NamedPipe(const std::string& path, InputPorts ports) : StreamInput(std::move(ports)), path_(path) {
    open_stream(open_pipe(path_));
  }
  [[nodiscard]] std::string state() const override { return has_begun() ? "reads the pipe" : "waits for a writer"; }

 private:
  [[nodiscard]] int next_stream() override { return open_pipe(path_); }

  std::string path_;
};

}  // namespace

std::unique_ptr<Input> open_named_pipe(const std::string& path, InputPorts ports) {
  return std::make_unique<NamedPipe>(path, std::move(ports));
}

}  // namespace comptonaut
