// The exit codes of the program: one list, so that scripts can rely on them.
#pragma once

namespace stormproof::cli {

enum ExitCode : int {
  established = 0,     ///< what was asked holds; for `simulate`: discovery completes
  violated = 1,        ///< it does not hold, and the output shows why
  bad_input = 2,       ///< usage, a file or a value is wrong
  inconclusive = 3,    ///< neither; for `simulate`: not complete within the limit
  not_conformant = 4,  ///< a capture shows what no behaviour of the profile explains
  internal_error = 70  ///< a broken invariant of the program itself
};

}  // namespace stormproof::cli
