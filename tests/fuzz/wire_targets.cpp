// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/targets.h"
#include "mavlink/mavlink.h"
#include "team/lc02.h"

namespace comptonaut {
namespace {

std::vector<std::uint8_t> unsigned_bytes(std::span<const char> bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

/// What was read can be written again. (Where frames of unknown kind end is told by what follows, if that is there.)
void fuzz_mavlink(std::span<const char> bytes) {
  const unsigned choice = take_choice(bytes);
  MavlinkParser parser;
  std::vector<ReceivedMavlink> all;
  in_pieces(bytes, choice, [&](const auto& piece) {
    const auto more = parser.on_bytes(unsigned_bytes(piece));
    all.insert(all.end(), more.begin(), more.end());
  });
  const MavlinkCounters& counters = parser.counters();
  require_law(std::ssize(all) == counters.messages, "each is counted");
  require_law(
      counters.messages + counters.unknown + counters.incompatible + counters.bad_checksum + counters.skipped_bytes <=
          2 * std::ssize(bytes),
      "no more is counted than came");
  for (const ReceivedMavlink& received : all) {
    const auto again = MavlinkParser().on_bytes(mavlink_frame(received.message, received.from, received.sequence));
    require_law(again.size() == 1 && again[0].from == received.from, "what was read can be written");
  }
}

/// A datagram of the team bus: what is read is what would be written, byte by byte.
void fuzz_lc02(std::span<const char> bytes) {
  const std::vector<std::uint8_t> datagram = unsigned_bytes(bytes);
  const auto message = read_lc02(datagram);
  if (message) require_law(write_lc02(*message) == datagram, "what was read can be written");
}

}  // namespace comptonaut
