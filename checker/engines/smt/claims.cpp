// Z3 answers at once; what it was asked is kept as SMT-LIB 2 text, so that the second solver gets
// the very same question in a single run per property.
#include "checker/engines/smt/claims.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <vector>

#include <unistd.h>

#include "checker/engines/smt/deadline.hpp"
#include "checker/engines/smt/decision.hpp"
#include "checker/engines/smt/second_solver.hpp"

namespace stormproof::smt {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const char* text_of(Answer answer) {
  switch (answer) {
    case Answer::unsat:
      return "unsat";
    case Answer::sat:
      return "sat";
    case Answer::unknown:
      return "unknown";
  }
  return "";
}

struct Query {
  std::string name;
  std::string text;  ///< declarations and assertions, without `check-sat`
  Answer answer = Answer::unknown;
};

/// Names go into comments: no line breaks.
std::string one_line(std::string_view text) {
  std::string line{text};
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return line;
}

/// A file name that stays in its folder.
std::string file_name(std::string_view property) {
  std::string name{property};
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (!plain) c = '_';
  }
  return name + ".smt2";
}

std::string declarations_and_assertions(z3::solver& solver) {
  std::string text = solver.to_smt2();
  const auto check = text.rfind("(check-sat)");
  if (check != std::string::npos) text.erase(check);
  // The header says nothing: a comment and an unknown status.
  const std::string status = "(set-info :status unknown)";
  const auto begin = text.find(status);
  if (begin != std::string::npos) text.erase(0, begin + status.size());
  return text;
}

std::string script(std::string_view property, const std::vector<Query>& queries) {
  std::string text = "; property: " + one_line(property) + "\n(set-logic ALL)\n";
  for (const Query& query : queries) {
    text += "\n; query: " + one_line(query.name) + "\n; expected: " + text_of(query.answer);
    text += "\n(push 1)" + query.text + "(check-sat)\n(pop 1)\n";
  }
  return text + "\n(exit)\n";
}

/// Z3's solver without tactics: it answers small queries several times faster than the default one,
/// and it starts no timers (checker/engines/smt/deadline.hpp).
z3::solver make_solver(const z3::expr_vector& assertions, const Options& options) {
  z3::context& context = assertions.ctx();
  z3::solver solver{context, z3::solver::simple()};
  solver.set(solver_parameters(context, options));
  for (const z3::expr& assertion : assertions) {
    if (!assertion.is_bool()) throw z3::exception{"an assertion that is not a truth value"};
    solver.add(assertion);
  }
  return solver;
}

void check(z3::solver& solver, const Options& options, Decision& decision) {
  Deadline deadline{solver.ctx(), options.timeout, options.interrupted};
  switch (solver.check()) {
    case z3::unsat:
      decision.answer = Answer::unsat;
      break;
    case z3::sat:
      decision.answer = Answer::sat;
      decision.model = solver.get_model();
      break;
    case z3::unknown:
      decision.why = deadline.expired() ? deadline.why() : solver.reason_unknown();
      break;
  }
}

void stop_if_interrupted(const Options& options) {
  if (options.interrupted && options.interrupted()) throw Interrupted{};
}

/// A file that disappears with this object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    std::error_code none;
    path_ = (std::filesystem::temp_directory_path(none) / "stormproof-XXXXXX.smt2").string();
    const int file = mkstemps(path_.data(), 5);
    if (file < 0) {
      path_.clear();
      return;
    }
    close(file);
    std::ofstream{path_} << text;
  }
  ~TemporaryFile() {
    if (!path_.empty()) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }  ///< empty: no such file

 private:
  std::string path_;
};

/// Writes the export; returns what went wrong, or nothing. What is cut off is not left.
std::string write_export(const std::string& folder, std::string_view property,
                         const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto path = std::filesystem::path{folder} / file_name(property);
  errno = 0;
  std::ofstream file{path, std::ios::binary};
  file << text;
  file.close();
  if (file) return {};
  const std::string why = errno == 0 ? "" : std::string{": "} + std::strerror(errno);
  std::filesystem::remove(path, error);
  return "cannot write " + path.string() + why;
}

/// The first query to which one solver says sat and the other unsat; nothing if there is none.
std::string contradiction(const std::vector<Query>& queries, const SolverRun& run,
                          const std::string& solver) {
  for (std::size_t k = 0; k < std::min(queries.size(), run.answers.size()); ++k) {
    const Answer first = queries[k].answer;
    const Answer second = run.answers[k];
    if (first == Answer::unknown || second == Answer::unknown || first == second) continue;
    return one_line(queries[k].name) + ": z3 says " + text_of(first) + ", " + solver + " says " +
           text_of(second);
  }
  return {};
}

