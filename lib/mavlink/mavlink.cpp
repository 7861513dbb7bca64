// SPDX-License-Identifier: BSD-3-Clause
#include "mavlink/mavlink.h"

#include <algorithm>
#include <iterator>

#include "mavlink/payload.h"

namespace comptonaut {
namespace {

// start, length, incompatible flags, compatible flags, sequence, system, component, message id (3 bytes)
constexpr std::uint8_t kStart = 0xFD;
constexpr std::uint8_t kStartMavlink1 = 0xFE;
constexpr std::size_t kHeaderSize = 10;
constexpr std::size_t kChecksumSize = 2;
constexpr std::size_t kSignatureSize = 13;
constexpr std::uint8_t kSignedFlag = 0x01;

std::size_t frame_size(std::span<const std::uint8_t> header) {
  return kHeaderSize + header[1] + kChecksumSize + ((header[2] & kSignedFlag) != 0 ? kSignatureSize : 0);
}

std::uint16_t frame_checksum(std::span<const std::uint8_t> header_and_payload, std::uint8_t crc_extra) {
  return mavlink_crc({&crc_extra, 1}, mavlink_crc(header_and_payload.subspan(1)));
}

}  // namespace

std::uint16_t mavlink_crc(std::span<const std::uint8_t> bytes, std::uint16_t crc) {
  for (const std::uint8_t byte : bytes) {
    auto t = static_cast<std::uint8_t>(byte ^ (crc & 0xFF));
    t = static_cast<std::uint8_t>(t ^ (t << 4));
    crc = static_cast<std::uint16_t>((crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4));
  }
  return crc;
}

std::vector<std::uint8_t> mavlink_frame(const MavlinkMessage& message, MavlinkAddress from, std::uint8_t sequence) {
  const MavlinkKind kind = kind_of(message);
  const std::vector<std::uint8_t> payload = encode_payload(message);
  const auto id_byte = [&](int i) { return static_cast<std::uint8_t>(kind.id >> (8 * i)); };
  std::vector<std::uint8_t> frame{kStart,
                                  static_cast<std::uint8_t>(payload.size()),
                                  0,
                                  0,
                                  sequence,
                                  from.system,
                                  from.component,
                                  id_byte(0),
                                  id_byte(1),
                                  id_byte(2)};
  std::ranges::copy(payload, std::back_inserter(frame));
  const std::uint16_t checksum = frame_checksum(frame, kind.crc_extra);
  frame.push_back(static_cast<std::uint8_t>(checksum & 0xFF));
  frame.push_back(static_cast<std::uint8_t>(checksum >> 8));
  return frame;
}

std::vector<ReceivedMavlink> MavlinkParser::on_bytes(std::span<const std::uint8_t> bytes) {
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  std::vector<ReceivedMavlink> received;
  std::span<const std::uint8_t> rest(pending_);
  while (!rest.empty()) {
    const auto start = static_cast<std::size_t>(std::ranges::find(rest, kStart) - rest.begin());
    counters_.skipped_bytes += static_cast<std::int64_t>(start);
    rest = rest.subspan(start);
    if (rest.size() < kHeaderSize || rest.size() < frame_size(rest)) break;
    rest = rest.subspan(take_frame(rest, received));
  }
  pending_.erase(pending_.begin(), pending_.end() - static_cast<std::ptrdiff_t>(rest.size()));
  return received;
}

// How many bytes are done with: the frame at the front of `bytes`, or its start byte where it proved to be none.
std::size_t MavlinkParser::take_frame(std::span<const std::uint8_t> bytes, std::vector<ReceivedMavlink>& received) {
  const std::size_t size = frame_size(bytes);
  const std::size_t checksum_at = kHeaderSize + bytes[1];
  const MavlinkAddress from{.system = bytes[5], .component = bytes[6]};
  const std::uint32_t id = bytes[7] | bytes[8] << 8 | bytes[9] << 16;
  const auto kind = kind_with_id(id);
  const bool compatible = (bytes[2] & ~kSignedFlag) == 0;
  if (!kind || !compatible) {
    // Its checksum cannot be told. What looks like a frame is one if a known sender's address is in it and another
    // frame, or nothing, follows.
    const bool whole = last_sequence_.contains(from) &&
                       (bytes.size() == size || bytes[size] == kStart || bytes[size] == kStartMavlink1);
    if (!whole) return skip_start_byte();
    ++(compatible ? counters_.unknown : counters_.incompatible);
    count_sequence(from, bytes[4]);
    return size;
  }
  const std::uint16_t checksum = frame_checksum(bytes.first(checksum_at), kind->crc_extra);
  if (bytes[checksum_at] != (checksum & 0xFF) || bytes[checksum_at + 1] != checksum >> 8) {
    ++counters_.bad_checksum;
    return skip_start_byte();
  }
  const auto message = decode_payload(id, bytes.subspan(kHeaderSize, bytes[1]));
  ++counters_.messages;
  count_sequence(from, bytes[4]);
  received.push_back({.from = from, .sequence = bytes[4], .message = *message});
  return size;
}

std::size_t MavlinkParser::skip_start_byte() {
  ++counters_.skipped_bytes;
  return 1;
}

void MavlinkParser::count_sequence(MavlinkAddress from, std::uint8_t sequence) {
  const auto [last, first] = last_sequence_.try_emplace(from, sequence);
  if (first || last->second == sequence) return;  // nothing before it, or the same frame again
  counters_.lost += static_cast<std::uint8_t>(sequence - last->second - 1);
  last->second = sequence;
}

}  // namespace comptonaut
