// What Z3 answered to one query, with its model. Apart from claims.hpp, so that whoever only hands
// a `Claims` on does not compile Z3's interface.
#pragma once

#include <optional>
#include <string>

#include <z3++.h>

#include "checker/engines/smt/claims.hpp"

namespace stormproof::smt {

struct Decision {
  Answer answer = Answer::unknown;
  std::string why;  ///< of `unknown`: time-out, disagreement, …
  double seconds = 0;
  std::optional<z3::model> model;  ///< of `sat`
};

}  // namespace stormproof::smt
