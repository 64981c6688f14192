// IP addresses: the IPv4-mapped form, and text.
#include "checker/evidence/capture/address.hpp"

#include <algorithm>

#include <arpa/inet.h>
#include <fmt/core.h>

namespace stormproof::capture {

namespace {

constexpr std::array<std::uint8_t, 12> v4_prefix{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};

}  // namespace

Address Address::from(Bytes address) {
  Address result;
  if (address.size() == 4) {
    std::ranges::copy(v4_prefix, result.bytes.begin());
    std::ranges::copy(address, result.bytes.begin() + 12);
  } else if (address.size() == result.bytes.size()) {
    std::ranges::copy(address, result.bytes.begin());
  }
  return result;
}

bool Address::is_v4() const {
  return std::equal(v4_prefix.begin(), v4_prefix.end(), bytes.begin());
}

bool Address::is_multicast() const {
  return is_v4() ? (bytes[12] & 0xf0U) == 0xe0U : bytes[0] == 0xffU;
}

std::string to_string(const Address& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool v4 = address.is_v4();
  inet_ntop(v4 ? AF_INET : AF_INET6, address.bytes.data() + (v4 ? 12 : 0), text.data(),
            static_cast<socklen_t>(text.size()));
  return text.data();
}

std::string to_string(const UdpEnd& end) {
  const std::string address = to_string(end.address);
  return end.address.is_v4() ? fmt::format("{}:{}", address, end.port)
                             : fmt::format("[{}]:{}", address, end.port);
}

}  // namespace stormproof::capture
