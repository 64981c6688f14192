// XML text to tree: what is kept, with which places, and how hostile or broken text is refused.
#include "model/config/vendor/xml_text.hpp"

#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config::vendor {
namespace xml_text_test {

XmlElement parsed(std::string_view text) {
  auto root = parse_xml(text, "f.xml");
  EXPECT_TRUE(root) << (root ? "" : to_string(root.error()));
  return root ? *root : XmlElement{};
}

std::string error_of(std::string_view text) {
  const auto root = parse_xml(text, "f.xml");
  return root ? "accepted" : to_string(root.error());
}

std::string repeated(std::string_view text, std::size_t times) {
  std::string all;
  for (std::size_t k = 0; k < times; ++k) all += text;
  return all;
}

TEST(XmlText, elements_attributes_and_text_are_kept_in_order) {
  const XmlElement root = parsed("<a x='1' y='&lt;2'><b> one </b><c/><b>two</b></a>");
  EXPECT_EQ(root.name, "a");
  ASSERT_EQ(root.children.size(), 3U);
  EXPECT_EQ(root.children[0].text, "one");
  EXPECT_EQ(root.children[2].text, "two");
  EXPECT_EQ(root.find("b"), &root.children[0]);
  EXPECT_EQ(root.find("d"), nullptr);
  ASSERT_NE(root.attribute("y"), nullptr);
  EXPECT_EQ(*root.attribute("y"), "<2");
  EXPECT_EQ(root.attribute("z"), nullptr);
}

TEST(XmlText, text_is_joined_over_comments_children_and_cdata) {
  const XmlElement root = parsed("<a> 1<!-- no -->2<![CDATA[<3>]]><b/>&amp;&#52; </a>");
  EXPECT_EQ(root.text, "12<3>&4");
}

TEST(XmlText, places_are_lines_and_bytes) {
  const XmlElement root = parsed("<?xml version='1.0'?>\n<a>\n  <é>\n    3 s</é><b>x</b></a>");
  EXPECT_EQ(root.place.to_string(), "f.xml:2:1");
  EXPECT_EQ(root.children[0].place.to_string(), "f.xml:3:3");
  EXPECT_EQ(root.children[0].text_place.to_string(), "f.xml:4:5");
  EXPECT_EQ(root.children[1].place.to_string(), "f.xml:4:13");  // é has two bytes
  EXPECT_EQ(root.children[1].text_place.to_string(), "f.xml:4:16");
}

TEST(XmlText, an_element_without_text_has_its_own_place_for_it) {
  const XmlElement root = parsed("<a>\n <b>  </b></a>");
  EXPECT_EQ(root.children[0].text, "");
  EXPECT_EQ(root.children[0].text_place.to_string(), "f.xml:2:2");
}

TEST(XmlText, line_ends_of_all_systems_count) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const XmlElement root = parsed("<a>" + end + "<b>" + end + " x</b></a>");
    EXPECT_EQ(root.children[0].place.to_string(), "f.xml:2:1");
    EXPECT_EQ(root.children[0].text_place.to_string(), "f.xml:3:2");
    EXPECT_EQ(root.children[0].text, "x");
  }
}

TEST(XmlText, a_byte_order_mark_has_no_column) {
  const XmlElement root = parsed("\xEF\xBB\xBF<a><b/></a>");
  EXPECT_EQ(root.place.to_string(), "f.xml:1:1");
  EXPECT_EQ(root.children[0].place.to_string(), "f.xml:1:4");
}

TEST(XmlText, names_lose_their_namespace) {
  const XmlElement root =
      parsed("<p:dds xmlns:p='urn:x' xmlns='urn:y' xsi:schemaLocation='z' k='v'><p:q/></p:dds>");
  EXPECT_EQ(root.name, "dds");
  EXPECT_EQ(root.children[0].name, "q");
  ASSERT_EQ(root.attributes.size(), 1U);
  EXPECT_EQ(root.attributes[0].name, "k");
}

TEST(XmlText, other_encodings_become_utf8) {
  EXPECT_EQ(parsed("<?xml version='1.0' encoding='ISO-8859-1'?><a>\xE9</a>").text, "é");
  std::string wide = "\xFF\xFE";
  for (const char c : std::string{"<a>\n<b/></a>"}) wide += {c, '\0'};
  const XmlElement root = parsed(wide);
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.children[0].place.to_string(), "f.xml:2:1");
}

struct Broken {
  std::string text;
  std::string error;
};

class BrokenXml : public testing::TestWithParam<Broken> {};

