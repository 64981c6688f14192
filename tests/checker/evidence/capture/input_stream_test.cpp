// A capture is the same from a file, from a pipe, and compressed in a pipe.
#include "checker/evidence/capture/input_stream.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "checker/evidence/capture/events.hpp"

namespace stormproof::capture {
namespace input_stream_test {

const std::string shipped = STORMPROOF_CAPTURES_DIR "/fastdds2611_ap150_np1_ne2_r0.pcap.xz";

TEST(InputStream, APipeIsReadAsAFileIs) {
  int ends[2] = {};
  ASSERT_EQ(pipe(ends), 0);
  std::thread writer{[&] {
    std::ifstream file{shipped, std::ios::binary};
    const std::string content{std::istreambuf_iterator<char>{file}, {}};
    EXPECT_EQ(write(ends[1], content.data(), content.size()), static_cast<ssize_t>(content.size()));
    close(ends[1]);
  }};
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  const auto piped = read_conversation(std::vector{path});
  writer.join();
  close(ends[0]);
  const auto read = read_conversation(std::vector{shipped});
  ASSERT_TRUE(piped) << to_string(piped.error());
  ASSERT_TRUE(read);
  EXPECT_EQ(piped->events.size(), read->events.size());
  EXPECT_EQ(piped->captures.front().packets, read->captures.front().packets);
}

TEST(InputStream, WhatIsNoCaptureIsRefused) {
  const auto folder = open_stream(STORMPROOF_CAPTURES_DIR);
  ASSERT_FALSE(folder);
  EXPECT_NE(to_string(folder.error()).find("is a directory"), std::string::npos);
  const auto device = open_stream("/dev/zero");
  ASSERT_FALSE(device);
  EXPECT_NE(to_string(device.error()).find("not a regular file or a pipe"), std::string::npos);
  EXPECT_FALSE(open_stream("/there/is/no/such.pcap"));
}

}  // namespace input_stream_test
}  // namespace stormproof::capture
