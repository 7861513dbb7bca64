// SPDX-License-Identifier: BSD-3-Clause
#include "bus/bus.h"

#include <fmt/core.h>
#include <lcm/lcm.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "team/multicast_socket.h"

namespace comptonaut {
namespace {

/// Messages that may wait per subscription. LCM's default of 30 drops the newest in silence; this holds some 2,000
/// messages a second, three drones ten times faster than real time, through a handler of ten seconds.
constexpr int kQueueMessages = 20'000;
constexpr long kSocketBuffer_bytes = 2 << 20;
constexpr std::int64_t kFailuresPrinted = 10;  // then they are only counted

/// The URL with a receive buffer of its own size where it names none: the kernel's default holds 0.1 s of a busy bus.
/// No more than the kernel grants, or LCM complains.
std::string with_receive_buffer(const std::string& url) {
  if (!url.starts_with("udpm://") || url.find("recv_buf_size") != std::string::npos) return url;
  long granted = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> granted;
  const char separator = url.find('?') == std::string::npos ? '?' : '&';
  return granted <= 0 ? url
                      : fmt::format("{}{}recv_buf_size={}", url, separator, std::min(granted, kSocketBuffer_bytes));
}

bool is_option(const std::string& option) {
  static const std::regex known("ttl=(0*([0-9]{1,2}|1[0-9]{2}|2[0-4][0-9]|25[0-5]))|recv_buf_size=[1-9][0-9]{0,8}");
  return std::regex_match(option, known);
}

/// liblcm tells what is wrong with a URL in words of its own on stderr, and opens a default bus where there is none.
void check_url(const std::string& lcm_url) {
  const auto refuse = [&](const std::string& what) {
    return std::runtime_error(
        fmt::format("LCM bus '{}': {}, for example udpm://239.255.76.67:7667?ttl=0", lcm_url, what));
  };
  std::istringstream parts(lcm_url);
  std::string address, option;
  std::getline(parts, address, '?');
  try {
    (void)parse_multicast_url(address);
  } catch (const std::invalid_argument&) {
    throw refuse("must be udpm://GROUP:PORT?ttl=N with an IPv4 multicast group and a port of 1 to 65535");
  }
  while (std::getline(parts, option, '&')) {
    if (!is_option(option)) {
      throw refuse(fmt::format("'{}' is not an option: ttl=0 to 255 or recv_buf_size=BYTES", option));
    }
  }
}

}  // namespace

struct Bus::Impl {
  lcm_t* lcm = nullptr;
  std::vector<std::unique_ptr<std::pair<Impl*, RawHandler>>> subscriptions;
  std::int64_t sent = 0;
  std::int64_t send_failures = 0;
  std::int64_t received = 0;
  std::int64_t handler_failures = 0;
  std::map<std::string, std::int64_t> refused;

  /// LCM calls it from C: nothing may be thrown through it.
  static void on_message(const lcm_recv_buf_t* buffer, const char* channel, void* subscription) {
    auto& [impl, handler] = *static_cast<std::pair<Impl*, RawHandler>*>(subscription);
    ++impl->received;
    try {
      handler(channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
    } catch (const std::exception& e) {
      ++impl->handler_failures;
      if (impl->handler_failures <= kFailuresPrinted) fmt::print(stderr, "message on {}: {}\n", channel, e.what());
    } catch (...) {
      ++impl->handler_failures;
    }
  }
};

Bus::Bus(const std::string& lcm_url) : impl_(std::make_unique<Impl>()) {
  check_url(lcm_url);
  impl_->lcm = lcm_create(with_receive_buffer(lcm_url).c_str());
  if (impl_->lcm == nullptr) {
    throw std::runtime_error(
        fmt::format("cannot open the LCM bus '{}': the network must have a multicast route", lcm_url));
  }
}

Bus::~Bus() { lcm_destroy(impl_->lcm); }

void Bus::publish_raw(const std::string& channel, std::span<const std::uint8_t> bytes) {
  const bool sent =
      lcm_publish(impl_->lcm, channel.c_str(), bytes.data(), static_cast<unsigned int>(bytes.size())) == 0;
  ++(sent ? impl_->sent : impl_->send_failures);
}

void Bus::subscribe_raw(const std::string& channel_regex, RawHandler handler) {
  impl_->subscriptions.push_back(std::make_unique<std::pair<Impl*, RawHandler>>(impl_.get(), std::move(handler)));
  lcm_subscription_t* subscription =
      lcm_subscribe(impl_->lcm, channel_regex.c_str(), Impl::on_message, impl_->subscriptions.back().get());
  if (subscription == nullptr) throw std::runtime_error(fmt::format("cannot subscribe to '{}'", channel_regex));
  lcm_subscription_set_queue_capacity(subscription, kQueueMessages);
}

/// liblcm sends itself a message first; where that does not come back it says so on stderr alone and stays deaf.
int Bus::fd() const {
  const int fd = lcm_get_fileno(impl_->lcm);
  if (fd < 0) {
    throw std::runtime_error("the LCM bus does not hear itself: multicast must have a route and pass the firewall");
  }
  return fd;
}

bool Bus::handle(int timeout_ms) {
  errno = 0;
  const int handled = lcm_handle_timeout(impl_->lcm, timeout_ms);
  if (handled < 0 && errno != EINTR) throw std::runtime_error("the LCM bus is closed");
  return handled > 0;
}

std::vector<Counter> Bus::counters() const {
  std::vector<Counter> counters = {{"bus_sent", impl_->sent},
                                   {"bus_send_failures", impl_->send_failures},
                                   {"bus_received", impl_->received},
                                   {"bus_handler_failures", impl_->handler_failures}};
  for (const auto& [channel, count] : impl_->refused) counters.push_back({channel + "_refused", count});
  return counters;
}

void Bus::count_refused(const std::string& channel) {
  constexpr std::size_t kChannelsNamed = 32;  // the rest is counted together: a sender can make up any number of names
  const bool named = impl_->refused.contains(channel) || impl_->refused.size() < kChannelsNamed;
  ++impl_->refused[named ? channel : "others"];
}

}  // namespace comptonaut
