// The schemas in specs/schema are what the knob tables say. To renew them after a change of a
// table, run this test with STORMPROOF_WRITE_SCHEMAS=1 in the environment.
#include "model/config/knobs/json_schema.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stormproof::model::config {
namespace json_schema_test {

class JsonSchema : public testing::TestWithParam<SchemaKind> {};

TEST_P(JsonSchema, the_file_in_specs_is_up_to_date) {
  const std::string path =
      std::string{STORMPROOF_SPECS_DIR} + "/schema/" + schema_file_name(GetParam());
  if (std::getenv("STORMPROOF_WRITE_SCHEMAS") != nullptr)
    std::ofstream{path} << json_schema(GetParam());
  std::ifstream file{path};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  EXPECT_EQ(text, json_schema(GetParam()))
      << path << " is out of date; see the first lines of this test";
}

INSTANTIATE_TEST_SUITE_P(All, JsonSchema,
                         testing::Values(SchemaKind::scenario, SchemaKind::dds,
                                         SchemaKind::wireless),
                         [](const auto& tested) {
                           const std::string name = schema_file_name(tested.param);
                           return name.substr(0, name.find('.'));
                         });

TEST(JsonSchemaContent, a_profile_needs_every_key_or_a_base) {
  const auto schema = nlohmann::json::parse(json_schema(SchemaKind::dds));
  EXPECT_EQ(schema["if"]["not"]["required"], nlohmann::json::array({"base"}));
  const auto& paper = schema["then"]["else"]["else"];
  EXPECT_EQ(paper["required"], nlohmann::json::array({"spdp", "sedp", "descriptors"}));
  EXPECT_EQ(paper["properties"]["sedp"]["properties"]["adaptive"]["required"].size(), 3U);
  EXPECT_FALSE(schema.contains("required"));
}

TEST(JsonSchemaContent, fast_dds_needs_fewer_keys_and_forbids_the_others) {
  const auto schema = nlohmann::json::parse(json_schema(SchemaKind::dds));
  const auto is_fastdds = nlohmann::json::parse(
      R"({"required": ["implementation"], "properties": {"implementation": {"const": "fastdds"}}})");
  EXPECT_EQ(schema["then"]["else"]["if"], is_fastdds);
  const auto& fastdds = schema["then"]["else"]["then"];
  EXPECT_EQ(fastdds["required"], nlohmann::json::array({"spdp", "sedp"}));
  EXPECT_EQ(fastdds["properties"]["spdp"]["required"].size(), 4U);
  EXPECT_EQ(fastdds["properties"]["sedp"]["required"].size(), 9U);

  ASSERT_EQ(schema["allOf"].size(), 3U);  // one for each implementation that is named
  EXPECT_EQ(schema["allOf"][1]["if"], is_fastdds);
  const auto& forbidden = schema["allOf"][1]["then"]["properties"];
  EXPECT_EQ(forbidden["descriptors"], false);
  EXPECT_EQ(forbidden["allow_multicast"], false);
  EXPECT_EQ(forbidden["spdp"]["properties"], nlohmann::json({{"payload_bytes", false},
                                                             {"initial_prune_delay", false},
                                                             {"discovered_prune_delay", false},
                                                             {"directed_replies", false},
                                                             {"directed_reply_interval", false}}));
  EXPECT_EQ(forbidden["sedp"]["properties"].size(), 12U + 12U);
  EXPECT_EQ(forbidden.count("unmodelled"), 0U);
  EXPECT_EQ(schema["properties"]["unmodelled"]["additionalProperties"]["type"], "string");
}

TEST(JsonSchemaContent, cyclone_dds_needs_its_own_keys_and_forbids_the_others) {
  const auto schema = nlohmann::json::parse(json_schema(SchemaKind::dds));
  EXPECT_EQ(schema["then"]["if"]["properties"]["implementation"]["const"], "cyclone");
  const auto& cyclone = schema["then"]["then"];
  EXPECT_EQ(cyclone["required"], nlohmann::json::array({"allow_multicast", "spdp", "sedp"}));
  EXPECT_EQ(cyclone["properties"]["spdp"]["required"].size(), 4U);
  EXPECT_EQ(cyclone["properties"]["sedp"]["required"].size(), 10U);
  const auto& forbidden = schema["allOf"][2]["then"]["properties"];
  EXPECT_EQ(forbidden["spdp"]["properties"].size(), 3U);
  EXPECT_EQ(forbidden["sedp"]["properties"]["heartbeat_period"], false);
  EXPECT_FALSE(forbidden.contains("allow_multicast"));
  const auto& sedp = schema["properties"]["sedp"]["properties"];
  EXPECT_TRUE(sedp.contains("heartbeat_interval") && sedp.contains("heartbeat_period"));
  EXPECT_EQ(schema["properties"]["allow_multicast"]["enum"],
            nlohmann::json::array({true, "spdp", "default", false}));
}

TEST(JsonSchemaContent, both_forms_of_a_deployment_take_a_schedule) {
  const auto schema = nlohmann::json::parse(json_schema(SchemaKind::scenario));
  for (const auto& form : schema["properties"]["deployment"]["oneOf"]) {
    EXPECT_TRUE(form["properties"].contains("loopback_delay"));
    const auto& schedule = form["properties"]["schedule"];
    EXPECT_EQ(schedule["properties"].size(), 4U);
    EXPECT_EQ(schedule["required"], nlohmann::json::array());
    EXPECT_LE(form["required"].size(), 3U);
  }
}

TEST(JsonSchemaContent, a_constant_delay_needs_no_channel) {
  const auto schema = nlohmann::json::parse(json_schema(SchemaKind::wireless));
  EXPECT_EQ(schema["then"]["if"]["properties"]["kind"]["const"], "constant_delay");
  EXPECT_EQ(schema["then"]["then"]["required"], nlohmann::json::array({"kind", "one_way"}));
  EXPECT_EQ(schema["then"]["else"]["else"]["required"].size(), 11U);
}

TEST(JsonSchemaContent, units_need_no_stages_and_forbid_them) {
  const auto schema = nlohmann::json::parse(json_schema(SchemaKind::wireless));
  const auto& channels = schema["then"]["else"];
  EXPECT_EQ(channels["if"]["properties"]["service"]["const"], "unit");
  EXPECT_EQ(channels["then"]["required"].size(), 8U);
  const auto& forbidden = schema["allOf"];
  EXPECT_EQ(forbidden[0]["then"]["properties"],
            nlohmann::json({{"order", false}, {"stages", false}}));
  EXPECT_EQ(forbidden[1]["if"]["properties"]["service"]["const"], "frame");
  EXPECT_EQ(forbidden[1]["then"]["properties"].size(), 6U);
  EXPECT_TRUE(schema["properties"].contains("aggregation"));
}

}  // namespace json_schema_test
}  // namespace stormproof::model::config
