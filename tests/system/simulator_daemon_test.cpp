// SPDX-License-Identifier: BSD-3-Clause
// The real simulator beside a detector-reader that takes its connection and then never reads.
#include <gtest/gtest.h>

#include "bus/bus.h"
#include "bus/test_bus.h"
#include "scratch.h"
#include "system/child.h"

namespace comptonaut {
namespace {

const std::string kBin = COMPTONAUT_BINARY_DIR "/bin/";
const std::string kConfig = COMPTONAUT_SOURCE_DIR "/config/";

/// One MAV whose detector sends more within the simulator's first three seconds than any socket holds.
constexpr const char* kNoisy = R"(
name: noisy
horizon_s: 40
area: {x_min_m: 0, x_max_m: 20, y_min_m: 0, y_max_m: 20}
mavs: {count: 1}
sources: [{x_m: 6, y_m: 14, activity_Bq: 4.0e+9}]
traps: {hot_pixels: 1000, hot_pixel_hits_per_s: 500}
)";

/// Listens on a port of its own; the system accepts for it, and nobody ever reads.
class DeafServer {
 public:
  DeafServer() : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const bool listens = bind(fd_, reinterpret_cast<sockaddr*>(&address), size) == 0 && listen(fd_, 1) == 0 &&
                         getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    EXPECT_TRUE(listens);
    port_ = ntohs(address.sin_port);
  }
  ~DeafServer() { close(fd_); }
  DeafServer(const DeafServer&) = delete;
  DeafServer& operator=(const DeafServer&) = delete;

  [[nodiscard]] int port() const { return port_; }

 private:
  int fd_;
  int port_ = 0;
};

TEST(SimulatorDaemon, EndsInTimeBesideADetectorReaderThatHangs) {
  const auto scenario = scratch_file("noisy.yaml", kNoisy);
  const DeafServer reader;
  const int autopilot_port = free_udp_port();
  const std::string url = loopback_url();
  Bus bus(url);
  std::string state;
  bus.subscribe<DaemonStatus>("MAV0_STATUS", [&](const auto&, const DaemonStatus& status) { state = status.state; });
  Child bridge({kBin + "comptonaut-pose-bridge", "--config", kConfig + "pose-bridge.yaml", "--mav", "1", "--lcm-url",
                url, "--autopilot", "udp:" + std::to_string(autopilot_port)});
  Child simulator({kBin + "comptonaut-simulator", "--config", kConfig + "simulator.yaml", "--lcm-url", url,
                   "--scenario", scenario.string(), "--detector-port", std::to_string(reader.port() - 1),
                   "--autopilot-port", std::to_string(autopilot_port - 1)});
  EXPECT_TRUE(until([&] { return state == "waiting for the detector-reader of MAV 1"; }, [&] { bus.handle(100); }))
      << "state: " << state;
  simulator.signal(SIGTERM);
  EXPECT_EQ(simulator.wait(std::chrono::seconds(5)), 0);
}

}  // namespace
}  // namespace comptonaut
