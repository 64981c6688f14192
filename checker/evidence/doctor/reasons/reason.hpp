// Why participants do not see each other: one thing that a capture shows, what speaks for it, and
// what to do.
#pragma once

#include <string>

namespace stormproof::doctor {

struct Reason {
  std::string id;           ///< stable: "domains", "no_answers", …
  std::string sentence;     ///< what the capture shows, and what it means
  double probability = 1;   ///< that this is why; 1: the capture leaves nothing else
  std::string remedy;       ///< what to do
  bool keeps_apart = true;  ///< somebody is not discovered; otherwise they are, and do not match
};

}  // namespace stormproof::doctor
