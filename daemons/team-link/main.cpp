// SPDX-License-Identifier: BSD-3-Clause
#include "bus/daemon.h"
#include "config/config.h"
#include "nodes/team_link.h"
#include "team/multicast_socket.h"

using namespace comptonaut;

int main(int argc, char** argv) {
  std::string team_url;
  const std::vector<ExtraOption> options = {{"--team-url", "instead of the configuration's team_url", &team_url}};
  return run_daemon(argc, argv, "comptonaut-team-link", "Passes messages between the onboard bus and the team.",
                    options, [&](const DaemonArguments& arguments) {
                      const TeamLinkConfig config = load_config(arguments.config, read_team_link_config);
                      const MulticastAddress address =
                          parse_multicast_url(team_url.empty() ? config.team_url : team_url);

                      EventLoop loop;
                      Bus bus(arguments.lcm_url);
                      MulticastSocket team(address);
                      TeamLink link(config, arguments.mav, wall_clock_utime());
                      std::int64_t send_failures = 0;

                      bus.subscribe_raw(".*", [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
                        const auto datagram = link.on_onboard(channel, bytes);
                        if (datagram && !team.send(*datagram)) ++send_failures;
                      });
                      loop.watch(bus);
                      loop.watch(team.fd(), [&] {
                        const auto datagram = team.receive();
                        const auto message = datagram ? link.on_team(*datagram) : std::nullopt;
                        if (message) bus.publish_raw(message->channel, message->bytes);
                      });
                      publish_status(loop, bus, arguments, "team-link", [&] {
                        DaemonStatus status{.state = "running", .counters = link.counters()};
                        status.counters.push_back({"send_failures", send_failures});
                        return status;
                      });
                      loop.run();
                    });
}
