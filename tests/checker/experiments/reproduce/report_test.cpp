// Every published figure is in every form of the report, numbers are numbers, and the page needs
// nothing but itself.
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "checker/experiments/reproduce/reproduce_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "tests/checker/experiments/reproduce/examples.hpp"
#include "tests/checker/presentation/document/html_checks.hpp"

namespace stormproof::reproduce {
namespace report_test {

/// Paths of all leaves, found without the reader under test.
void leaf_paths(const YAML::Node& node, const std::string& path, std::vector<std::string>& out) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      if (key == "np" || key == "scope") continue;
      leaf_paths(entry.second, path.empty() ? key : path + "." + key, out);
    }
  } else if (node.IsSequence() && node[0].IsMap()) {
    for (const YAML::Node& item : node) {
      const std::string name =
          item["np"] ? "np" + item["np"].as<std::string>() : item["scope"].as<std::string>();
      leaf_paths(item, path + "." + name, out);
    }
  } else {
    out.push_back(path);
  }
}

bool mentions_no_number(const std::string& text) {
  return std::regex_search(text, std::regex{R"((^|[^A-Za-z])-?(nan|inf)([^A-Za-z]|$))"});
}

class ReportTest : public ::testing::Test {
 protected:
  /// All 90 configurations and all variants.
  static void SetUpTestSuite() {
    const Published published = shipped_figures();
    report_ = new Report{report_of(published, made_up(plan_of(published, {{}, 2})))};
  }
  static void TearDownTestSuite() { delete report_; }

  static const Figure& figure(const std::string& id) {
    for (const Figure& one : report_->figures) {
      if (one.published.id == id) return one;
    }
    ADD_FAILURE() << id;
    return report_->figures.front();
  }

  static Report* report_;
};
Report* ReportTest::report_ = nullptr;

TEST_F(ReportTest, EveryPublishedKeyIsInEveryForm) {
  std::vector<std::string> paths;
  leaf_paths(YAML::Load(shipped("paper-tables.yaml")), "", paths);
  EXPECT_GT(paths.size(), 100U);
  const std::string csv = figures_csv(*report_);
  const std::string text = report::to_text(document_of(*report_));
  const std::string html = report::to_html(document_of(*report_));
  std::set<std::string> in_json;
  const auto json = to_json(*report_);
  for (const auto& one : json["published_figures"]) in_json.insert(one["id"].get<std::string>());
  EXPECT_EQ(in_json.size(), paths.size());
  for (const std::string& path : paths) {
    EXPECT_EQ(in_json.count(path), 1U) << path;
    EXPECT_TRUE(csv.find("\n" + path + ",") != std::string::npos ||
                csv.find("\n" + path + ".0,") != std::string::npos)
        << path;
    const std::string name =
        path.find('.') == std::string::npos ? path : path.substr(path.find('.') + 1);
    EXPECT_TRUE(text.find("\n  " + name + " ") != std::string::npos ||
                text.find(": " + name + "\n") != std::string::npos)
        << path;
    EXPECT_NE(html.find(">" + name + "</td>"), std::string::npos) << path;
  }
}

TEST_F(ReportTest, EveryFigureThatAModelCanProduceHasAValueOfEveryVariant) {
  for (const Figure& one : report_->figures) {
    const bool asked = one.kind == Kind::model || one.kind == Kind::nearest;
    for (std::size_t v = 0; v < one.models.size(); ++v) {
      const ModelValue& model = one.models[v];
      const bool left_out = report_->results.plan.variants[v].staggered &&
                            one.published.id.rfind("ordering_policy_spread", 0) == 0;
      EXPECT_EQ(model.values.empty(), !asked || left_out) << one.published.id;
      EXPECT_EQ(model.agreement == Agreement::not_asked, !asked) << one.published.id;
    }
  }
}

