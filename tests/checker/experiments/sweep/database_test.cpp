// The file of results: what goes in comes out, in this version only; files of others are left
// alone.
#include "checker/experiments/sweep/database.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "tests/files.hpp"

namespace stormproof::sweep {
namespace database_test {

using grids::digest_of;

namespace fs = std::filesystem;

class DatabaseTest : public testing::Test {
 protected:
  Database open(const std::string& version = "1.0") const {
    auto database = Database::open(file_, version);
    EXPECT_TRUE(database) << to_string(database.error());
    return *std::move(database);
  }
  [[nodiscard]] std::string open_error() const {
    const auto database = Database::open(file_, "1.0");
    return database ? "no error" : to_string(database.error());
  }
  void execute(const char* sql) const {
    sqlite3* connection = nullptr;
    ASSERT_EQ(sqlite3_open(file_.c_str(), &connection), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(connection, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(connection);
  }
  [[nodiscard]] std::string content() const { return files::content(file_); }

  const files::Folder own_;
  const fs::path folder_ = own_.path();
  fs::path file_ = folder_ / "runs.db";
};

Outcome some_outcome() {
  Outcome outcome;
  outcome.end = "time_limit";
  for (std::size_t k = 1; k < outcome.numbers.size(); ++k) {
    outcome.numbers[k] = static_cast<std::int64_t>(1'000'000'000'000 + k);
  }
  outcome.wall_seconds = 0.25;
  outcome.cpu_seconds = 0.125;
  return outcome;
}

TEST_F(DatabaseTest, KeepsOutcomesByInputsAndVersion) {
  const Digest one = digest_of("one");
  {
    Database database = open();
    EXPECT_FALSE(database.find(one));
    EXPECT_TRUE(database.add(one, "{}", some_outcome()));
    EXPECT_TRUE(database.add(digest_of("two"), "{}", failure("it's \"wrong\"")));
    EXPECT_TRUE(database.finish());
  }
  {
    Database database = open();
    const auto found = database.find(one);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->end, "time_limit");
    EXPECT_EQ(found->numbers, some_outcome().numbers);
    EXPECT_FALSE(found->completed());
    EXPECT_EQ(found->wall_seconds, 0.25);
    EXPECT_EQ(found->cpu_seconds, 0.125);
    EXPECT_EQ(database.find(digest_of("two"))->error, "it's \"wrong\"");
    EXPECT_FALSE(database.find(digest_of("three")));
  }
  EXPECT_FALSE(open("1.1").find(one));
}

TEST_F(DatabaseTest, WhatWasNotCommittedIsNotThere) {
  {
    Database database = open();
    EXPECT_TRUE(database.add(digest_of("one"), "{}", some_outcome()));
    EXPECT_TRUE(database.commit());
    EXPECT_TRUE(database.add(digest_of("two"), "{}", some_outcome()));
  }
  Database database = open();
  EXPECT_TRUE(database.find(digest_of("one")));
  EXPECT_FALSE(database.find(digest_of("two")));
}

TEST_F(DatabaseTest, TakesOverTheRowsOfAnother) {
  const fs::path other = folder_ / "it's another.db";
  {
    auto database = Database::open(other, "1.0");
    ASSERT_TRUE(database);
    Outcome differs = some_outcome();
    differs.wall_seconds = 7;
    EXPECT_TRUE(database->add(digest_of("one"), "{}", differs));
    EXPECT_TRUE(database->add(digest_of("two"), "{}", some_outcome()));
    EXPECT_TRUE(database->commit());  // and no more, as if it had been killed
  }
  Database database = open();
  EXPECT_TRUE(database.add(digest_of("one"), "{}", some_outcome()));
  EXPECT_TRUE(database.commit());
  EXPECT_FALSE(database.take_over(other));
  EXPECT_EQ(database.find(digest_of("one"))->wall_seconds, 0.25);
  EXPECT_EQ(database.find(digest_of("two"))->numbers, some_outcome().numbers);
  EXPECT_FALSE(database.take_over(other));

  const fs::path absent = folder_ / "absent.db";
  EXPECT_EQ(database.take_over(absent)->message, "no such file");
  EXPECT_FALSE(fs::exists(absent));
  std::ofstream{absent} << "important notes";
  EXPECT_TRUE(database.take_over(absent));
  EXPECT_TRUE(database.take_over(folder_));
}

TEST_F(DatabaseTest, AnEmptyFileIsANewOne) {
  std::ofstream{file_};
  EXPECT_EQ(open_error(), "no error");
  EXPECT_EQ(open_error(), "no error");
}

TEST_F(DatabaseTest, FilesOfOthersAreRefusedAndLeftAlone) {
  std::ofstream{file_} << "important notes";
  EXPECT_NE(open_error().find("not a database"), std::string::npos);
  EXPECT_EQ(content(), "important notes");

  fs::remove(file_);
  execute("CREATE TABLE robots (name TEXT)");
  const std::string before = content();
  EXPECT_NE(open_error().find("database of something else"), std::string::npos);
  EXPECT_EQ(content(), before);
}

TEST_F(DatabaseTest, ANewerSchemaIsRefused) {
  (void)open();
  execute("PRAGMA user_version = 3");
  EXPECT_NE(open_error().find("has schema 3; expected 2"), std::string::npos);
}

TEST_F(DatabaseTest, AFolderThatDoesNotExist) {
  file_ = folder_ / "no" / "runs.db";
  EXPECT_NE(open_error().find("unable to open"), std::string::npos);
}

TEST(Digest, IsSha1) {
  EXPECT_EQ(hex(digest_of("abc")), "a9993e364706816aba3e25717850c26c9cd0d89d");
}

}  // namespace database_test
}  // namespace stormproof::sweep
