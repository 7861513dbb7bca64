// SPDX-License-Identifier: BSD-3-Clause
#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <map>
#include <stdexcept>
#include <system_error>

#include "bus/daemon.h"

namespace comptonaut {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMessagesPerTurn = 1000;                   // so that a busy bus does not starve the timers
constexpr std::chrono::milliseconds kDrainSilence{100};  // nothing came for so long: all has been handled
constexpr std::chrono::milliseconds kDrainAtMost{500};   // somebody never stops sending
constexpr std::chrono::milliseconds kPollForever{-1};

int checked(int fd, const char* what) {
  if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
  return fd;
}

/// Blocks the signals that end a daemon, in this thread and in those that it starts, and reads them from a descriptor.
int open_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return checked(signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK), "signalfd");
}

int open_timer(std::chrono::milliseconds period) {
  const int fd = checked(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK), "timerfd_create");
  const timespec interval{.tv_sec = period.count() / 1000, .tv_nsec = period.count() % 1000 * 1'000'000};
  const itimerspec spec{.it_interval = interval, .it_value = interval};
  checked(timerfd_settime(fd, 0, &spec, nullptr), "timerfd_settime");
  return fd;
}

/// True where something was read: a signal came, a timer ran out.
template <class Record>
bool read_record(int fd) {
  Record record;
  return read(fd, &record, sizeof record) == static_cast<ssize_t>(sizeof record);
}

}  // namespace

struct EventLoop::Impl {
  int signals = open_signals();
  bool stopping = false;
  std::map<int, std::function<void()>> watched;
  std::map<int, std::function<void()>> timers;

  /// Waits for what is readable of these descriptors.
  static std::vector<int> readable(const std::vector<int>& fds, std::chrono::milliseconds timeout) {
    std::vector<pollfd> polled;
    for (const int fd : fds) polled.push_back({.fd = fd, .events = POLLIN, .revents = 0});
    if (poll(polled.data(), polled.size(), static_cast<int>(timeout.count())) < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "poll");
    }
    std::vector<int> ready;
    for (const pollfd& p : polled) {
      if (p.revents != 0) ready.push_back(p.fd);
    }
    return ready;
  }

  [[nodiscard]] std::vector<int> watched_fds() const {
    std::vector<int> fds;
    for (const auto& [fd, action] : watched) fds.push_back(fd);
    return fds;
  }

  void dispatch(int fd) {
    if (fd == signals && read_record<signalfd_siginfo>(fd)) stopping = true;
    if (const auto timer = timers.find(fd); timer != timers.end() && read_record<std::uint64_t>(fd)) timer->second();
    // A copy: the action may unwatch itself.
    if (const auto found = watched.find(fd); found != watched.end()) std::function<void()>(found->second)();
  }

  void turn() {
    std::vector<int> fds = watched_fds();
    fds.push_back(signals);
    for (const auto& [fd, action] : timers) fds.push_back(fd);
    for (const int fd : readable(fds, kPollForever)) dispatch(fd);
  }

  void drain() {
    const auto deadline = Clock::now() + kDrainAtMost;
    while (Clock::now() < deadline) {
      const std::vector<int> ready = readable(watched_fds(), kDrainSilence);
      if (ready.empty()) return;
      for (const int fd : ready) dispatch(fd);
    }
  }
};

EventLoop::EventLoop() : impl_(std::make_unique<Impl>()) {}

EventLoop::~EventLoop() {
  close(impl_->signals);
  for (const auto& [fd, action] : impl_->timers) close(fd);
}

void EventLoop::watch(int fd, std::function<void()> on_readable) { impl_->watched[fd] = std::move(on_readable); }

void EventLoop::unwatch(int fd) { impl_->watched.erase(fd); }

void EventLoop::watch(Bus& bus, const std::function<void()>& then) {
  watch(bus.fd(), [&bus, then] {
    for (int i = 0; i < kMessagesPerTurn && bus.handle(0); ++i) {
    }
    if (then) then();
  });
}

void EventLoop::every(std::chrono::milliseconds period, std::function<void()> action) {
  if (period.count() <= 0) throw std::invalid_argument("a timer's period must be positive");
  impl_->timers[open_timer(period)] = std::move(action);
}

void EventLoop::run() {
  while (!impl_->stopping) impl_->turn();
  impl_->drain();
}

void EventLoop::stop() { impl_->stopping = true; }

}  // namespace comptonaut
