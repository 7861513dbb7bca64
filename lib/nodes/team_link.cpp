// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/team_link.h"

#include <algorithm>

#include "core/hash.h"
#include "nodes/mav_channel.h"
#include "team/big_endian.h"
#include "team/lc02.h"

namespace comptonaut {
namespace {

/// What a message of the team bus may take with its trailer: radio frames and fragments cost more beyond it.
constexpr std::size_t kMaxMessage_bytes = 1200;
/// Messages from the team that may be under way to the onboard bus and back.
constexpr std::size_t kMaxEchoes = 8192;

bool any_matches(const std::vector<ChannelRule>& rules, const std::string& channel, int mav) {
  return std::any_of(rules.begin(), rules.end(), [&](const ChannelRule& rule) { return rule.matches(channel, mav); });
}

std::uint64_t hash_of(const std::string& channel, std::span<const std::uint8_t> bytes) {
  Fnv1a hash;
  for (const char c : channel) hash.add(static_cast<std::uint8_t>(c));
  hash.add(std::uint8_t{0});
  for (const std::uint8_t byte : bytes) hash.add(byte);
  return hash.value();
}

/// The time that a pose and its quality begin with, behind their fingerprint.
std::optional<Utime> leading_utime(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 16) return {};
  return read_big_endian<Utime>(bytes.subspan(8));
}

}  // namespace

TeamLink::TeamLink(const TeamLinkConfig& config, int mav, std::int64_t boot_epoch)
    : rules_(mav == 0 ? config.ground : config.drone),
      periods_us_({{"POSE", microseconds(1.0 / config.pose_rate_hz)},
                   {"POSE_QUALITY", microseconds(1.0 / config.pose_quality_rate_hz)}}),
      next_{.sender = mav, .boot_epoch = boot_epoch, .counter = 0},
      echoes_in_order_(kMaxEchoes) {}

std::optional<std::vector<std::uint8_t>> TeamLink::on_onboard(const std::string& channel,
                                                              std::span<const std::uint8_t> bytes) {
  if (is_echo(channel, bytes)) {
    ++counts_.echoes;
    return {};
  }
  if (!any_matches(rules_.out, channel, next_.sender)) return {};
  if (bytes.size() + kTrailerBytes > kMaxMessage_bytes) {
    ++counts_.oversize;
    return {};
  }
  if (is_too_many(channel, bytes)) {
    ++counts_.thinned;
    return {};
  }
  std::vector<std::uint8_t> payload(bytes.begin(), bytes.end());
  append_trailer(payload, next_);
  const auto sequence = static_cast<std::uint32_t>(next_.counter);
  ++next_.counter;
  ++counts_.sent;
  return write_lc02({.sequence = sequence, .channel = channel, .payload = payload});
}

std::optional<TeamLink::Onboard> TeamLink::on_team(std::span<const std::uint8_t> datagram) {
  const auto message = read_lc02(datagram);
  const auto numbered = message ? split_trailer(message->payload) : std::nullopt;
  if (!numbered || message->payload.size() > kMaxMessage_bytes) {
    ++counts_.not_team;
    return {};
  }
  if (numbered->number.sender == next_.sender) {
    ++counts_.own;
    return {};
  }
  if (!duplicates_.first_time(numbered->number)) {
    ++counts_.duplicates;
    return {};
  }
  if (!any_matches(rules_.in, message->channel, next_.sender)) {
    ++counts_.not_wanted;
    return {};
  }
  ++counts_.received;
  Onboard onboard{.channel = message->channel, .bytes = {numbered->message.begin(), numbered->message.end()}};
  remember_echo(onboard);
  return onboard;
}

bool TeamLink::is_echo(const std::string& channel, std::span<const std::uint8_t> bytes) {
  const auto found = echoes_.find(hash_of(channel, bytes));
  if (found == echoes_.end()) return false;
  echoes_.erase(found);
  return true;
}

void TeamLink::remember_echo(const Onboard& message) {
  const std::uint64_t h = hash_of(message.channel, message.bytes);
  std::uint64_t& oldest = echoes_in_order_[oldest_echo_];
  if (const auto forgotten = echoes_.find(oldest); forgotten != echoes_.end()) echoes_.erase(forgotten);
  oldest = h;
  oldest_echo_ = (oldest_echo_ + 1) % kMaxEchoes;
  echoes_.insert(h);
}

bool TeamLink::is_too_many(const std::string& channel, std::span<const std::uint8_t> bytes) {
  const auto parts = parse_mav_channel(channel);
  const auto period_us = parts ? periods_us_.find(parts->name) : periods_us_.end();
  const auto utime = leading_utime(bytes);
  if (period_us == periods_us_.end() || !utime) return false;
  const Utime slot = floor_to(*utime, period_us->second);
  const auto [sent, first] = slots_.try_emplace(channel, slot);
  if (!first && sent->second == slot) return true;
  sent->second = slot;
  return false;
}

std::vector<Counter> TeamLink::counters() const {
  return {{"sent_to_team", counts_.sent},     {"received_from_team", counts_.received},
          {"poses_thinned", counts_.thinned}, {"oversize", counts_.oversize},
          {"echoes", counts_.echoes},         {"datagrams_refused", counts_.not_team},
          {"datagrams_own", counts_.own},     {"duplicates", counts_.duplicates},
          {"not_wanted", counts_.not_wanted}};
}

}  // namespace comptonaut
