// The lists for programs.
#include "checker/presentation/json/describe.hpp"
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

nlohmann::ordered_json to_json(const std::vector<List>& lists) {
  nlohmann::ordered_json json;
  json["lists"] = report::json_of(lists);
  return json;
}

}  // namespace stormproof::listing
