// Decides queries: Z3 first, then, if cvc5 is installed, the same query in SMT-LIB 2 once more.
// Only two solvers that agree, or one that is alone, give an answer. What a query may cost is
// counted in the solvers' own resource units, so that the answer is the same on every machine; the
// clock only interrupts what does not count them.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace z3 {
class expr;
template <class T>
class ast_vector_tpl;
}  // namespace z3

namespace stormproof::smt {

enum class Answer : unsigned char { unsat, sat, unknown };

/// What a query may cost: some hundred times what those of the catalogue need, and about as long in
/// both solvers.
struct Budget {
  unsigned z3 = 20'000'000;   ///< units of Z3's `rlimit`
  unsigned cvc5 = 1'000'000;  ///< units of cvc5's `--rlimit-per`

  /// For longer searches.
  [[nodiscard]] constexpr Budget times(unsigned effort) const {
    return {z3 * effort, cvc5 * effort};
  }
};

struct Options {
  /// By the clock, of each query, for each solver: an interruption, no budget.
  std::chrono::milliseconds timeout{120'000};
  Budget budget{};
  unsigned seed = 0;
  std::string export_dir{};   ///< where queries are written as <property>.smt2; empty: nowhere
  bool second_solver = true;  ///< ask cvc5, too, if it is installed
  std::function<bool()>
      interrupted{};  ///< asked now and then, by any thread; true: no query any more
};

struct Decision;  // checker/engines/smt/decision.hpp

/// The outcome of the second opinion on all queries of one property.
struct SecondOpinion {
  bool asked = false;
  bool agrees = true;        ///< it gave the same answer to every query
  bool contradicts = false;  ///< it answered one of them the other way round
  std::string solver;        ///< for example "cvc5 1.0.3"
  /// The first query that it contradicts; if there is none, the first without an answer.
  std::string difference;
  std::string problem;  ///< why the export could not be written; empty: it was, or none was asked
  double seconds = 0;
};

/// One per check: it remembers every query. Contexts and expressions belong to the caller, who may
/// drop them once `decide` has returned (a model needs its context, though).
class Claims {
 public:
  explicit Claims(Options options = {});
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  [[nodiscard]] const Options& options() const;
  /// "z3 4.8.12"
  [[nodiscard]] static std::string solver_name();

  /// Asks Z3 whether the conjunction is satisfiable. `property` and `query` name it in exports; the
  /// query is remembered for `second_opinion`. Plain conditions only: no fixed points, no
  /// optimisation. Never throws because of Z3: its errors are `unknown` with the reason. Throws
  /// `Interrupted` (checker/engines/smt/deadline.hpp) if `Options::interrupted` says so; so does
  /// `second_opinion`.
  Decision decide(std::string_view property, std::string_view query,
                  const z3::ast_vector_tpl<z3::expr>& assertions);

  /// What proved a question, as SMT-LIB, for whoever asks nearly the same of another system (of a
  /// mutant): it is no answer there, but worth a try. The first one stays.
  void remember_invariant(const std::string& question, std::string text);
  [[nodiscard]] std::optional<std::string> remembered_invariant(const std::string& question) const;

  /// Writes a certificate as certificates/<property>.smt2 among the exports; nothing if there are
  /// none. Every answer that it asks for is unsat.
  void export_certificate(std::string_view property, const std::string& text);

  /// The first export that could not be written; nothing if there is none.
  [[nodiscard]] std::optional<std::string> export_error() const;

  /// Puts all queries of the property to the second solver and compares. Writes the export file.
  SecondOpinion second_opinion(std::string_view property);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stormproof::smt
