// The visitor that turns tables into schemas. A schema states keys, types and ranges; conditions
// over several keys and the exact ranges of durations and rates are left to the program.
#include "model/config/knobs/json_schema.hpp"

#include <fmt/core.h>

#include "model/config/knobs/knob_writer.hpp"
#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {
namespace {

Json name_or(const Json& map_schema) {
  const Json name = {{"type", "string"}, {"minLength", 1}};
  return {{"anyOf", Json::array({name, map_schema})}};
}

Json reference(const std::string& target) { return {{"$ref", target}}; }

/// Collects the properties of a map and which of them are required.
class SchemaVisitor {
 public:
  void knob(std::string_view key, auto&&, const auto& type, std::string_view doc,
            Presence presence = Presence::required) {
    if (exclude(key, presence)) return;
    add(key, fmt::format("{}; {}", doc, type.expected()), schema_of(type), presence);
  }
  template <class Section>
  void section(std::string_view key, const Section& member, std::string_view doc,
               Presence presence = Presence::required, const auto&... context);
  template <class Item>
  void list(std::string_view key, const std::vector<Item>&, ListSize size, std::string_view doc,
            Presence presence = Presence::required);
  void rule(bool, std::string_view, std::string_view) {}

  /// The map with all its keys, none of them required.
  Json partial() const {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
  }
  /// The map with its required keys.
  Json complete() const {
    Json schema = partial();
    schema.update(requirements());
    return schema;
  }
  /// Only what is required, here and in the sections.
  Json requirements() const {
    Json schema = {{"required", required_}};
    if (!of_sections_.empty()) schema["properties"] = of_sections_;
    return schema;
  }

  /// What forbids the keys of another implementation, here and in the sections.
  Json exclusions() const { return {{"properties", excluded_}}; }

  Json properties = Json::object();

 private:
  bool exclude(std::string_view key, Presence presence) {
    if (presence != Presence::of_others) return false;
    excluded_[std::string{key}] = false;
    return true;
  }
  void add(std::string_view key, std::string doc, const Json& schema, Presence presence) {
    Json& property = properties[std::string{key}] = {{"description", std::move(doc)}};
    property.update(schema);
    if (presence == Presence::required) required_.push_back(std::string{key});
  }

