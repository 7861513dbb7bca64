// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace comptonaut {

class Config;

/// Which channels pass: "MAV{own}_POSE", "MAV{others}_POSE", "MAV{any}_PLAN", a channel's name like "COORDINATOR", or
/// "*" for all.
class ChannelRule {
 public:
  /// Throws std::invalid_argument where it is none of these.
  explicit ChannelRule(const std::string& pattern);
  [[nodiscard]] bool matches(const std::string& channel, int own_mav) const;

 private:
  enum class Whose { all, nobody, own, others, any };
  Whose whose_ = Whose::nobody;
  std::string name_;  ///< what follows "MAVn_", or the whole channel
};

/// What passes between a machine's onboard bus and the team bus.
struct ForwardRules {
  std::vector<ChannelRule> out;  ///< to the team
  std::vector<ChannelRule> in;   ///< from the team
};

struct TeamLinkConfig {
  std::string team_url = "udpm://239.255.77.1:7700?ttl=1";
  double pose_rate_hz = 10.0;         ///< POSE to the team, at most
  double pose_quality_rate_hz = 1.0;  ///< POSE_QUALITY to the team, at most
  ForwardRules drone;                 ///< of a machine with --mav 1..
  ForwardRules ground;                ///< of a machine with --mav 0
};

[[nodiscard]] TeamLinkConfig read_team_link_config(Config& config);

}  // namespace comptonaut
