// What has to be known of an implementation before there is one.
#pragma once

#include <memory>

#include "model/engine/implementation.hpp"
#include "model/engine/topology.hpp"

namespace stormproof::model {

class Network;    // model/engine/network.hpp
struct RunState;  // model/engine/run_state.hpp

struct ImplementationMaker {
  SameHostPairs same_host;
  std::unique_ptr<Implementation> (*make)(RunState& run, Network& network);
};

template <class Protocol>
[[nodiscard]] ImplementationMaker maker_of(SameHostPairs same_host) {
  return {same_host, [](RunState& run, Network& network) {
            return std::unique_ptr<Implementation>{std::make_unique<Protocol>(run, network)};
          }};
}

}  // namespace stormproof::model
