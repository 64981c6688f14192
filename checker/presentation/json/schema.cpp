// What a schema is put together from, whatever the type.
#include "checker/presentation/json/schema.hpp"

namespace stormproof::report {

using Json = nlohmann::ordered_json;

namespace schema_detail {

std::string short_name(std::string_view pretty_function) {
  pretty_function.remove_prefix(pretty_function.rfind("[") + 1);
  pretty_function.remove_prefix(pretty_function.find("T = ") + 4);
  std::string name;
  std::string word;
  for (const char c : pretty_function.substr(0, pretty_function.find_first_of(";]"))) {
    if (c == ':') {
      word.clear();
    } else if (c == '<' || c == '>' || c == ',') {
      name += std::exchange(word, "");
    } else if (c != ' ') {
      word += c;
    }
  }
  return name + word;
}

Json or_null(Json schema) {
  if (schema.contains("enum")) schema["enum"].push_back(nullptr);
  if (!schema.contains("type")) return {{"anyOf", Json::array({schema, {{"type", "null"}}})}};
  Json& type = schema["type"];
  if (type.is_string()) type = Json::array({type, "null"});
  return schema;
}

}  // namespace schema_detail

void SchemaObject::add(std::string_view key, Json schema, bool is_required) {
  properties_[std::string{key}] = std::move(schema);
  if (is_required) required_.push_back(key);
}

Json SchemaObject::take() && {
  return {{"type", "object"},
          {"properties", std::move(properties_)},
          {"required", std::move(required_)},
          {"additionalProperties", false}};
}

Json schema_of(const std::string& title, const std::vector<SchemaForm>& forms) {
  SchemaDefinitions definitions;
  Json all = Json::array();
  for (const SchemaForm form : forms) all.push_back(form(definitions));
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(all.size() == 1 ? all.front() : Json{{"anyOf", all}});
  schema["$defs"] = std::move(definitions).take();
  return schema;
}

}  // namespace stormproof::report
