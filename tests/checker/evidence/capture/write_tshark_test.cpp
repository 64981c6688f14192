// tshark, an independent dissector, opens simulated captures: every frame is whole and every
// datagram well-formed, and its parameters say what was meant.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/checker/evidence/capture/write_comparison.hpp"
#include "tests/vectors/discovery_vectors.hpp"
#include "tests/vectors/fastdds_vectors.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::capture::testing {
namespace write_tshark_test {

bool tshark_is_available() { return std::system("command -v tshark >/dev/null 2>&1") == 0; }

/// What tshark says about a capture.
struct Dissection {
  std::size_t datagrams = 0;         ///< with RTPS, reassembled
  std::size_t checked_headers = 0;   ///< of IP, with the right checksum
  std::vector<std::string> experts;  ///< frames with an expert information of any severity
  std::string topics;                ///< one after the other
};

/// Of a frame: number, UDP length, expert severities, status of the IP checksum, topics.
const std::string options =
    "-o ip.check_checksum:TRUE -T fields -e frame.number -e udp.length -e _ws.expert.severity "
    "-e ip.checksum.status -e rtps.param.topicName";

Dissection dissect(const std::vector<std::uint8_t>& pcap) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("simulated-" + std::to_string(getpid()) + ".pcap");
  std::ofstream{file, std::ios::binary}.write(reinterpret_cast<const char*>(pcap.data()),
                                              static_cast<std::streamsize>(pcap.size()));
  const std::string command = "tshark -n -r '" + file.string() + "' " + options + " 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  std::array<char, 4096> room{};
  while (const std::size_t read = std::fread(room.data(), 1, room.size(), pipe)) {
    output.append(room.data(), read);
  }
  EXPECT_EQ(pclose(pipe), 0);
  std::filesystem::remove(file);
  Dissection result;
  std::istringstream lines{output};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields{line};
    std::array<std::string, 5> field;
    for (std::string& one : field) std::getline(fields, one, '\t');
    if (!field[1].empty()) ++result.datagrams;
    if (!field[2].empty()) result.experts.push_back(field[0]);
    if (field[3] == "1") ++result.checked_headers;
    result.topics += field[4] + ",";
  }
  return result;
}

void expect_dissected(const model::Scenario& scenario) {
  if (!tshark_is_available()) GTEST_SKIP() << "tshark is not installed";
  const auto [capture, emissions] = recorded(scenario);
  const Dissection dissection = dissect(capture.pcap);
  EXPECT_EQ(dissection.experts, std::vector<std::string>{});
  EXPECT_EQ(dissection.datagrams, emissions.size());
  EXPECT_EQ(dissection.checked_headers, conversation_in(capture).captures.front().packets);
  EXPECT_NE(dissection.topics.find(",rr/simulated_h1_p0/get_parametersReply,"), std::string::npos);
  EXPECT_NE(dissection.topics.find(",rt/bench/topic_00,"), std::string::npos);
}

TEST(WriteTshark, DissectsTheModelOfThePaper) {
  expect_dissected(vectors::paper_vectors().at(1).scenario);
}

TEST(WriteTshark, DissectsFastDds) { expect_dissected(vectors::fastdds_vectors().at(3).scenario); }

TEST(WriteTshark, DissectsADiscoveryServer) {
  expect_dissected(vectors::discovery_vectors().at(1).scenario);
}

TEST(WriteTshark, ComplainsAboutADamagedCapture) {
  if (!tshark_is_available()) GTEST_SKIP() << "tshark is not installed";
  SimulatedCapture capture = simulated_capture(vectors::paper_vectors().front().scenario);
  constexpr std::size_t first_submessage = 24 + 16 + 14 + 20 + 8 + 20;
  capture.pcap[first_submessage + 3] = 0xff;  // of its length
  EXPECT_EQ(dissect(capture.pcap).experts, std::vector<std::string>{"1"});
}

}  // namespace write_tshark_test
}  // namespace stormproof::capture::testing
