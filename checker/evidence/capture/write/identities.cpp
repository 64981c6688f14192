// Numbers to names.
#include "checker/evidence/capture/write/identities.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/core.h>

#include "checker/evidence/capture/write/byte_writer.hpp"

namespace stormproof::capture::write {

namespace {

/// The services of every node: name and type.
constexpr std::array<std::array<const char*, 2>, 6> parameter_services{
    {{"get_parameters", "GetParameters"},
     {"get_parameter_types", "GetParameterTypes"},
     {"set_parameters", "SetParameters"},
     {"set_parameters_atomically", "SetParametersAtomically"},
     {"describe_parameters", "DescribeParameters"},
     {"list_parameters", "ListParameters"}}};

TopicName service(std::uint32_t k, bool is_reply, const std::string& node) {
  const auto& [name, type] = parameter_services[k];
  return {
      fmt::format("{}/{}/{}{}", is_reply ? "rr" : "rq", node, name, is_reply ? "Reply" : "Request"),
      fmt::format("rcl_interfaces::srv::dds_::{}_{}_", type, is_reply ? "Response" : "Request")};
}

UdpEnd at(std::size_t host, std::size_t port) {
  const std::array<std::uint8_t, 4> address{10, static_cast<std::uint8_t>(host / 256),
                                            static_cast<std::uint8_t>(host % 256), 1};
  return {Address::from(address), static_cast<std::uint16_t>(port)};
}

}  // namespace

std::array<std::uint8_t, 2> announced_version(model::SizesSince sizes) {
  switch (sizes) {
    case model::SizesSince::v2_6:
      break;
    case model::SizesSince::v3_2:
      return {3, 2};
    case model::SizesSince::v3_6:
      return {3, 6};
  }
  return {};
}

std::vector<Identity> identities(const model::Deployment& deployment, VendorId vendor,
                                 model::Discovery discovery, model::SizesSince sizes) {
  constexpr std::size_t server_port = 11811;
  const bool is_super = discovery == model::Discovery::super_client;
  const bool has_server = is_super || discovery == model::Discovery::server;
  std::map<model::HostId, std::size_t> on_host;  // participants so far
  for (const model::Participant& participant : deployment.participants) {
    on_host[participant.host] = 0;
  }
  if (has_server) on_host[model::HostId{}] = 0;
  std::vector<Identity> result;
  const auto add = [&](model::HostId on) -> std::size_t {
    const auto entry = on_host.find(on);
    const auto host = static_cast<std::size_t>(std::distance(on_host.begin(), entry));
    const std::size_t p = entry->second++;
    Identity one;
    ByteWriter prefix{ByteOrder::big};
    prefix.u16(vendor).u16(host).u32(result.size() + 1).u32(0);
    std::ranges::copy(prefix.buffer(), one.prefix.bytes.begin());
    one.metatraffic = at(host, metatraffic_port(p));
    one.user = at(host, metatraffic_port(p) + 1U);
    one.name = fmt::format("simulated_h{}_p{}", on.value, p);
    one.version = announced_version(sizes);
    if (has_server) one.type = is_super ? "SUPER_CLIENT" : "CLIENT";
    result.push_back(std::move(one));
    return host;
  };
  for (const model::Participant& participant : deployment.participants) add(participant.host);
  if (!has_server) return result;
  const std::size_t host = add(model::HostId{});
  result.back().metatraffic = at(host, server_port);
  result.back().name = "simulated_server";
  result.back().type = "SERVER";
  return result;
}

UdpEnd discovery_group() {
  constexpr std::array<std::uint8_t, 4> address{239, 255, 0, 1};
  return {Address::from(address), 7400};
}

TopicName topic_name(model::Stream stream, std::uint32_t d, std::uint32_t defaults,
                     const std::string& node) {
  constexpr auto services = static_cast<std::uint32_t>(parameter_services.size());
  const bool is_publication = stream == model::Stream::pub;
  if (d >= defaults) {
    return {fmt::format("rt/bench/topic_{:02}", d - defaults), "std_msgs::msg::dds_::String_"};
  }
  if (d == 0) return {"ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"};
  if (is_publication && d == 1) return {"rt/rosout", "rcl_interfaces::msg::dds_::Log_"};
  const std::uint32_t first_service = is_publication ? 2 : 1;
  if (d < first_service + services) return service(d - first_service, is_publication, node);
  if (d == first_service + services) {
    return {"rt/parameter_events", "rcl_interfaces::msg::dds_::ParameterEvent_"};
  }
  return {fmt::format("rt/default/topic_{:02}", d), "std_msgs::msg::dds_::String_"};
}

}  // namespace stormproof::capture::write
