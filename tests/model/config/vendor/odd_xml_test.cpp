// What the vendors' own parsers take although it is no XML is read, with a remark; and each vendor
// is given only what its parser takes. Variables have the defaults of the file.
#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/config/vendor/reference.hpp"
#include "model/config/vendor/variables.hpp"
#include "model/config/vendor/vendor_profile.hpp"

namespace odd_xml_test {

using namespace stormproof::model::config;
using namespace stormproof::model::config::vendor;

const std::string participant =
    "<profiles>\n<participant profile_name=\"p\"><rtps><builtin><discovery_config>"
    "<leaseAnnouncement><sec>7</sec></leaseAnnouncement></discovery_config></builtin></rtps>"
    "</participant></profiles>";

/// "path value; rule at place; …", of what sets knobs, or the error.
std::string reading(const std::string& text) {
  auto document = parse_vendor_xml(text, "f.xml");
  if (!document) return to_string(document.error());
  const auto profile = read_vendor_profile(*std::move(document), {});
  if (!profile) return to_string(profile.error());
  std::string shown;
  for (const Setting& one : profile->settings) {
    if (one.effect == Effect::knob) shown += one.path + " " + one.value + "; ";
  }
  for (const Remark& one : profile->remarks) {
    if (one.rule.starts_with("xml.")) shown += one.rule + " " + one.place.to_string() + "; ";
  }
  return shown;
}

TEST(OddXml, FastDdsTakesHyphensBlanksAndASecondRoot) {
  const std::string read = "rtps/builtin/discovery_config/leaseAnnouncement 7s; ";
  EXPECT_EQ(reading("<dds>" + participant + "</dds>"), read);
  EXPECT_EQ(reading("<!-- a -- b -->\n<dds>" + participant + "</dds>"),
            read + "xml.not-well-formed f.xml:1:1; ");
  EXPECT_EQ(reading("<dds><!-- end --->" + participant + "</dds>"),
            read + "xml.not-well-formed f.xml:1:6; ");
  EXPECT_EQ(reading("\n  <?xml version=\"1.0\" ?>\n<dds>" + participant + "</dds>"),
            read + "xml.not-well-formed f.xml:1:1; ");
  EXPECT_EQ(reading("<?xml version=\"1.0\" ?>\n<license>ours</license>\n" + participant),
            read + "xml.second-root f.xml:3:1; ");
  EXPECT_EQ(reading("<dds>" + participant + "</dds>\n<!-- -- --><license/>"),
            read + "xml.not-well-formed f.xml:3:1; xml.second-root f.xml:3:12; ");
}

TEST(OddXml, FastDdsRefusesWhatOnlyCycloneTakes) {
  EXPECT_TRUE(reading("<dds>" + participant + "</>").starts_with("f.xml:2:178: not valid XML: "));
  EXPECT_NE(reading("<dds>" + participant).find("it ends inside <dds>"), std::string::npos);
}

TEST(OddXml, CycloneTakesMoreInItsVariable) {
  const std::string read = "Internal/NackDelay 10 ms; ";
  const std::string group = "<Internal><NackDelay>10 ms</NackDelay></Internal>";
  EXPECT_EQ(reading("<CycloneDDS><Domain>" + group + "</Domain></CycloneDDS>"), read);
  EXPECT_EQ(reading("<CycloneDDS><Domain><Internal><NackDelay>10 ms</></></></>"),
            read +
                "xml.inline-only f.xml:1:47; xml.inline-only f.xml:1:50; xml.inline-only "
                "f.xml:1:53; xml.inline-only f.xml:1:56; ");
  EXPECT_EQ(reading("<CycloneDDS><Domain>" + group), read + "xml.inline-only f.xml:1:70; ");
  EXPECT_EQ(reading(group), read + "xml.inline-only f.xml:1:1; ");
  EXPECT_EQ(reading("<Domain>" + group + "</Domain>"), read + "xml.inline-only f.xml:1:1; ");
  EXPECT_TRUE(reading("<General><AllowMulticast>spdp</></>" + group)
                  .starts_with("General/AllowMulticast spdp; " + read));
}

TEST(OddXml, WhatIsWrongBesidesIsStillAnErrorAtItsPlace) {
  EXPECT_EQ(reading("<!-- -- -->\n<dds><profiles></dds>"),
            "f.xml:2:18: not valid XML: the end tag is not that of <profiles>, which begins at "
            "line 2, column 6");
  EXPECT_EQ(reading("<!-- -- --><!DOCTYPE x><dds/>"),
            "f.xml:1:12: a document type declaration (<!DOCTYPE>); expected XML without one, "
            "because entities are never resolved");
  EXPECT_EQ(reading("<!-- a -- b"), "f.xml:1:10: not valid XML: not well-formed (invalid token)");
}

TEST(OddXml, ALocatorListWithoutLocatorsIsAnErrorOfTheLibraryNotOfTheReader) {
  auto document = parse_vendor_xml(
      "<profiles><participant profile_name=\"p\"><rtps><builtin>\n<initialPeersList/></builtin>"
      "</rtps></participant></profiles>",
      "f.xml");
  const auto profile = read_vendor_profile(*std::move(document), {});
  ASSERT_TRUE(profile);
  const auto remark = std::ranges::find(profile->remarks, "fastdds.empty-list", &Remark::rule);
  ASSERT_NE(remark, profile->remarks.end());
  EXPECT_EQ(remark->severity, Severity::error);
  EXPECT_EQ(remark->place.to_string(), "f.xml:2:1");
}

RC_GTEST_PROP(OddXml, MendingNeverLosesPlaces, ()) {
  const auto pieces = *rc::gen::container<std::vector<std::string>>(
      rc::gen::element<std::string>("<a>", "</>", "</a>", "<!-- -- -->", " ", "<b c='>'/>", "x",
                                    "<?xml ?>", "<![CDATA[</>]]>", "<"));
  std::string text;
  for (const std::string& piece : pieces) text += piece;
  const MendedXml mended = mend_xml(text);
  std::size_t before = 0;
  for (std::size_t k = 0; k <= mended.text.size(); ++k) {
    const std::size_t original = mended.original(k);
    RC_ASSERT(original >= before);
    RC_ASSERT(original <= text.size());
    before = original;
  }
  if (mended.oddities.empty()) RC_ASSERT(mended.text == text);
}

TEST(OddXml, AReferenceMayBeTheConfigurationItself) {
  const auto parts = parse_reference("<General><AllowMulticast>false</></>#3@cyclonedds-0.10");
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->file, "");
  EXPECT_EQ(parts->text, "<General><AllowMulticast>false</></>");
  EXPECT_EQ(parts->selection.profile, "3");
  EXPECT_EQ(parts->selection.base, "cyclonedds-0.10");
  EXPECT_EQ(parse_reference("file:///etc/cyclone.xml")->file, "/etc/cyclone.xml");
}

