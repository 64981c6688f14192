// Work that takes long, while Python goes on: another thread does it without the interpreter's
// lock, and the calling one asks now and then whether Python has heard of Ctrl-C. So it works in a
// program, at a prompt and in a notebook, whoever handles the signal there.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

namespace stormproof::python {

/// What `work()` returns or throws; after Ctrl-C, KeyboardInterrupt, once `stop()` has had the work
/// end.
template <class Work, class Stop>
auto interruptible(Work&& work, const Stop& stop) {
  auto result = std::async(std::launch::async, std::forward<Work>(work));
  std::optional<pybind11::error_already_set> raised;
  const auto is_done = [&] {
    const pybind11::gil_scoped_release released;
    return result.wait_for(std::chrono::milliseconds{20}) == std::future_status::ready;
  };
  while (!is_done()) {
    if (!raised && PyErr_CheckSignals() != 0) raised.emplace();
    if (raised) stop();  // again and again: the work may not have been ready to be told
  }
  if (raised) throw pybind11::error_already_set{*raised};
  return result.get();
}

}  // namespace stormproof::python
