// What the parts have in common, and what their verdict leaves open.
#include "checker/evidence/conform/cyclone.hpp"

#include <fmt/format.h>

#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform::cyclone {

std::vector<std::string> assumptions(const Bounds& bounds) {
  return {
      "with Cyclone DDS each message is explained by itself, by a cause that can have arrived and "
      "timers that can have fired; that one course of events explains all of them together, and "
      "that what arrived was answered, is not decided",
      fmt::format("an announcement waits in the queue of its participant's thread for up to {} "
                  "(--queueing)",
                  duration(bounds.most_queueing_ns)),
      "how long DATA and answers wait there, and how packets are put together, is not looked at"};
}

}  // namespace stormproof::conform::cyclone
