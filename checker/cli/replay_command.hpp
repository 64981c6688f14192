// `stormproof replay TRACE`: runs the scenario of a trace again and compares every event.
#pragma once

#include <string>

namespace stormproof::cli {

struct ReplayArguments {
  std::string file;  ///< written by `stormproof simulate --trace`
  bool json = false;
};

/// Exit code: established if the trace is identical, violated if it differs, inconclusive if it
/// ends early (all its lines agree) or the replay was interrupted, bad_input.
[[nodiscard]] int replay(const ReplayArguments& arguments);

}  // namespace stormproof::cli