TEST_P(BrokenXml, is_refused_with_its_place) {
  EXPECT_EQ(error_of(GetParam().text), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    XmlText, BrokenXml,
    testing::Values(
        Broken{"", "f.xml:1:1: nothing in it"}, Broken{" \n ", "f.xml:2:2: nothing in it"},
        Broken{"text", "f.xml:1:1: not valid XML: syntax error"},
        Broken{"<a>\n<b>",
               "f.xml:2:4: not valid XML: it ends inside <b>, which begins at line 2, "
               "column 1"},
        Broken{"<a>\n <b></a>",
               "f.xml:2:7: not valid XML: the end tag is not that of <b>, which "
               "begins at line 2, column 2"},
        Broken{"<a/>\n<b/>",
               "f.xml:2:1: not valid XML: something follows the root element; "
               "expected only one"},
        Broken{"<a>&who;</a>", "f.xml:1:4: not valid XML: an entity that nothing declares"},
        Broken{"<a>\xC3(</a>", "f.xml:1:4: not valid XML: byte 0xc3 is not valid UTF-8"},
        Broken{"<a>\xED\xA0\x80</a>", "f.xml:1:4: not valid XML: byte 0xed is not valid UTF-8"},
        Broken{"<a>\n" + std::string(1, '\0') + "</a>",
               "f.xml:2:1: not valid XML: control character 0x00"},
        Broken{"<a x='1' x='2'/>", "f.xml:1:10: not valid XML: duplicate attribute"},
        Broken{"<?xml version='1.0' encoding='martian'?><a/>",
               "f.xml:1:31: not valid XML: unknown encoding"}));

TEST(XmlText, a_document_type_is_refused_before_any_entity) {
  const std::string expected =
      "a document type declaration (<!DOCTYPE>); expected XML without one, because entities are "
      "never resolved";
  EXPECT_EQ(error_of("<?xml version='1.0'?>\n <!DOCTYPE a>\n<a/>"), "f.xml:2:2: " + expected);
  EXPECT_EQ(error_of("<!DOCTYPE a SYSTEM 'file:///etc/passwd'><a/>"), "f.xml:1:1: " + expected);
  EXPECT_EQ(error_of("<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><a>&x;</a>"),
            "f.xml:1:1: " + expected);
  EXPECT_EQ(error_of("<!DOCTYPE a [<!ENTITY x '" + std::string(1000, 'x') +
                     "'><!ENTITY y '&x;&x;&x;&x;'>]><a>&y;</a>"),
            "f.xml:1:1: " + expected);
}

TEST(XmlText, depth_elements_and_size_are_limited) {
  const auto nested = [](std::size_t depth) {
    return repeated("<a>", depth) + repeated("</a>", depth);
  };
  EXPECT_EQ(error_of(nested(max_xml_depth)), "accepted");
  EXPECT_EQ(error_of(nested(max_xml_depth + 1)), "f.xml:1:193: nested more than 64 levels deep");
  EXPECT_EQ(error_of(nested(300'000)), "f.xml:1:193: nested more than 64 levels deep");

  EXPECT_EQ(error_of("<r>" + repeated("<a/>", max_xml_elements - 1) + "</r>"), "accepted");
  EXPECT_EQ(error_of("<r>\n" + repeated("<a/>", max_xml_elements) + "</r>"),
            "f.xml:2:399997: more than 100000 elements");

  const std::string frame = "<a></a>";
  const std::string full = "<a>" + std::string(max_xml_bytes - frame.size(), 'x') + "</a>";
  EXPECT_EQ(error_of(full), "accepted");
  EXPECT_EQ(error_of(full + "\n"), "f.xml: longer than 4194304 bytes");
}

TEST(XmlText, files_are_read_and_what_is_none_is_refused) {
  const TestFiles files{};
  const std::string good = files.write("good.xml", "<a/>");
  const auto root = load_xml(good);
  ASSERT_TRUE(root);
  EXPECT_EQ(root->roots.front().place.to_string(), good + ":1:1");

  const auto refused = [](const std::string& path) {
    const auto read = load_xml(path);
    return read ? "accepted" : to_string(read.error());
  };
  EXPECT_EQ(refused(files.path("none.xml")), files.path("none.xml") + ": cannot be read");
  EXPECT_EQ(refused(files.root()), files.root() + ": is a directory; expected a file");
  EXPECT_EQ(refused("/dev/zero"), "/dev/zero: longer than 4194304 bytes");
}

RC_GTEST_PROP(XmlText, any_bytes_are_a_tree_or_an_error_with_a_place,
              (const std::vector<std::uint8_t>& bytes)) {
  const auto root = parse_xml(std::string{bytes.begin(), bytes.end()}, "f.xml");
  if (!root) {
    RC_ASSERT(root.error().where.starts_with("f.xml:"));
    RC_ASSERT(!root.error().message.empty());
  }
}

TEST(XmlText, names_are_bounded) {
  const std::string longest(max_xml_name_bytes, 'a');
  EXPECT_EQ(error_of("<" + longest + " " + longest + "=''/>"), "accepted");
  EXPECT_EQ(error_of("<" + longest + "a/>"),
            "f.xml:1:1: a name of 257 bytes; expected 256 at most");
  EXPECT_EQ(error_of("<r>\n<a " + longest + "a=''/></r>"),
            "f.xml:2:1: a name of 257 bytes; expected 256 at most");
}

RC_GTEST_PROP(XmlText, a_cut_text_is_never_accepted, ()) {
  const std::string whole =
      "<?xml version='1.0'?><dds><a k='v'>text &amp; <!-- c --><b/></a></dds>";
  const auto length = *rc::gen::inRange<std::size_t>(0, whole.size());
  RC_ASSERT(!parse_xml(whole.substr(0, length), "f.xml"));
}

}  // namespace xml_text_test
}  // namespace stormproof::model::config::vendor
