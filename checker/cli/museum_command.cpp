// `stormproof museum [ID]`: defects that DDS implementations had or have, before and after.
#include <string>
#include <vector>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/experiments/museum/museum.hpp"

namespace stormproof::cli {

namespace {

struct MuseumArguments {
  std::string exhibit;  ///< a name, a path, or nothing: all of them
};

/// All, or the one, or its parts: "E8" has E8a and E8b.
std::vector<std::string> wanted_of(std::vector<std::string> names, const std::string& exhibit) {
  if (exhibit.empty()) return names;
  std::erase_if(names, [&](const std::string& name) {
    return name.size() != exhibit.size() + 1 || !name.starts_with(exhibit) || name.back() < 'a';
  });
  return names.empty() ? std::vector{exhibit} : names;
}

Outcome run(MuseumArguments& arguments, Session& session) {
  const model::config::SpecPath specs = model::config::SpecPath::standard();
  const std::vector<std::string> wanted =
      wanted_of(museum::exhibit_names(specs), arguments.exhibit);
  if (wanted.empty()) return Complaint{"no exhibits: expected files in specs/museum, or a path"};
  std::vector<museum::Exhibit> exhibits;
  for (const std::string& name : wanted) {
    auto exhibit = museum::read_exhibit(name, specs);
    if (!exhibit) return exhibit.error();
    exhibits.push_back(*std::move(exhibit));
  }
  const auto on_steps = session.on_steps();
  const museum::Report report =
      museum::show(std::move(exhibits), [&] { return on_steps("running exhibits"); });
  Answer answer{museum::document_of(report, arguments.exhibit), museum::to_json(report)};
  answer.document.exit_code = !report.finished       ? inconclusive
                              : report.as_expected() ? established
                                                     : violated;
  return answer;
}

void declare(Options& options, MuseumArguments& arguments) {
  options.text("exhibit", arguments.exhibit,
               "One exhibit, by name (E3; E8 has two parts) or path; all if absent", "ID");
}

}  // namespace

void declare_museum(Frame& frame) {
  frame.add<MuseumArguments>(
      {"museum",
       "Real defects of DDS implementations: what broke, the repair, and what would not have been "
       "one",
       "Exit code: 0 every verdict is the one that its exhibit expects, 1 some is not,\n"
       "3 interrupted, 2 bad input.",
       Formats::pages,
       {museum::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