  Json required_ = Json::array();
  Json of_sections_ = Json::object();
  Json excluded_ = Json::object();
};

SchemaVisitor visited(const auto& sample, const auto&... context) {
  SchemaVisitor visitor;
  visit_knobs(visitor, sample, context...);
  return visitor;
}

/// What a profile has beside its own keys.
void add_names(SchemaVisitor& visitor) {
  visitor.properties[std::string{base_key}] = {{"description", "the profile that this one changes"},
                                               {"type", "string"}};
  visitor.properties[std::string{description_key}] = {{"description", "free text"},
                                                      {"type", "string"}};
}

/// The short form of a deployment, with what both forms have.
SchemaVisitor visited_short_form(const Deployment& deployment) {
  SchemaVisitor visitor = visited(HomogeneousForm{});
  Json& hosts = visitor.properties[std::string{hosts_key}];
  const Json number = hosts;
  SchemaVisitor list;
  visit_hosts(list, deployment);
  hosts = {{"anyOf", Json::array({number, list.properties[std::string{hosts_key}]})}};
  visit_common_knobs(visitor, deployment);
  return visitor;
}

/// The same for a deployment by its nodes.
SchemaVisitor visited_nodes_form(const Deployment& deployment) {
  SchemaVisitor visitor = visited(NodesForm{});
  visit_common_knobs(visitor, deployment);
  return visitor;
}

template <class Section>
void SchemaVisitor::section(std::string_view key, const Section& member, std::string_view doc,
                            Presence presence, const auto&... context) {
  if (exclude(key, presence)) return;
  Json schema;
  if constexpr (std::same_as<Section, DdsProfile> || std::same_as<Section, Shared<DdsProfile>>) {
    schema = name_or(reference(schema_file_name(SchemaKind::dds)));
  } else if constexpr (std::same_as<Section, WirelessProfile>) {
    schema = name_or(reference(schema_file_name(SchemaKind::wireless)));
  } else if constexpr (std::same_as<Section, std::optional<Processor>>) {
    SchemaVisitor inner = visited(Processor{});
    add_names(inner);
    schema = name_or(inner.partial());
  } else if constexpr (std::same_as<Section, Deployment>) {
    schema["oneOf"] =
        Json::array({visited_short_form(member).complete(), visited_nodes_form(member).complete(),
                     visited(member).complete()});
  } else if constexpr (requires { typename Section::value_type; }) {  // an optional table
    schema = visited(typename Section::value_type{}).complete();
  } else {
    const SchemaVisitor inner = visited(member, context...);
    schema = inner.partial();
    of_sections_[std::string{key}] = inner.requirements();
    if (!inner.excluded_.empty()) excluded_[std::string{key}] = inner.exclusions();
  }
  add(key, std::string{doc}, schema, presence);
}

template <class Item>
void SchemaVisitor::list(std::string_view key, const std::vector<Item>&, ListSize size,
                         std::string_view doc, Presence presence) {
  if (exclude(key, presence)) return;
  const Json schema = {{"type", "array"},
                       {"minItems", size.minimum},
                       {"maxItems", size.maximum},
                       {"items", visited(Item{}).complete()}};
  add(key, std::string{doc}, schema, presence);
}

Json with_title(std::string_view title, const Json& schema) {
  Json titled = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  titled.update(schema);
  return titled;
}

void add_description(SchemaVisitor& visitor) {
  visitor.properties[std::string{description_key}] = {{"description", "free text"},
                                                      {"type", "string"}};
}

/// A profile file: everything is required unless a `base` gives the rest.
Json profile(std::string_view title, SchemaVisitor visitor, const Json& requirements) {
  add_description(visitor);
  visitor.properties[std::string{base_key}] = {
      {"description",
       "the profile that gives every key which is not here: a name, a path, or a map"}};
  visitor.properties[std::string{base_key}].update(name_or(reference("#")));
  Json schema = with_title(title, visitor.partial());
  schema["if"] = {{"not", {{"required", Json::array({base_key})}}}};
  schema["then"] = requirements;
  return schema;
}

/// Adds the keys of another implementation's map, here and in the sections.
void add_missing(Json& properties, const Json& others) {
  for (const auto& [key, schema] : others.items()) {
    if (!properties.contains(key)) {
      properties[key] = schema;
    } else if (schema.contains("properties")) {
      add_missing(properties[key]["properties"], schema["properties"]);
    }
  }
}

Json dds_schema() {
  // The key may be absent, and then it is the default one's.
  SchemaVisitor fullest = visited(DdsProfile{});
  const std::string key{implementation_key};
  Json requirements = fullest.requirements();
  Json exclusions = Json::array();
  for (const ImplementationKind kind : implementations) {
    DdsProfile other;
    other.implementation = kind;
    const SchemaVisitor keys = visited(other);
    add_missing(fullest.properties, keys.properties);
    const Json is_other = {{"required", Json::array({key})},
                           {"properties", {{key, {{"const", name_of(kind)}}}}}};
    if (kind != default_implementation) {
      requirements = {{"if", is_other}, {"then", keys.requirements()}, {"else", requirements}};
    }
    exclusions.push_back({{"if", is_other}, {"then", keys.exclusions()}});
  }
  // Which of these keys go with which way to discover is left to the program.
  for (const Discovery discovery : {Discovery::server, Discovery::static_peers}) {
    DdsProfile other;
    other.implementation = implementation_with_discovery;
    other.discovery = discovery;
    const SchemaVisitor keys = visited(other);
    add_missing(fullest.properties, keys.properties);
    Json& forbidden = exclusions[index_of(other.implementation)]["then"]["properties"];
    for (const auto& [name, property] : keys.properties.items()) {
      if (forbidden.contains(name) && forbidden[name] == false) forbidden.erase(name);
    }
  }
  Json schema = profile("DDS profile", fullest, requirements);
  schema["allOf"] = exclusions;
  return schema;
}

Json wireless_schema() {
  SchemaVisitor of_channel = visited(WirelessProfile{});
  WirelessProfile delay;
  delay.kind = ServiceKind::constant_delay;
  const SchemaVisitor of_delay = visited(delay);
  // The first knob is the kind of service; it decides which of the others are required.
  const Json written = write_knobs(delay);
  const Json is_delay = {
      {"properties", {{written.begin().key(), {{"const", written.begin().value()}}}}}};
  WirelessProfile unit;
  unit.service = ServedBy::unit;
  const SchemaVisitor of_unit = visited(unit);
  const std::string key{service_key};
  const auto is_by = [&](ServedBy service) -> Json {
    return {{"required", Json::array({key})},
            {"properties", {{key, {{"const", name_of(service)}}}}}};
  };
  const Json is_unit = is_by(ServedBy::unit);
  const Json of_channels = {
      {"if", is_unit}, {"then", of_unit.requirements()}, {"else", of_channel.requirements()}};
  const Json exclusions =
      Json::array({Json{{"if", is_unit}, {"then", of_unit.exclusions()}},
                   Json{{"if", is_by(ServedBy::frame)}, {"then", of_channel.exclusions()}}});
  add_missing(of_channel.properties, of_unit.properties);
  Json schema =
      profile("Wireless profile", of_channel,
              {{"if", is_delay}, {"then", of_delay.requirements()}, {"else", of_channels}});
  schema["allOf"] = exclusions;
  Json names = Json::array();
  for (const ImplementationKind kind : implementations) names.push_back(name_of(kind));
  schema["properties"]["only_with"] = {
      {"description",
       "the implementations that the other keys are for; with another one the profile is its base"},
      {"type", "array"},
      {"items", {{"enum", names}}}};
  return schema;
}

Json scenario_schema() {
  SchemaVisitor visitor = visited(Scenario{});
  add_description(visitor);
  return with_title("Scenario", visitor.complete());
}

}  // namespace

std::string schema_file_name(SchemaKind kind) {
  switch (kind) {
    case SchemaKind::scenario:
      return "scenario.schema.json";
    case SchemaKind::dds:
      return "dds.schema.json";
    case SchemaKind::wireless:
      return "wireless.schema.json";
  }
  return {};
}

std::string json_schema(SchemaKind kind) {
  constexpr int indent = 2;
  switch (kind) {
    case SchemaKind::scenario:
      return scenario_schema().dump(indent) + "\n";
    case SchemaKind::dds:
      return dds_schema().dump(indent) + "\n";
    case SchemaKind::wireless:
      return wireless_schema().dump(indent) + "\n";
  }
  return {};
}

}  // namespace stormproof::model::config
