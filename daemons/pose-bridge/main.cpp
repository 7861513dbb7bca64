// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "bus/daemon.h"
#include "config/config.h"
#include "nodes/pose_bridge.h"
#include "udp_link.h"

using namespace comptonaut;

int main(int argc, char** argv) {
  std::string autopilot = "udp:14540";
  const std::vector<ExtraOption> options = {
      {"--autopilot", "udp:PORT or udp:ADDRESS:PORT where the autopilot sends its MAVLink to", &autopilot}};
  return run_daemon(
      argc, argv, "comptonaut-pose-bridge", "Between the autopilot and the team: poses out, plans in.", options,
      [&](const DaemonArguments& arguments) {
        PoseBridgeConfig config = load_config(arguments.config, read_pose_bridge_config);
        if (arguments.mav == 0) throw std::runtime_error("a pose-bridge needs --mav N, the number of its MAV");
        config.pilot.mav = arguments.mav;
        const auto channel = [&](const char* name) { return mav_channel(arguments.mav, name); };

        EventLoop loop;
        Bus bus(arguments.lcm_url);
        UdpLink link(autopilot);
        PoseBridge bridge(config);
        Utime utime = 0;
        const auto send = [&](const PoseBridge::Output& output) {
          for (const auto& frame : output.to_autopilot) link.send(frame);
          if (output.pose) utime = output.pose->utime;
          if (output.pose) bus.publish(channel("POSE"), *output.pose);
          if (output.quality) bus.publish(channel("POSE_QUALITY"), *output.quality);
          if (output.vehicle) bus.publish(channel("VEHICLE"), *output.vehicle);
        };
        loop.watch(link.fd(), [&, datagram = std::vector<std::uint8_t>()]() mutable {
          while (link.receive(datagram)) send(bridge.on_mavlink(datagram, monotonic_s(arguments)));
        });
        bus.subscribe<Plan>(channel("PLAN"),
                            [&](const auto&, const Plan& plan) { bridge.on_plan(plan, monotonic_s(arguments)); });
        bus.subscribe<StampedPose>("MAV[0-9]+_POSE", [&](const std::string& from, const StampedPose& pose) {
          bridge.on_other_pose(mav_of_channel(from), pose);
        });
        loop.watch(bus);
        loop.every(std::chrono::seconds(1), [&] { send(bridge.on_timer(monotonic_s(arguments))); });
        publish_status(loop, bus, arguments, "pose-bridge", [&] {
          const std::string state = bridge.state(monotonic_s(arguments));
          return DaemonStatus{.utime = utime, .state = state.empty() ? "flying" : state, .counters = bridge.counters()};
        });
        loop.run();
      });
}
