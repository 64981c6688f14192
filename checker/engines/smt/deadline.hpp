// What Z3's work may cost, and a watch that interrupts it. The budget is Z3's own count of
// resources; where Z3 does not count them, and when nobody wants the answer any more, the watch
// ends the work. Z3 4.8.10 to 4.8.12 have timers of their own (the parameter `timeout`, and some
// tactics of the default solver), but one that expires keeps a lock, and the next one may wait for
// it for ever (Z3 pull request 5369). So nothing here uses them: a watch of our own interrupts the
// context, and solvers are made without tactics.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <z3++.h>

#include "checker/engines/smt/claims.hpp"

namespace stormproof::smt {

/// The seed and the budget of a solver.
[[nodiscard]] inline z3::params solver_parameters(z3::context& context, const Options& options) {
  z3::params parameters{context};
  parameters.set("random_seed", options.seed);
  parameters.set("rlimit", options.budget.z3);
  parameters.set("ctrl_c", false);  // signals belong to the program, or to whom it is a part of
  return parameters;
}

/// Nobody wants the answer any more. Thrown through an engine to its border, so that no question
/// after the first costs time; never further.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error{"interrupted"} {}
};

/// While it lives, work in `context` is interrupted after `limit`, or when `interrupted` (which may
/// be empty) says so. The work then ends with "unknown" or an exception; the context stays usable.
/// If it says so in the beginning, the constructor throws `Interrupted`.
class Deadline {
 public:
  Deadline(z3::context& context, std::chrono::milliseconds limit,
           std::function<bool()> interrupted = {});
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  /// Whether the time has been over, or the work was interrupted.
  [[nodiscard]] bool expired();
  /// Why the work ended then: "time-out" or "interrupted".
  [[nodiscard]] const char* why();

 private:
  z3::context& context_;
  std::function<bool()> interrupted_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  bool expired_ = false;
  bool stopped_ = false;
  std::thread watch_;
};

}  // namespace stormproof::smt
