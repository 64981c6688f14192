// The lists for programs.
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/listing/listing.hpp"

namespace stormproof::listing {

template <class V>
void describe(V& v, const Entry& entry) {
  v("name", entry.name);
  v("what", entry.what);
  v.or_null("file", entry.file);
}

template <class V>
void describe(V& v, const List& list) {
  v("kind", list.kind);
  v("where", list.where);
  v("entries", list.entries);
}

namespace {

struct Lists {
  const std::vector<List>& lists;
};

template <class V>
void describe(V& v, const Lists& all) {
  v("lists", all.lists);
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<List>& lists) {
  return report::json_of(Lists{lists});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Lists>(definitions);
}

}  // namespace stormproof::listing