/// The first query that one of the solvers leaves without an answer; nothing if there is none.
std::string gap(const std::vector<Query>& queries, const SolverRun& run,
                const std::string& solver) {
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const std::string where = one_line(queries[k].name) + ": ";
    if (k >= run.answers.size()) {
      const std::string why = run.failure.empty() ? "" : " (" + run.failure + ")";
      return where + solver + " gives no answer" + why;
    }
    if (queries[k].answer == Answer::unknown) return where + "z3 gives no answer";
    if (run.answers[k] == Answer::unknown) return where + solver + " gives no answer";
  }
  if (run.answers.size() > queries.size()) return solver + " answers more than it was asked";
  return {};
}

}  // namespace

struct Claims::State {
  Options options;
  std::mutex mutex;
  std::map<std::string, std::vector<Query>, std::less<>> queries;  // by property
  std::optional<std::string> second_solver;                        // its name, once looked for
  std::optional<std::string> export_error;                         // the first
  std::map<std::string, std::string> invariants;                   // by question

  [[nodiscard]] bool keeps_text() const {
    return options.second_solver || !options.export_dir.empty();
  }
};

Claims::Claims(Options options) : state_{std::make_unique<State>()} {
  state_->options = std::move(options);
}

Claims::~Claims() = default;

const Options& Claims::options() const { return state_->options; }

std::optional<std::string> Claims::export_error() const {
  const std::lock_guard lock{state_->mutex};
  return state_->export_error;
}

std::string Claims::solver_name() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned build = 0;
  unsigned revision = 0;
  Z3_get_version(&major, &minor, &build, &revision);
  return "z3 " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

Decision Claims::decide(std::string_view property, std::string_view query,
                        const z3::expr_vector& assertions) {
  const auto start = Clock::now();
  stop_if_interrupted(state_->options);
  Decision decision;
  Query asked{std::string{query}, {}, Answer::unknown};
  try {
    z3::solver solver = make_solver(assertions, state_->options);
    if (state_->keeps_text()) asked.text = declarations_and_assertions(solver);
    check(solver, state_->options, decision);
  } catch (const z3::exception& error) {
    decision.answer = Answer::unknown;
    decision.model.reset();
    decision.why = error.msg();
  }
  stop_if_interrupted(state_->options);
  decision.seconds = seconds_since(start);
  asked.answer = decision.answer;
  const std::lock_guard lock{state_->mutex};
  state_->queries[std::string{property}].push_back(std::move(asked));
  return decision;
}

void Claims::remember_invariant(const std::string& question, std::string text) {
  const std::lock_guard lock{state_->mutex};
  state_->invariants.try_emplace(question, std::move(text));
}

std::optional<std::string> Claims::remembered_invariant(const std::string& question) const {
  const std::lock_guard lock{state_->mutex};
  const auto found = state_->invariants.find(question);
  if (found == state_->invariants.end()) return std::nullopt;
  return found->second;
}

void Claims::export_certificate(std::string_view property, const std::string& text) {
  const std::lock_guard lock{state_->mutex};
  if (state_->options.export_dir.empty()) return;
  const auto folder = std::filesystem::path{state_->options.export_dir} / "certificates";
  std::string problem = write_export(folder.string(), property, text);
  if (!problem.empty() && !state_->export_error) state_->export_error = std::move(problem);
}

SecondOpinion Claims::second_opinion(std::string_view property) {
  const auto start = Clock::now();
  const std::lock_guard lock{state_->mutex};
  SecondOpinion opinion;
  const auto found = state_->queries.find(property);
  if (found == state_->queries.end()) return opinion;
  const Options& options = state_->options;
  const std::string text = script(property, found->second);
  if (!options.export_dir.empty()) {
    opinion.problem = write_export(options.export_dir, property, text);
    if (!opinion.problem.empty() && !state_->export_error) state_->export_error = opinion.problem;
  }
  if (options.second_solver) {
    if (!state_->second_solver) state_->second_solver = second_solver_name();
    opinion.solver = *state_->second_solver;
  }
  if (!opinion.solver.empty()) {
    opinion.asked = true;
    const TemporaryFile file{text};
    if (file.path().empty()) {
      opinion.difference = "no temporary file for " + opinion.solver;
    } else {
      const SolverRun run = ask_second_solver(file.path(), found->second.size(), options);
      stop_if_interrupted(options);
      opinion.difference = contradiction(found->second, run, opinion.solver);
      opinion.contradicts = !opinion.difference.empty();
      if (!opinion.contradicts) opinion.difference = gap(found->second, run, opinion.solver);
    }
    opinion.agrees = opinion.difference.empty();
  }
  opinion.seconds = seconds_since(start);
  return opinion;
}

}  // namespace stormproof::smt