TEST_F(ReportTest, ValuesAreThoseOfTheCases) {
  EXPECT_EQ(figure("repair_amplification.wireless.spdp").models[0].values.front(), 30);
  EXPECT_EQ(figure("repair_amplification.wired.total").models[0].values.front(), 25);
  EXPECT_EQ(figure("repair_amplification.largest_wireless_to_wired_ratio").models[0].values.front(),
            2);
  // Mean of N_E = 2 … 30 is 16.
  EXPECT_NEAR(figure("observed_means.np4.completion_s.baseline").models[0].values.front(), 0.064,
              1e-12);
  EXPECT_NEAR(figure("observed_means.np4.completion_change_pct").models[0].values.front(), -50,
              1e-9);
  EXPECT_NEAR(figure("upper_range.np4.completion.median").models[0].values.front(), 0.064 / 1.689,
              1e-12);
  EXPECT_NEAR(figure("ordering_policy_spread.completion_median_pct").models[0].values.front(), 3,
              1e-4);
  EXPECT_EQ(figure("loopback_configurations_with_repair").models[0].values.front(), 90);
}

TEST_F(ReportTest, RatiosAndAgreementFollowFromTheValues) {
  const ModelValue& half = figure("observed_means.np4.completion_change_pct").models[0];
  EXPECT_NEAR(half.ratios.front().value(), -50 / -31.5, 1e-9);
  EXPECT_EQ(half.agreement, Agreement::apart);
  EXPECT_FALSE(half.reasons.empty());
  EXPECT_TRUE(figure("grid.hosts").reasons.empty());
  EXPECT_EQ(figure("upper_range.np4.completion.coverage_pct").kind, Kind::unavailable);
}

TEST_F(ReportTest, EveryDifferenceHasAReason) {
  for (const Figure& one : report_->figures) {
    for (const ModelValue& model : one.models) {
      const bool apart = model.agreement == Agreement::apart;
      // The made-up results do not even send each descriptor once.
      if (one.published.id.ends_with("wired.initial_data")) continue;
      EXPECT_EQ(model.reasons.empty(), !apart) << one.published.id;
    }
    EXPECT_TRUE(one.kind != Kind::unavailable || !one.reasons.empty()) << one.published.id;
  }
}

TEST_F(ReportTest, AgreementMeansWithinATenth) {
  Results results = report_->results;
  const Case wired{0, Network::wired, model::HeartbeatPolicy::periodic, orders[0], {5, 20}};
  const auto agreement_with = [&](std::uint64_t acknacks) {
    results.outcomes[wired].runs[0].counts.acknack = acknacks;
    for (const Figure& one : compare(report_->published, results)) {
      if (one.published.id == "repair_amplification.wired.acknack") return one.models[0].agreement;
    }
    return Agreement::not_asked;
  };
  EXPECT_EQ(agreement_with(110), Agreement::close) << "published: 100.4";
  EXPECT_EQ(agreement_with(91), Agreement::close);
  EXPECT_EQ(agreement_with(111), Agreement::apart);
  EXPECT_EQ(agreement_with(90), Agreement::apart);
}

TEST_F(ReportTest, NoFormPrintsWhatIsNoNumber) {
  EXPECT_FALSE(mentions_no_number(report::to_text(document_of(*report_))));
  EXPECT_FALSE(mentions_no_number(figures_csv(*report_)));
  EXPECT_FALSE(mentions_no_number(configurations_csv(*report_)));
  EXPECT_FALSE(mentions_no_number(report::to_html(document_of(*report_))));
  EXPECT_TRUE(mentions_no_number("a,nan,b")) << "the check itself";
}

TEST_F(ReportTest, CsvLinesHaveAsManyFieldsAsTheHeader) {
  for (const std::string& csv : {figures_csv(*report_), configurations_csv(*report_)}) {
    std::istringstream lines{csv};
    std::size_t expected = 0;
    for (std::string line; std::getline(lines, line);) {
      bool quoted = false;
      std::size_t fields = 1;
      for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) ++fields;
      }
      EXPECT_FALSE(quoted) << line;
      if (expected == 0) expected = fields;
      EXPECT_EQ(fields, expected) << line;
    }
  }
}

TEST_F(ReportTest, JsonHasEveryCaseWithExactTimes) {
  const auto json = nlohmann::json::parse(to_json(*report_).dump());
  EXPECT_TRUE(document_of(*report_).complete);
  EXPECT_EQ(json["cases"].size(), report_->results.plan.cases.size());
  EXPECT_EQ(json["configurations"].size(), 5U * 90);
  for (const auto& one : json["cases"]) {
    if (one["network"] == "wireless" && one["participants_per_host"] == 5 &&
        one["endpoints_per_participant"] == 20 && one["order"] == "fifo_uplink" &&
        one["heartbeat_policy"] == "periodic") {
      EXPECT_EQ(one["samples"][0]["t_disc_ns"], 100'000'000);
      EXPECT_EQ(one["counts"]["total"], 50);
    }
  }
}

