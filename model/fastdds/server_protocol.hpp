// Fast DDS with a Discovery Server, as a host of its rules (fsm/composition/server.hpp,
// specs/guide/discovery-server.md).
#pragma once

#include "model/fastdds/server_host.hpp"

namespace stormproof::model::fastdds {

class ServerProtocol final
    : public ServerHost<ServerProtocol, Protocol, server::FastDdsServer, ServerColumns> {
 public:
  using ServerHost::ServerHost;
};

extern template class ServerHost<ServerProtocol, Protocol, server::FastDdsServer, ServerColumns>;

}  // namespace stormproof::model::fastdds
