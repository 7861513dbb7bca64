// SPDX-License-Identifier: BSD-3-Clause
#include "team/multicast_socket.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <stdexcept>

#include "bus/test_bus.h"

namespace comptonaut {
namespace {

std::optional<std::vector<std::uint8_t>> wait_for(MulticastSocket& socket) {
  pollfd polled{.fd = socket.fd(), .events = POLLIN, .revents = 0};
  poll(&polled, 1, 10'000);
  return socket.receive();
}

TEST(MulticastUrl, NamesGroupPortReachAndDevice) {
  EXPECT_EQ(parse_multicast_url("udpm://239.1.2.3:7700"), (MulticastAddress{"239.1.2.3", 7700, 0, ""}));
  EXPECT_EQ(parse_multicast_url("udpm://239.1.2.3:7700?ttl=2&interface=10.0.0.4"),
            (MulticastAddress{"239.1.2.3", 7700, 2, "10.0.0.4"}));
}

TEST(MulticastUrl, SaysWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"udp://239.1.2.3:7700", "does not begin with udpm://"},
      {"udpm://239.1.2:7700", "'239.1.2' is not an IPv4 multicast group"},
      {"udpm://10.1.2.3:7700", "'10.1.2.3' is not an IPv4 multicast group"},
      {"udpm://239.1.2.3", "the port must be 1 to 65535"},
      {"udpm://239.1.2.3:0", "the port must be 1 to 65535"},
      {"udpm://239.1.2.3:77x", "the port must be 1 to 65535"},
      {"udpm://239.1.2.3:7700?ttl=256", "ttl must be 0 to 255"},
      {"udpm://239.1.2.3:7700?ttl", "ttl must be 0 to 255"},
      {"udpm://239.1.2.3:7700?interface=wlan0", "the interface must be given by its IPv4 address"},
      {"udpm://239.1.2.3:7700?color=red", "unknown option 'color'"},
  };
  for (const auto& [url, what] : cases) {
    try {
      (void)parse_multicast_url(url);
      ADD_FAILURE() << url << " accepted";
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find(url), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
    }
  }
}

TEST(MulticastSocket, CarriesDatagramsToEveryMemberAndBack) {
  const MulticastAddress address = parse_multicast_url("udpm://239.255.77.1:" + std::to_string(free_udp_port()));
  MulticastSocket one(address), two(address);
  const std::vector<std::uint8_t> datagram(1200, 7), large(5000, 8);
  EXPECT_FALSE(two.receive()) << "nothing yet";
  EXPECT_TRUE(one.send(datagram));
  EXPECT_EQ(wait_for(two), datagram);
  EXPECT_EQ(wait_for(one), datagram) << "it hears itself";
  EXPECT_TRUE(one.send(large));
  EXPECT_EQ(wait_for(two)->size(), 2048u);
  EXPECT_FALSE(two.receive());
}

TEST(MulticastSocket, NamesWhatItCannotJoin) {
  try {
    MulticastSocket socket({"239.255.77.1", 7700, 0, "203.0.113.9"});
    FAIL() << "joined through a device that is not there";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("239.255.77.1:7700"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace comptonaut
