// A time-out for work that Z3 does. Z3 4.8.10 to 4.8.12 have timers of their own (the parameter
// `timeout`, and some tactics of the default solver), but one that expires keeps a lock, and the
// next one may wait for it for ever (Z3 pull request 5369). So nothing here uses them: a watch of
// our own interrupts the context, and solvers are made without tactics.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <z3++.h>

namespace stormproof::smt {

/// While it lives, work in `context` is interrupted after `limit`. The work then ends with
/// "unknown" or an exception; the context stays usable.
class Deadline {
 public:
  Deadline(z3::context& context, std::chrono::milliseconds limit);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  /// Whether the time has been over.
  [[nodiscard]] bool expired();

 private:
  z3::context& context_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  bool expired_ = false;
  std::thread watch_;
};

}  // namespace stormproof::smt
