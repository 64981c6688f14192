// What later versions of Fast DDS have and no vector and no random run tells apart: in which order
// sides open that ask for types and answer, and what sizes of packets are sums of.
#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "model/fastdds/endpoints.hpp"
#include "tests/model/fastdds/one_writer.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model::fastdds {
namespace versions_test {

using Names = std::vector<std::string>;

// Control-only relations of the pair (0, 1), and of (1, 0): liveliness, two topics, and what asks
// for types and answers.
constexpr const char* liveliness_reader = "ControlReader 0: Closed";
constexpr const char* question_reader = "ControlReader 3: Closed";
constexpr const char* answer_reader = "ControlReader 4: Closed";
constexpr const char* liveliness_writer = "ControlWriter 5: Closed";
constexpr const char* question_writer = "ControlWriter 8: Closed";
constexpr const char* answer_writer = "ControlWriter 9: Closed";
constexpr const char* reader_of_publications = "DiscoveryReader 0: Unknown";

/// What opens at 1, which recognises 0, in this order.
Names opened_at_1(MatchOrder order) {
  Scenario scenario = one_writer();
  scenario.time_limit = Nanoseconds{10 * ms};
  scenario.dds.version.type_lookup = Whether::yes;
  scenario.dds.version.match_order = order;
  const RunLog log = run_and_log(scenario);
  Names opened;
  for (const std::string& move : log.transitions) {
    for (const char* what : {liveliness_reader, question_reader, answer_reader, liveliness_writer,
                             question_writer, answer_writer, reader_of_publications}) {
      const bool is_new = std::ranges::find(opened, what) == opened.end();
      if (move.starts_with(what) && is_new) opened.emplace_back(what);
    }
  }
  return opened;
}

TEST(FastddsVersions, ReaderSidesOpenBeforeWriterSidesAndQuestionsBeforeAnswers) {
  const Names built_in{liveliness_reader, liveliness_writer, question_reader,
                       answer_reader,     question_writer,   answer_writer};
  Names last{reader_of_publications};
  last.insert(last.end(), built_in.begin(), built_in.end());
  EXPECT_EQ(opened_at_1(MatchOrder::endpoints_first), last);
  Names first = built_in;
  first.emplace_back(reader_of_publications);
  EXPECT_EQ(opened_at_1(MatchOrder::builtin_first), first);
}

TEST(FastddsVersions, SizesAreSumsOfTheirParts) {
  DdsProfile dds;
  dds.version.sizes = SizesSince::v3_6;
  dds.version.descriptor_extra_bytes = Bytes{92};
  EXPECT_EQ(submessage_bytes(dds, Stream::pub, 5), 300 + 92);
  EXPECT_EQ(submessage_bytes(dds, Stream::sub, 8), 256 + 92);
  EXPECT_EQ(largest_submessage_bytes(dds), 312 + 92);
  EXPECT_EQ(sizes_of(dds).registration, 20 + 12 + 540);
  EXPECT_EQ(sizes_of(dds).passed_on, 36 + 12 + 540);
  EXPECT_EQ(sizes_of(dds).of_server, 36 + 12 + 604);
  dds.version.sizes = SizesSince::v3_2;
  EXPECT_EQ(sizes_of(dds).registration, 20 + 12 + 536);
  EXPECT_EQ(sizes_of(dds).passed_on, 36 + 12 + 536);
  EXPECT_EQ(sizes_of(dds).of_server, 36 + 12 + 608);
}

}  // namespace versions_test
}  // namespace stormproof::model::fastdds
