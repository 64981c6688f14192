// What all commands have in common: a command declares its options, is run, and returns its answer.
// Everything else stands here once: formats and files of the answer, progress, Ctrl-C, the line
// that repeats the command, the exit code.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/cli/answer.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/session.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::cli {

/// `content` behind what all JSON starts with: `schema`, `command`, `exit_code`, `interrupted`.
[[nodiscard]] nlohmann::ordered_json with_head(nlohmann::ordered_json content,
                                               const std::string& command, int exit_code,
                                               bool interrupted);

/// The formats that a command offers.
enum class Formats : std::uint8_t {
  none,      ///< it makes no answer
  pages,     ///< text, JSON, Markdown and HTML
  tables,    ///< these and CSV
  findings,  ///< as `pages`, JUnit and SARIF
  review     ///< as `findings`, and a comment on a pull request
};

struct Verb {
  std::string name;  ///< "check"; in a group "profile show"
  std::string help;
  std::string exit_codes;
  Formats formats = Formats::pages;
  std::vector<report::SchemaForm> schemas = {};  ///< of its JSON; it has at least one form
  bool takes_long = true;                        ///< has progress to show
  /// Under mpirun: whether this process is the one that writes files.
  bool (*writes)() = [] { return true; };
};

class Frame {
 public:
  explicit Frame(Process process = Process::own);
  ~Frame();
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  /// A word that has commands below it.
  void group(const char* name, const char* help);

  /// `declare` says what the command accepts, `work` does it. A request lives as long as the
  /// frame.
  template <class Request>
  void add(Verb verb, void (*declare)(Options&, Request&), Outcome (*work)(Request&, Session&)) {
    const auto request = std::make_shared<Request>();
    add(
        std::move(verb), [=](Options& options) { declare(options, *request); },
        [=](Session& session) { return work(*request, session); });
  }

  /// For a command that needs the frame itself.
  void add(Verb verb, const std::function<void(Options&)>& declare,
           std::function<Outcome(Session&)> work);

  /// Parses, runs, shows; returns the exit code. Without any word it says what the program is for.
  [[nodiscard]] int run(int argc, char** argv);
  /// The same with the words behind the program.
  [[nodiscard]] int run(std::vector<std::string> words);

  /// Why these words name no command; of the program itself, if there are none.
  [[nodiscard]] std::optional<Complaint> refuse(const std::vector<std::string>& words) const;
  /// What `--help` says of this command, which `refuse` does not refuse.
  [[nodiscard]] std::string help_of(const std::vector<std::string>& words) const;
  /// What completes commands in a shell: "bash", "zsh" or "fish".
  [[nodiscard]] std::string completion(std::string_view shell) const;
  [[nodiscard]] std::string man_page() const;

 private:
  struct Parser;
  struct Command;

  std::unique_ptr<Parser> parser_;
};

}  // namespace stormproof::cli
