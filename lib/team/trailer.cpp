// SPDX-License-Identifier: BSD-3-Clause
#include "team/trailer.h"

#include <algorithm>
#include <limits>

#include "team/big_endian.h"

namespace comptonaut {
namespace {

constexpr std::uint32_t kTrailerMagic = 0x434e5454;  // "CNTT"
constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kNumberBytes = 20;
constexpr std::size_t kUnusedBytes = 4 + 32;  // key id and tag, in version 1
constexpr std::size_t kReservedBytes = 3;
constexpr std::uint64_t kMaxCounter = std::numeric_limits<std::int64_t>::max();
constexpr std::int32_t kMaxSender = 250;  // MAVLink's system ids go no further

bool all_zero(std::span<const std::uint8_t> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace

void append_trailer(std::vector<std::uint8_t>& message, const TeamNumber& number) {
  append_big_endian(message, number.sender);
  append_big_endian(message, number.boot_epoch);
  append_big_endian(message, number.counter);
  message.insert(message.end(), kUnusedBytes, 0);
  message.push_back(kVersion);
  message.insert(message.end(), kReservedBytes, 0);
  append_big_endian(message, kTrailerMagic);
}

std::optional<Numbered> split_trailer(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kTrailerBytes) return {};
  const auto trailer = bytes.last(kTrailerBytes);
  const auto after_number = trailer.subspan(kNumberBytes);
  const std::uint8_t version = after_number[kUnusedBytes];
  const bool known = read_big_endian<std::uint32_t>(trailer.last(4)) == kTrailerMagic && version == kVersion &&
                     all_zero(after_number.first(kUnusedBytes)) &&
                     all_zero(after_number.subspan(kUnusedBytes + 1, kReservedBytes));
  if (!known) return {};
  const TeamNumber number{.sender = read_big_endian<std::int32_t>(trailer),
                          .boot_epoch = read_big_endian<std::int64_t>(trailer.subspan(4)),
                          .counter = read_big_endian<std::uint64_t>(trailer.subspan(12))};
  const bool valid =
      number.sender >= 0 && number.sender <= kMaxSender && number.boot_epoch >= 0 && number.counter <= kMaxCounter;
  if (!valid) return {};
  return Numbered{.number = number, .message = bytes.first(bytes.size() - kTrailerBytes)};
}

}  // namespace comptonaut
