// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "input.h"

namespace comptonaut {
namespace {

/// One stream of bytes after the other, each from a file descriptor of its own.
class StreamInput : public Input {
 public:
  explicit StreamInput(InputPorts ports) : ports_(std::move(ports)) {}
  ~StreamInput() override {
    if (fd_ >= 0) close(fd_);
  }

  void finish() override { close_stream(); }

 protected:
  void open_stream(int fd) {
    close_stream();
    fd_ = fd;
    first_bytes_ = true;
    ports_.loop.watch(fd, [this] { read_some(); });
  }

  void close_stream() {
    if (fd_ < 0) return;
    ports_.loop.unwatch(fd_);
    close(fd_);
    fd_ = -1;
    ports_.publish(ports_.reader.on_end());
  }

  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  virtual void on_closed() {}

  InputPorts ports_;

 private:
  void read_some() {
    const ssize_t count = read(fd_, buffer_.data(), buffer_.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count <= 0) {
      close_stream();
      return on_closed();
    }
    if (first_bytes_) ports_.reader.on_open({.arrival_utime = wall_clock_utime()});
    first_bytes_ = false;
    ports_.publish(ports_.reader.on_bytes(std::span(buffer_).first(static_cast<std::size_t>(count))));
  }

  int fd_ = -1;
  bool first_bytes_ = true;
  std::array<char, 65536> buffer_{};
};

class StandardInput : public StreamInput {
 public:
  explicit StandardInput(InputPorts ports) : StreamInput(std::move(ports)) { open_stream(dup(STDIN_FILENO)); }
  [[nodiscard]] std::string state() const override { return "reads standard input"; }

 private:
  void on_closed() override { ports_.loop.stop(); }
};

class Server : public StreamInput {
 public:
  Server(int listening_fd, InputPorts ports) : StreamInput(std::move(ports)), listening_fd_(listening_fd) {
    ports_.loop.watch(listening_fd_, [this] { accept_client(); });
  }
  ~Server() override {
    ports_.loop.unwatch(listening_fd_);
    close(listening_fd_);
  }
  [[nodiscard]] std::string state() const override { return is_open() ? "connected" : "waits for a connection"; }

 private:
  /// The newest client replaces the one before, which may be long dead without a word.
  void accept_client() {
    const int fd = accept4(listening_fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd >= 0) open_stream(fd);
  }

  int listening_fd_;
};

[[noreturn]] void refuse(const std::string& address, int port, const std::string& what) {
  throw std::runtime_error(fmt::format("--input tcp:{}: {}: {}", port, address, what));
}

}  // namespace

std::unique_ptr<Input> open_standard_input(InputPorts ports) {
  return std::make_unique<StandardInput>(std::move(ports));
}

std::unique_ptr<Input> open_server(int port, const std::string& bind_address, InputPorts ports) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, bind_address.c_str(), &address.sin_addr) != 1) {
    refuse(bind_address, port, "bind_address must be an IPv4 address");
  }
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), "socket");
  const int yes = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || listen(fd, 4) != 0) {
    const int error = errno;
    close(fd);
    refuse(bind_address, port, std::generic_category().message(error));
  }
  return std::make_unique<Server>(fd, std::move(ports));
}

}  // namespace comptonaut
