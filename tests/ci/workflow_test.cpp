// The examples in specs/ci, run as their services run them, on a repository with a profile of its
// own: every `run` of the workflow in order, in one checkout, and every hook of pre-commit. What an
// example says must be true: a harmless change passes, a harmful one is stopped, and the files that
// later steps upload are there.
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "tests/files.hpp"

namespace workflow_test {

namespace fs = std::filesystem;

constexpr const char* specs = STORMPROOF_SOURCE_DIR "/specs/";

using stormproof::files::content;
using stormproof::files::write;

/// A profile with one setting of discovery.
std::string profile(const std::string& setting) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<profiles xmlns=\"http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles\">\n"
         "  <participant profile_name=\"robot\" is_default_profile=\"true\">\n"
         "    <rtps>\n      " +
         setting + "\n    </rtps>\n  </participant>\n</profiles>\n";
}

const std::string usual = profile("<name>robot</name>");
/// Announces itself every millisecond, a thousand times.
const std::string harmful = profile(
    "<builtin><discovery_config><initialAnnouncements><count>1000</count>"
    "<period><sec>0</sec><nanosec>1000000</nanosec></period></initialAnnouncements>"
    "</discovery_config></builtin>");
/// Does not do what it seems to.
const std::string useless =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<profiles>\n"
    "  <participant profile_name=\"robot\" is_default_profile=\"true\"><rtps/></participant>\n"
    "  <data_writer profile_name=\"fast\"><times><heartbeatPeriod><sec>0</sec>"
    "<nanosec>100000000</nanosec></heartbeatPeriod></times></data_writer>\n</profiles>\n";

/// A repository in a folder of its own, whose main branch has the usual profile.
class Examples : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(home_ / "temp");
    write(home_ / "repository/dds/robots.xml", usual);
    write(home_ / "repository/dds/fleet.yaml",
          "deployment: {hosts: 2, participants_per_host: 2, endpoints_per_participant: 4,\n"
          "  schedule: {start: [0ms, 5ms], endpoints_done: [5ms, 30ms], seed: 0}}\n"
          "dds: robots.xml\nwireless: emulated-ap\ntime_limit: 60s\n"
          "limits: {completion: 5s, messages: 1000}\n");
    // Where the workflow checks stormproof out: a launcher, as in its own repository.
    write(home_ / "repository/.stormproof/stormproof",
          "#!/bin/sh\nexec '" STORMPROOF_PROGRAM "' \"$@\"\n");
    fs::permissions(home_ / "repository/.stormproof/stormproof", fs::perms::owner_all);
    // GitHub's own command: keeps what it was asked for; there is a comment if a file says so.
    write(home_ / "repository/.stormproof/gh",
          "#!/bin/sh\necho \"$*\" >> '" + (home_ / "asked").string() +
              "'\ncase $* in *--jq*) cat '" + (home_ / "comments").string() + "' ;; esac\n");
    fs::permissions(home_ / "repository/.stormproof/gh", fs::perms::owner_all);
    write(home_ / "comments", "");
    ASSERT_EQ(shell("git init -q . && echo .stormproof > .git/info/exclude && git add . && git -c "
                    "user.name=a -c user.email=a@b commit -qm base && git update-ref "
                    "refs/remotes/origin/main HEAD"),
              0)
        << output();
  }

  /// Runs a script in the repository; its exit code.
  int shell(const std::string& script) {
    write(home_ / "script", script);
    const std::string command =
        "cd '" + (home_ / "repository").string() + "' && PATH='" + path_ +
        "'\"$PATH\" RUNNER_TEMP='" + (home_ / "temp").string() + "' GITHUB_PATH='" +
        (home_ / "path").string() + "' GITHUB_STEP_SUMMARY='" + (home_ / "summary").string() +
        "' BASE=origin/main PROFILE=dds/robots.xml FLEET=dds/fleet.yaml bash -e '" +
        (home_ / "script").string() + "' > '" + (home_ / "output").string() + "' 2>&1 </dev/null";
    const int code = stormproof::files::exit_code_of(command);
    std::ifstream added{home_ / "path"};
    path_.clear();
    for (std::string line; std::getline(added, line);) path_ += line + ":";
    return code;
  }
  std::string output() const { return content(home_ / "output"); }
  fs::path file(const std::string& name) const { return home_ / "repository" / name; }

  /// Exit codes of the steps of the workflow that run; after a failure only those with
  /// `if: always()`.
  std::vector<int> run_workflow() {
    const YAML::Node workflow = YAML::LoadFile(std::string{specs} + "ci/github-actions.yaml");
    std::vector<int> codes;
    bool failed = false;
    for (const YAML::Node& step : workflow["jobs"]["discovery"]["steps"]) {
      const bool always = step["if"] && step["if"].as<std::string>() == "always()";
      if (!step["run"] || (failed && !always)) continue;
      codes.push_back(shell(step["run"].as<std::string>()));
      failed = failed || codes.back() != 0;
    }
    return codes;
  }

  /// Exit code of a hook of pre-commit for the files of the repository.
  int run_hook(const std::string& id) {
    const YAML::Node config = YAML::LoadFile(std::string{specs} + "ci/pre-commit.yaml");
    for (const YAML::Node& hook : config["repos"][0]["hooks"]) {
      if (hook["id"].as<std::string>() != id) continue;
      std::string command = hook["entry"].as<std::string>();
      const std::regex wanted{hook["files"].as<std::string>()};
      const bool passes = !hook["pass_filenames"] || hook["pass_filenames"].as<bool>();
      for (const char* name : {"dds/fleet.yaml", "dds/robots.xml"}) {
        if (passes && std::regex_search(name, wanted)) command += std::string{" "} + name;
      }
      write(home_ / "path", file(".stormproof").string() + "\n");
      shell("true");  // takes the path over
      return shell(command);
    }
    return -1;
  }

  const stormproof::files::Folder own_;
  const fs::path home_ = own_.path();
  std::string path_;
};

