// SPDX-License-Identifier: BSD-3-Clause
#include "bus/paced_publisher.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <system_error>

namespace comptonaut {
namespace {

constexpr std::size_t kMessagesAtOnce = 5;
constexpr long kPause_ns = 2'000'000;  // 2,500 messages a second

void arm(int timer) {
  const itimerspec once{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_nsec = kPause_ns}};
  if (timerfd_settime(timer, 0, &once, nullptr) < 0) {
    throw std::system_error(errno, std::generic_category(), "timerfd_settime");
  }
}

}  // namespace

PacedPublisher::PacedPublisher(EventLoop& loop, Bus& bus)
    : loop_(loop), bus_(bus), timer_(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK)) {
  if (timer_ < 0) throw std::system_error(errno, std::generic_category(), "timerfd_create");
  loop_.watch(timer_, [this] {
    std::uint64_t expirations = 0;
    if (read(timer_, &expirations, sizeof expirations) != sizeof expirations) return;
    send_some(kMessagesAtOnce);
    if (!waiting_.empty()) arm(timer_);
  });
}

PacedPublisher::~PacedPublisher() {
  loop_.unwatch(timer_);
  close(timer_);
  send_some(waiting_.size());
}

void PacedPublisher::push(const std::string& channel, Bytes bytes) {
  if (waiting_.empty()) arm(timer_);
  waiting_.emplace_back(channel, std::move(bytes));
}

void PacedPublisher::send_some(std::size_t at_most) {
  for (std::size_t i = 0; i < at_most && !waiting_.empty(); ++i) {
    bus_.publish_raw(waiting_.front().first, waiting_.front().second);
    waiting_.pop_front();
  }
}

}  // namespace comptonaut
