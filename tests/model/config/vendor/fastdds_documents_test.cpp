// Laws of every Fast DDS document that the table of elements allows: it is read or refused with a
// place, each of its settings is accounted for once, and what describes a run is a valid profile.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/config/vendor/fastdds_schema.hpp"
#include "tests/model/config/test_files.hpp"
#include "tests/model/config/vendor/fastdds_document.hpp"

namespace stormproof::model::config::vendor {
namespace fastdds_documents_test {

using fastdds::SchemaItem;
using fastdds::ValueKind;

rc::Gen<std::string> word(std::vector<std::string> words) {
  return rc::gen::elementOf(std::move(words));
}

std::vector<std::string> choices_of(const SchemaItem& item) {
  std::vector<std::string> words{std::string{item.standard}};
  std::string_view rest = item.choices;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('|'), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(rest.size(), end + 1));
  }
  return words;
}

/// Text of an element of this kind: in a tame document one that the library takes.
std::string value_of(const SchemaItem& item, bool is_tame) {
  using Words = std::vector<std::string>;
  switch (item.kind) {
    case ValueKind::flag:
      return *word(is_tame ? Words{"true", "1"} : Words{"true", "false", "0", "perhaps"});
    case ValueKind::uint16:
    case ValueKind::uint8:
      return *word(is_tame ? Words{"1", "5", "250"} : Words{"0", "255", "256", "65536", "-1"});
    case ValueKind::uint32:
    case ValueKind::int32:
      return *word(is_tame ? Words{"65500", "70000", "400000"}
                           : Words{"0", "5", "251", "252", "499", "1472", "65501", "4294967295",
                                   "-1", "1 kB", ""});
    case ValueKind::duration:
      return *word(is_tame ? Words{"<sec>4</sec>", "<sec>3</sec><nanosec>1</nanosec>"}
                           : Words{"<sec>0</sec>", "<nanosec>1</nanosec>", "DURATION_INFINITY",
                                   "<sec>-1</sec><nanosec>4294967295</nanosec>",
                                   "<sec>2147483647</sec><nanosec>4294967295</nanosec>",
                                   "<sec>0.5</sec>", "7"});
    case ValueKind::choice:
    case ValueKind::choices:
      return is_tame && !item.standard.empty() ? std::string{item.standard}
                                               : *word(choices_of(item));
    case ValueKind::locators:
      return "<locator><udpv4><address>10.0.0.2</address><port>7400</port></udpv4></locator>";
    case ValueKind::addresses:
      return is_tame ? "<address>10.0.0.2</address>"
                     : *word({"", "<address>127.0.0.1</address>", "<address>::1</address>"});
    case ValueKind::transports:
      return *word(is_tame ? Words{"<transport_id>t</transport_id>"}
                           : Words{"<transport_id>t</transport_id>", "<transport_id/>",
                                   "<transport_id>u</transport_id>"});
    case ValueKind::properties:
      return "<properties><property><name>" +
             *word({"fastdds.max_message_size", "dds.sec.auth.plugin", "fastdds.push_mode", "a"}) +
             "</name><value>" + *word({"1472", "65501", "x", "0"}) +
             "</value></property></properties>";
    case ValueKind::text:
    case ValueKind::opaque:
    case ValueKind::group:
      return "text";
  }
  return {};
}

/// Elements below `path`, each with a chance of one in `rarity`.
std::string elements(std::span<const SchemaItem> schema, const std::string& path, int rarity,
                     bool is_tame) {
  std::string text;
  for (const SchemaItem& item : schema) {
    const std::string prefix = path.empty() ? "" : path + "/";
    const bool is_child = item.path.starts_with(prefix) &&
                          item.path.find('/', prefix.size()) == std::string_view::npos;
    if (!is_child || item.name() == "transport_id" || item.name() == "type") continue;
    if (is_tame && item.since > fastdds::oldest_version) continue;
    const bool is_group = item.kind == ValueKind::group;
    if (!is_group && *rc::gen::inRange(0, rarity) != 0) continue;
    const std::string content = is_group ? elements(schema, std::string{item.path}, rarity, is_tame)
                                         : value_of(item, is_tame);
    text += fmt::format("<{0}>{1}</{0}>\n", item.name(), content);
  }
  return text;
}

std::string any_document() {
  const int rarity = *rc::gen::elementOf(std::vector<int>{4, 15, 40});
  const bool is_tame = *rc::gen::inRange(0, 3) != 0;
  const std::string type = is_tame ? "UDPv4" : *word({"UDPv4", "UDPv6", "TCPv4", "SHM"});
  return fmt::format(
      "<dds><profiles>{}<participant profile_name='p' is_default_profile='true'>{}"
      "</participant></profiles></dds>",
      transport("t", type, elements(fastdds::transport_schema(), "", rarity, is_tame)),
      elements(fastdds::participant_schema(), "", rarity, is_tame));
}

bool has_errors(const VendorProfile& profile) {
  return std::ranges::any_of(
      profile.remarks, [](const Remark& remark) { return remark.severity == Severity::error; });
}

RC_GTEST_PROP(FastddsDocuments, are_refused_with_a_place_or_become_a_valid_profile, ()) {
  const std::string text = any_document();
  const auto profile = read_fastdds(text);
  if (!profile) {
    RC_ASSERT(profile.error().where.starts_with("f.xml:"));
    RC_ASSERT(!profile.error().message.empty());
    return;
  }
  std::vector<std::string> keys;
  for (const Setting& one : profile->settings) {
    RC_ASSERT((one.effect == Effect::knob) == !one.knob.empty());
    RC_ASSERT(!one.note.empty() || one.effect == Effect::none);
    if (one.effect == Effect::knob) keys.push_back(one.knob);
    if (one.effect == Effect::unknown || one.effect == Effect::outside) {
      RC_ASSERT(has_errors(*profile));
    }
  }
  std::ranges::sort(keys);
  RC_ASSERT(std::ranges::adjacent_find(keys) == keys.end());
  const TestFiles files{};
  const std::string path = files.write("f.xml", text);
  const auto read = read_dds_profile(path, {}, source_specs());
  RC_ASSERT(bool{read} != has_errors(*profile));
}

TEST(FastddsDocuments, the_shipped_large_send_buffer_is_the_preset_of_it) {
  const std::string file =
      std::string{STORMPROOF_SPECS_DIR} + "/vendor/fastdds/large-send-buffer.xml";
  const auto xml = read_dds_profile(file, {}, source_specs());
  const auto preset = read_dds_profile("fastdds-2.6.11-sndbuf4M", {}, source_specs());
  ASSERT_TRUE(xml) << to_string(xml.error());
  ASSERT_TRUE(preset);
  EXPECT_EQ(*xml, *preset);
}

TEST(FastddsDocuments, what_is_written_out_of_the_defaults_is_the_default_preset) {
  const std::string file = std::string{STORMPROOF_SPECS_DIR} + "/vendor/fastdds/humble-default.xml";
  const auto xml = read_dds_profile(file, {}, source_specs());
  const auto preset = read_dds_profile("fastdds-2.6.11", {}, source_specs());
  ASSERT_TRUE(xml) << to_string(xml.error());
  ASSERT_TRUE(preset);
  EXPECT_EQ(*xml, *preset);
}

}  // namespace fastdds_documents_test
}  // namespace stormproof::model::config::vendor
