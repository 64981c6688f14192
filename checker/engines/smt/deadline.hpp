// A time-out for work that Z3 does. Z3 4.8.10 to 4.8.12 have timers of their own (the parameter
// `timeout`, and some tactics of the default solver), but one that expires keeps a lock, and the
// next one may wait for it for ever (Z3 pull request 5369). So nothing here uses them: a watch of
// our own interrupts the context, and solvers are made without tactics.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <z3++.h>

namespace stormproof::smt {

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
