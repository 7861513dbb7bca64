// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/time.h"
#include "nodes/status.h"
#include "nodes/team_link_config.h"
#include "team/duplicates.h"
#include "team/trailer.h"

namespace comptonaut {

/// Passes encoded messages between a machine's onboard bus and the team bus, as the rules for a drone or the ground
/// say: numbered on the way out, once each on the way in, never back to where they came from.
/// No LCM, no sockets, no clock of its own.
class TeamLink {
 public:
  /// A message for the onboard bus.
  struct Onboard {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  /// `mav` is this machine's number, 0 for the ground station; `boot_epoch` names this process.
  TeamLink(const TeamLinkConfig& config, int mav, std::int64_t boot_epoch);

  /// The datagram for the team that a message of the onboard bus makes; nullopt where it stays onboard: no rule lets it
  /// out, it came from the team, it is a pose or a pose's quality too many, or it does not fit a datagram.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> on_onboard(const std::string& channel,
                                                                    std::span<const std::uint8_t> bytes);

  /// The message for the onboard bus that a datagram of the team makes; nullopt where it has been here before, no rule
  /// lets it in, or it is not a message of the team at all.
  [[nodiscard]] std::optional<Onboard> on_team(std::span<const std::uint8_t> datagram);

  [[nodiscard]] std::vector<Counter> counters() const;

 private:
  [[nodiscard]] bool is_echo(const std::string& channel, std::span<const std::uint8_t> bytes);
  [[nodiscard]] bool is_too_many(const std::string& channel, std::span<const std::uint8_t> bytes);
  void remember_echo(const Onboard& message);

  ForwardRules rules_;
  std::map<std::string, Utime, std::less<>> periods_us_;  // of thinned channels, by the name without the MAV
  TeamNumber next_;
  Duplicates duplicates_;
  std::map<std::string, Utime> slots_;  // of each thinned channel, in which period its last message was sent

  // What was put on the onboard bus and comes back from it, oldest first, by hash.
  std::multiset<std::uint64_t> echoes_;
  std::vector<std::uint64_t> echoes_in_order_;
  std::size_t oldest_echo_ = 0;

  struct Counts {
    std::int64_t sent = 0, received = 0, thinned = 0, oversize = 0, echoes = 0;
    std::int64_t not_team = 0, own = 0, duplicates = 0, not_wanted = 0;
  } counts_;
};

}  // namespace comptonaut
