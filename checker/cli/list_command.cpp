// `stormproof list [KIND]`: which names there are.
#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/streams.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/verification/listing/listing.hpp"

namespace stormproof::cli {

namespace {

struct ListArguments {
  std::vector<std::string> kinds;  ///< empty: all
  bool names = false;
};

Outcome run(ListArguments& arguments, Session& /*session*/) {
  std::vector<std::string> kinds = arguments.kinds;
  const bool is_all = kinds.empty();
  if (is_all) kinds.assign(listing::kinds().begin(), listing::kinds().end());
  std::vector<listing::List> lists;
  for (const std::string& kind : kinds) {
    lists.push_back(listing::list_of(kind, model::config::SpecPath::standard()));
  }
  if (arguments.names) {
    for (const listing::List& list : lists) {
      for (const listing::Entry& entry : list.entries) print(entry.name + "\n");
    }
    return established;
  }
  Answer answer;
  answer.json = to_json(lists);
  if (is_all) {  // for people: mutants are thousands
    std::erase_if(lists, [](const listing::List& one) { return one.kind == "mutants"; });
  }
  answer.document = document_of(lists);
  if (is_all) {
    answer.document.next = {{report::command_line({"list", "mutants"}),
                             "the mistakes in machines and rules that mutate makes"}};
  }
  return answer;
}

void declare(Options& options, ListArguments& arguments) {
  options
      .texts("kinds", arguments.kinds,
             "scenarios, profiles, wireless, grids, exhibits, policies, machines, mutants, "
             "properties, "
             "findings, captures or vendor; without one, all (for people without mutants)",
             "KIND")
      .one_of({listing::kinds().begin(), listing::kinds().end()});
  options.flag("--names", arguments.names, "Only the names, one on a line");
}

}  // namespace

void declare_list(Frame& frame) {
  frame.add<ListArguments>(
      {.name = "list",
       .help = "List what has a name: scenarios, profiles, grids, properties, captures, …",
       .exit_codes = "Exit code: 0, or 2 bad input.",
       .formats = Formats::pages,
       .schemas = {listing::json_schema},
       .takes_long = false},
      declare, run);
}

}  // namespace stormproof::cli