TEST_F(Examples, TheWorkflowPassesAChangeThatDoesNotMatter) {
  write(file("dds/robots.xml"), profile("<name>another name</name>"));
  EXPECT_EQ(run_workflow(), (std::vector<int>{0, 0, 0, 0, 0})) << output();
  for (const char* name : {"comparison.md", "comparison.html", "comparison.sarif"}) {
    EXPECT_GT(fs::file_size(file("discovery") / name), 0U) << name;
  }
  EXPECT_NE(content(home_ / "summary").find("NO REGRESSION"), std::string::npos)
      << content(home_ / "summary");
  EXPECT_EQ(content(file("discovery/comment.md")).find("<!-- stormproof diff -->\n### "), 0U);
  EXPECT_NE(content(home_ / "asked").find("pr comment"), std::string::npos);
}

TEST_F(Examples, TheWorkflowRenewsItsComment) {
  write(home_ / "comments", "4711\n");
  run_workflow();
  const std::string asked = content(home_ / "asked");
  EXPECT_NE(asked.find("--method PATCH"), std::string::npos) << asked;
  EXPECT_NE(asked.find("comments/4711"), std::string::npos) << asked;
  EXPECT_EQ(asked.find("pr comment"), std::string::npos) << asked;
}

TEST_F(Examples, TheWorkflowStopsARegressionAndStillShowsIt) {
  write(file("dds/robots.xml"), harmful);
  EXPECT_EQ(run_workflow(), (std::vector<int>{0, 0, 1, 0, 0})) << output();
  EXPECT_NE(content(home_ / "summary").find("REGRESSION"), std::string::npos);
  const std::string sarif = content(file("discovery/comparison.sarif"));
  EXPECT_NE(sarif.find("dds/robots.xml"), std::string::npos);
  EXPECT_NE(sarif.find("\"startLine\": 5"), std::string::npos);
}

TEST_F(Examples, TheWorkflowStopsAtASettingThatDoesNothing) {
  write(file("dds/robots.xml"), useless);
  EXPECT_EQ(run_workflow(), (std::vector<int>{0, 1, 0, 0})) << output();
  EXPECT_FALSE(fs::exists(home_ / "asked"));
}

TEST_F(Examples, TheHooksPassAndStop) {
  EXPECT_EQ(run_hook("stormproof-lint"), 0) << output();
  EXPECT_EQ(run_hook("stormproof-limits"), 0) << output();
  write(file("dds/robots.xml"), useless);
  EXPECT_EQ(run_hook("stormproof-lint"), 1) << output();
  write(file("dds/robots.xml"), harmful);
  EXPECT_EQ(run_hook("stormproof-limits"), 1) << output();
}

}  // namespace workflow_test