TEST_F(ReportTest, ThePageIsWellFormedAndNeedsNothingElse) {
  const std::string html = report::to_html(document_of(*report_));
  EXPECT_EQ(report::html_fault(html), "");
  EXPECT_EQ(report::outside_requests(html), std::vector<std::string>{});
  EXPECT_NE(html.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_EQ(html.find("id=\"arrow\""), std::string::npos) << "would be there many times";
}

TEST_F(ReportTest, ReasonsThatAreLinkedExist) {
  const std::string html = report::to_html(document_of(*report_));
  const std::regex link{"href=\"#(reason-[0-9]+)\""};
  std::size_t links = 0;
  for (std::sregex_iterator it{html.begin(), html.end(), link}, end; it != end; ++it, ++links) {
    EXPECT_NE(html.find("id=\"" + (*it)[1].str() + "\""), std::string::npos);
  }
  EXPECT_GT(links, 50U);
}

TEST_F(ReportTest, AnInterruptedReportSaysSo) {
  Results results = report_->results;
  results.outcomes.clear();
  results.complete = false;
  const Report report = report_of(report_->published, std::move(results));
  EXPECT_NE(report::to_text(document_of(report)).find("Interrupted"), std::string::npos);
  EXPECT_NE(report::to_html(document_of(report)).find("Interrupted"), std::string::npos);
  EXPECT_FALSE(document_of(report).complete);
  for (const Figure& one : report.figures) {
    for (const ModelValue& model : one.models) EXPECT_TRUE(model.values.empty());
  }
  EXPECT_FALSE(mentions_no_number(report::to_text(document_of(report)) +
                                  report::to_html(document_of(report))));
}

TEST_F(ReportTest, IsMadeWithoutAnyVariant) {
  const Report report =
      report_of(report_->published, made_up(plan_of(report_->published, {{"none"}, 1})));
  EXPECT_TRUE(report.results.plan.variants.empty());
  EXPECT_NE(report::to_text(document_of(report)).find("23,858.1"), std::string::npos);
  EXPECT_FALSE(report::to_html(document_of(report)).empty());
}

TEST(Numbers, AreWrittenForPeople) {
  EXPECT_EQ(number_text(1850.0), "1,850");
  EXPECT_EQ(number_text(23858.1), "23,858");
  EXPECT_EQ(number_text(0.0163), "0.016");
  EXPECT_EQ(number_text(-0.436), "-0.436");
  EXPECT_EQ(number_text(std::nullopt), "–");
  EXPECT_EQ(published_text({23858.1}), "23,858.1");
  EXPECT_EQ(published_text({-25.3}), "-25.3");
  EXPECT_EQ(published_text({15.7, 18.4}), "15.7 … 18.4");
  EXPECT_EQ(ratio_text(1.7333), "1.73 ×");
  EXPECT_EQ(ratio_text(0.0041), "0.004 ×");
  EXPECT_EQ(ratio_text(-1e-9), "0 ×");
  EXPECT_EQ(ratio_text(std::nullopt), "–");
  EXPECT_EQ(distance_text(25.34), "+25.3 pt");
  EXPECT_EQ(distance_text(-0.01), "0 pt");
}

/// The gain of the paper's proposal comes before any count of figures.
TEST_F(ReportTest, LeadsWithTheMainResult) {
  const std::string text = report::to_text(document_of(*report_));
  const std::string answer = text.substr(0, text.find("; "));
  EXPECT_NE(answer.find("change completion by -39.7 to -25.3 %, published, and by -50.0 to -50.0"),
            std::string::npos)
      << answer;
}

TEST_F(ReportTest, PercentagesDifferByPoints) {
  const std::string text = report::to_text(document_of(*report_));
  const std::size_t row = text.find("np1.completion_change_pct");
  ASSERT_NE(row, std::string::npos);
  const std::string entry = text.substr(row, text.find("np1.messages", row) - row);
  EXPECT_NE(entry.find("-24.7 pt"), std::string::npos) << entry;
  EXPECT_EQ(entry.find("×"), std::string::npos) << entry;
}

}  // namespace report_test
}  // namespace stormproof::reproduce
