// SPDX-License-Identifier: BSD-3-Clause
#include "team/lc02.h"

#include <algorithm>
#include <stdexcept>

#include "team/big_endian.h"

namespace comptonaut {
namespace {

constexpr std::uint32_t kLc02Magic = 0x4c433032;  // "LC02"
constexpr std::size_t kHeaderBytes = 8;

bool valid_channel(const std::string& channel) {
  return !channel.empty() && channel.size() <= kMaxChannelBytes &&
         std::all_of(channel.begin(), channel.end(), [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

std::optional<Lc02> read_lc02(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < kHeaderBytes || datagram.size() > kMaxDatagramBytes) return {};
  if (read_big_endian<std::uint32_t>(datagram) != kLc02Magic) return {};
  const auto body = datagram.subspan(kHeaderBytes);
  const auto zero = std::find(body.begin(), body.end(), 0);
  if (zero == body.end()) return {};
  Lc02 message{.sequence = read_big_endian<std::uint32_t>(datagram.subspan(4)),
               .channel = std::string(body.begin(), zero),
               .payload = {zero + 1, body.end()}};
  return valid_channel(message.channel) ? std::optional(std::move(message)) : std::nullopt;
}

std::vector<std::uint8_t> write_lc02(const Lc02& message) {
  if (!valid_channel(message.channel)) throw std::invalid_argument("not a channel of LCM: '" + message.channel + "'");
  std::vector<std::uint8_t> datagram;
  append_big_endian(datagram, kLc02Magic);
  append_big_endian(datagram, message.sequence);
  datagram.insert(datagram.end(), message.channel.begin(), message.channel.end());
  datagram.push_back(0);
  datagram.insert(datagram.end(), message.payload.begin(), message.payload.end());
  if (datagram.size() > kMaxDatagramBytes) {
    throw std::invalid_argument("a message of " + std::to_string(datagram.size()) + " bytes on " + message.channel +
                                ": a datagram takes " + std::to_string(kMaxDatagramBytes));
  }
  return datagram;
}

}  // namespace comptonaut
