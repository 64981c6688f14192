// `stormproof replay TRACE`: runs the scenario of a trace again and compares every event. Of a
// counterexample it also says whether the violation occurs.
#pragma once

#include <string>

namespace stormproof::cli {

struct ReplayArguments {
  std::string file;  ///< written by `stormproof simulate --trace` or `stormproof check`
  bool json = false;
};

/// Exit code: established if the trace is identical, violated if it differs, inconclusive if it
/// ends early (all its lines agree) or the replay was interrupted, bad_input. Of a counterexample:
/// violated if every line agrees and the violation occurs, bad_input, otherwise inconclusive.
[[nodiscard]] int replay(const ReplayArguments& arguments);

}  // namespace stormproof::cli
