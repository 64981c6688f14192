// Sets Fast DDS up as rmw_fastrtps does (names, QoS, memory policy), without shared memory,
// intra-process delivery and data sharing: what two hosts can share is UDP.
#include "participant.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

#include "endpoints.hpp"
#include "listener.hpp"

namespace stormproof::live {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;

/// A type that only has a name: discovery does not need more, and nothing is published.
class NamedType : public dds::TopicDataType {
 public:
  explicit NamedType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 4096 + 4;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void*, rtps::SerializedPayload_t*) override { return false; }
  bool deserialize(rtps::SerializedPayload_t*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return std::uint32_t{4}; };
  }
  void* createData() override { return new char; }
  void deleteData(void* data) override { delete static_cast<char*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

template <typename Pointer>
Pointer made(Pointer pointer, const std::string& what) {
  if (pointer == nullptr) {
    throw std::runtime_error("Fast DDS does not create " + what);
  }
  return pointer;
}

/// Of server 0, as tools and ROS 2 have it.
constexpr const char* server_prefix = "44.53.00.5f.45.50.52.4f.53.49.4d.41";
constexpr std::uint32_t server_port = 11811;

/// Port 0: the library takes those of the first participants of the host.
rtps::Locator_t locator_of(const std::string& address, std::uint32_t port) {
  rtps::Locator_t locator;
  rtps::IPLocator::setIPv4(locator, address);
  locator.port = port;
  return locator;
}

void set_discovery(const Options& options, UDPv4TransportDescriptor& transport,
                   dds::WireProtocolConfigQos& protocol) {
  rtps::BuiltinAttributes& builtin = protocol.builtin;
  if (options.serves) {
    builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol_t::SERVER;
    std::istringstream{server_prefix} >> protocol.prefix;
    builtin.metatrafficUnicastLocatorList.push_back(locator_of(options.server, server_port));
  } else if (options.discovery == Discovery::static_peers) {
    transport.maxInitialPeersRange = options.participants_per_host;
    for (const std::string& host : options.addresses) {
      builtin.initialPeersList.push_back(locator_of(host, 0));
    }
  } else if (options.discovery != Discovery::simple) {
    builtin.discovery_config.discoveryProtocol = options.discovery == Discovery::server
                                                     ? rtps::DiscoveryProtocol_t::CLIENT
                                                     : rtps::DiscoveryProtocol_t::SUPER_CLIENT;
    eprosima::fastdds::rtps::RemoteServerAttributes server;
    server.ReadguidPrefix(server_prefix);
    server.metatrafficUnicastLocatorList.push_back(locator_of(options.server, server_port));
    builtin.discovery_config.m_DiscoveryServers.push_back(server);
  }
}

dds::DomainParticipantQos participant_qos(const Options& options) {
  dds::DomainParticipantQos qos;
  qos.name("/");
  const std::string enclave = "enclave=/;";
  qos.user_data().data_vec().assign(enclave.begin(), enclave.end());
  qos.wire_protocol().builtin.readerHistoryMemoryPolicy =
      rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.wire_protocol().builtin.writerHistoryMemoryPolicy =
      rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  const auto transport = std::make_shared<UDPv4TransportDescriptor>();
  transport->interfaceWhiteList.push_back(options.address);
  transport->sendBufferSize = options.send_buffer;
  set_discovery(options, *transport, qos.wire_protocol());
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(transport);
  return qos;
}

/// What writers and readers have in common.
template <typename Qos>
Qos endpoint_qos(const EndpointPlan& plan) {
  Qos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      plan.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = plan.depth == 0 ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  if (plan.depth != 0) {
    qos.history().depth = plan.depth;
    qos.resource_limits().max_samples_per_instance = plan.depth;
    qos.resource_limits().max_samples = std::numeric_limits<std::int32_t>::max();
  }
  qos.resource_limits().allocated_samples = 1;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  return qos;
}

class Node {
 public:
  explicit Node(dds::DomainParticipant& participant)
      : participant_(participant),
        publisher_(made(participant.create_publisher(dds::PUBLISHER_QOS_DEFAULT), "a publisher")),
        subscriber_(
            made(participant.create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "a subscriber")) {}

  void create(const EndpointPlan& plan) {
    dds::Topic* topic = topic_of(plan);
    if (plan.direction == Direction::publication) {
      auto qos = endpoint_qos<dds::DataWriterQos>(plan);
      if (plan.lifespan_seconds != 0) {
        qos.lifespan().duration = {plan.lifespan_seconds, 0};
      }
      made(publisher_->create_datawriter(topic, qos), "the publication of " + plan.topic);
    } else {
      const auto qos = endpoint_qos<dds::DataReaderQos>(plan);
      made(subscriber_->create_datareader(topic, qos), "the subscription of " + plan.topic);
    }
  }

 private:
  /// Both sides of a topic share one description, as participants may have only one.
  dds::Topic* topic_of(const EndpointPlan& plan) {
    if (dds::TopicDescription* known = participant_.lookup_topicdescription(plan.topic)) {
      return static_cast<dds::Topic*>(known);
    }
    dds::TypeSupport(new NamedType(plan.type)).register_type(&participant_);
    return made(participant_.create_topic(plan.topic, plan.type, dds::TOPIC_QOS_DEFAULT),
                "the topic " + plan.topic);
  }

  dds::DomainParticipant& participant_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
};

void without_shortcuts() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

}  // namespace

void create_server(const Options& options) {
  without_shortcuts();
  made(dds::DomainParticipantFactory::get_instance()->create_participant(
           0, participant_qos(options), nullptr, dds::StatusMask::none()),
       "the server");
}

Schedule create_participant(const Options& options, Progress& progress,
                            const std::function<void()>& wait_for_start) {
  without_shortcuts();
  dds::DomainParticipantFactory* factory = dds::DomainParticipantFactory::get_instance();
  dds::DomainParticipantFactoryQos factory_qos;
  factory->get_qos(factory_qos);
  factory_qos.entity_factory().autoenable_created_entities = !options.simultaneous;
  factory->set_qos(factory_qos);

  // With a simultaneous start nothing is announced before all endpoints exist: no need to wait.
  Schedule schedule;
  if (!options.simultaneous) {
    wait_for_start();
    schedule.created_ns = now_ns();
  }
  static Listener listener(options.address, progress);  // called until the process ends
  dds::StatusMask matching = dds::StatusMask::publication_matched();
  matching << dds::StatusMask::subscription_matched();
  dds::DomainParticipant* participant =
      made(factory->create_participant(0, participant_qos(options), &listener, matching),
           "the participant");
  Node node(*participant);
  const std::vector<EndpointPlan> plans = node_endpoints(options);
  for (std::size_t index = 0; index < plans.size(); ++index) {
    const auto part = static_cast<std::int64_t>(index + 1);
    sleep_until_ns(schedule.created_ns +
                   options.create_over_ns * part / static_cast<std::int64_t>(plans.size()));
    node.create(plans[index]);
  }
  if (options.simultaneous) {
    wait_for_start();
    schedule.created_ns = now_ns();
    if (participant->enable() != eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      throw std::runtime_error("Fast DDS does not enable the participant");
    }
  }
  schedule.endpoints_done_ns = now_ns();
  return schedule;
}

}  // namespace stormproof::live
