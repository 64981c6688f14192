// Compiles the host without a life.
#include "model/fastdds/server_protocol.hpp"

#include "model/fastdds/server_packets.hpp"

namespace stormproof::model::fastdds {

template class ServerHost<ServerProtocol, Protocol, server::FastDdsServer, ServerColumns>;

}  // namespace stormproof::model::fastdds
