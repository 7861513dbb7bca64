// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>

#include <charconv>
#include <stdexcept>

#include "team/multicast_socket.h"

namespace comptonaut {
namespace {

bool parse_int(std::string_view text, int min, int max, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= min && value <= max;
}

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

bool is_multicast(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

/// Takes what is before the first `separator` off `text`; all of it where there is none.
std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view head = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view() : text.substr(at + 1);
  return head;
}

}  // namespace

MulticastAddress parse_multicast_url(const std::string& url) {
  const auto refuse = [&](const std::string& what) {
    return std::invalid_argument("team URL '" + url + "': " + what + "; expected udpm://GROUP:PORT?ttl=N&interface=IP");
  };
  constexpr std::string_view kScheme = "udpm://";
  if (!url.starts_with(kScheme)) throw refuse("does not begin with udpm://");
  std::string_view options = std::string_view(url).substr(kScheme.size());
  std::string_view port = take_until(options, '?');
  MulticastAddress address;
  address.group = take_until(port, ':');
  if (!is_multicast(address.group)) throw refuse("'" + address.group + "' is not an IPv4 multicast group");
  if (!parse_int(port, 1, 65535, address.port)) throw refuse("the port must be 1 to 65535");
  while (!options.empty()) {
    std::string_view value = take_until(options, '&');
    const std::string key(take_until(value, '='));
    if (key == "ttl") {
      if (!parse_int(value, 0, 255, address.ttl)) throw refuse("ttl must be 0 to 255");
    } else if (key == "interface") {
      address.interface = value;
      if (!is_ipv4(address.interface)) throw refuse("the interface must be given by its IPv4 address");
    } else {
      throw refuse("unknown option '" + key + "'");
    }
  }
  return address;
}

}  // namespace comptonaut
