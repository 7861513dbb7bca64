// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "stream_input.h"

namespace comptonaut {
namespace {

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
