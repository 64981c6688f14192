// A table for each kind.
#include <fmt/core.h>

#include "checker/verification/listing/listing.hpp"

namespace stormproof::listing {

report::Document document_of(const std::vector<List>& lists) {
  report::Document document;
  std::size_t names = 0;
  for (const List& list : lists) {
    names += list.entries.size();
    report::Table table{{{"name"}, {"what it is", report::Column::Align::left, true}}, {}};
    for (const Entry& entry : list.entries) {
      table.rows.push_back({{report::code(entry.name), entry.what}});
    }
    report::Section section{std::string{list.kind}, std::string{list.kind}};
    section.blocks.emplace_back(report::Paragraph{fmt::format("for {}", list.where)});
    section.blocks.emplace_back(std::move(table));
    document.blocks.emplace_back(std::move(section));
  }
  document.title = "stormproof list";
  document.answer = lists.size() == 1 ? fmt::format("{} {}", names, lists.front().kind)
                                      : fmt::format("{} names", names);
  return document;
}

}  // namespace stormproof::listing
