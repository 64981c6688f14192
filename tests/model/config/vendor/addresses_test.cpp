// What is taken for an address in files and variables, and what a tutorial has in its place.
#include "model/config/vendor/addresses.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::config::vendor {
namespace addresses_test {

TEST(Addresses, OfHosts) {
  for (const char* text : {"192.0.2.1", "0.0.0.0", "255.255.255.255", "2001:db8::1", "fe80::1%eth0",
                           "::ffff:192.0.2.1", "robot", "robot-1.local", "discovery_server",
                           "ip-10-0-0-1.ec2.internal", "my-robot", "MYROBOT", "XPS13"}) {
    EXPECT_EQ(why_no_address(text), "") << text;
  }
}

TEST(Addresses, ThatAreNone) {
  for (const char* text : {"", " ", "192.0.2", "192.0.2.256", "1.2.3.4.5", "[IP_ADDRESS]", "<ip>",
                           "${IP}", "IP_ADDRESS", "ip_address", "ROBOT_IP", "your-ip", "my_ip_addr",
                           "192.168.1.X", "x.x.x.x", "10.0.0.NNN", "a b", "192.0.2.1;192.0.2.2"}) {
    EXPECT_NE(why_no_address(text), "") << text;
  }
}

TEST(Addresses, WithAPort) {
  for (const char* text : {"192.0.2.1:7410", "robot:0", "[2001:db8::1]:7410", "2001:db8::1"}) {
    EXPECT_EQ(why_no_endpoint(text), "") << text;
  }
  for (const char* text :
       {"192.0.2.1:", "192.0.2.1:70000", "192.0.2.1:PORT", ":7410", "[IP]:7410"}) {
    EXPECT_NE(why_no_endpoint(text), "") << text;
  }
}

}  // namespace addresses_test
}  // namespace stormproof::model::config::vendor
