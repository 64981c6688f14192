// Commands that the program prints for its reader to run: they start with the name under which the
// reader called it, and every word survives a POSIX shell.
#pragma once

#include <string>
#include <vector>

namespace stormproof::report {

/// How the program was called: `argv[0]`, or what its launcher says in the environment variable
/// STORMPROOF_CALLED. Once, before anything is printed; until then it is `stormproof`.
void set_program(const std::string& called);

/// As it was called, if that was by a relative path; otherwise `stormproof`: where a machine keeps
/// the program is nothing for a report that others read. Not quoted.
[[nodiscard]] const std::string& program();

/// The words, quoted where that is needed, behind the program: "./stormproof replay 'a b.jsonl'".
[[nodiscard]] std::string command_line(const std::vector<std::string>& words);

}  // namespace stormproof::report
