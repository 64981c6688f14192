// What every JSON starts with (specs/guide/output.md).
#pragma once

#include <string>

namespace stormproof::report {

/// The version of what `--format json` prints. It grows when a key gets another name or meaning.
inline constexpr int json_version = 3;

struct Head {
  std::string command;  ///< gives the same answer again
  int exit_code = 0;
  bool interrupted = false;  ///< before the end; what is there holds
};

template <class V>
void describe(V& v, const Head& head) {
  v("schema", json_version);
  v("command", head.command);
  v("exit_code", head.exit_code);
  v("interrupted", head.interrupted);
}

}  // namespace stormproof::report