TEST(OddXml, DomainsAreListed) {
  const auto domains = [](const std::string& text) {
    return domains_of(*parse_vendor_xml(text, "f.xml"));
  };
  EXPECT_EQ(domains("<CycloneDDS><Domain Id=\"2\"/><Domain/><Domain Id=\"0\"/><Domain Id=\"2\"/>"
                    "</CycloneDDS>"),
            (std::vector<std::string>{"2", "0"}));
  EXPECT_TRUE(domains("<dds/>").empty());
}

TEST(Variables, HaveTheDefaultsOfTheFile) {
  const auto text = [](const char* of) {
    const auto expanded = expand_variables(of);
    return expanded ? expanded->text : "error: " + expanded.error();
  };
  EXPECT_EQ(text("10 ms"), "10 ms");
  EXPECT_EQ(text("${HOME}"), "");  // nobody looks at the environment
  EXPECT_EQ(text("a${X:-b}c"), "abc");
  EXPECT_EQ(text("${X:-${Y:-deep}}"), "deep");
  EXPECT_EQ(text("${X:+never}"), "");
  EXPECT_EQ(text("$X"), "$X");
  EXPECT_EQ(text("${X:?must be set}"), "error: variable X is not set: must be set");
  EXPECT_EQ(text("${X:-"), "error: ${ without its }");
  EXPECT_EQ(text("${X:=1}"), "error: ':=' in an expansion; expected :-, :+ or :?");
  std::string nested = "end";
  for (int k = 0; k < 25; ++k) nested = "${X:-" + nested + "}";
  EXPECT_EQ(text(nested.c_str()), "error: variables are nested too deeply");
  EXPECT_EQ(expand_variables("${A:-1}${B}")->variables, (std::vector<std::string>{"A", "B"}));
}

}  // namespace odd_xml_test
