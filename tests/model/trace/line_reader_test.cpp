// Lines of every length, around the edges of the blocks in which a file is read.
#include "model/trace/line_reader.hpp"

#include <gtest/gtest.h>

#include "tests/model/config/test_files.hpp"

namespace stormproof::model::trace {
namespace line_reader_test {

using Status = LineReader::Status;

TEST(LineReader, ReadsLinesAndCountsThem) {
  const config::TestFiles files;
  LineReader reader{files.write("f", "one\n\nthree")};
  EXPECT_EQ(reader.number(), 0U);
  ASSERT_EQ(reader.next(), Status::line);
  EXPECT_EQ(reader.text(), "one");
  ASSERT_EQ(reader.next(), Status::line);
  EXPECT_EQ(reader.text(), "");
  EXPECT_EQ(reader.number(), 2U);
  ASSERT_EQ(reader.next(), Status::unterminated);
  EXPECT_EQ(reader.text(), "three");
  EXPECT_EQ(reader.number(), 3U);
  EXPECT_EQ(reader.next(), Status::end);
  EXPECT_EQ(reader.number(), 3U);
}

TEST(LineReader, AnEmptyFileHasNoLine) {
  const config::TestFiles files;
  LineReader reader{files.write("f", "")};
  EXPECT_EQ(reader.next(), Status::end);
}

TEST(LineReader, AFileThatIsNotThereIsUnreadable) {
  LineReader reader{"/nowhere/at/all"};
  EXPECT_EQ(reader.next(), Status::unreadable);
}

TEST(LineReader, LinesMayCrossBlocks) {
  const config::TestFiles files;
  for (const std::size_t length : {65'534U, 65'535U, 65'536U, 65'537U, 200'000U}) {
    const std::string first(length, 'a');
    LineReader reader{files.write("f", first + "\n" + "b\n")};
    ASSERT_EQ(reader.next(), Status::line) << length;
    EXPECT_EQ(reader.text(), first);
    ASSERT_EQ(reader.next(), Status::line) << length;
    EXPECT_EQ(reader.text(), "b");
    EXPECT_EQ(reader.number(), 2U);
    EXPECT_EQ(reader.next(), Status::end);
  }
}

TEST(LineReader, RefusesAnEndlessLine) {
  LineReader reader{"/dev/zero"};
  EXPECT_EQ(reader.next(), Status::too_long);
  EXPECT_LE(reader.text().size(), LineReader::max_line_bytes);
}

}  // namespace line_reader_test
}  // namespace stormproof::model::trace
