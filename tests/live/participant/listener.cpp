// The callbacks of Fast DDS, turned into counts.
#include "listener.hpp"

#include <algorithm>

#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>

namespace stormproof::live {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

void Listener::on_publication_matched(dds::DataWriter* /*writer*/,
                                      const dds::PublicationMatchedStatus& status) {
  progress_.app.add(status.current_count_change);
}

void Listener::on_subscription_matched(dds::DataReader* /*reader*/,
                                       const dds::SubscriptionMatchedStatus& status) {
  progress_.app.add(status.current_count_change);
}

void Listener::on_publisher_discovery(dds::DomainParticipant* /*participant*/,
                                      rtps::WriterDiscoveryInfo&& found) {
  if (found.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER &&
      is_elsewhere(found.info.remote_locators())) {
    progress_.strict.add(1);
  }
}

void Listener::on_subscriber_discovery(dds::DomainParticipant* /*participant*/,
                                       rtps::ReaderDiscoveryInfo&& found) {
  if (found.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER &&
      is_elsewhere(found.info.remote_locators())) {
    progress_.strict.add(1);
  }
}

bool Listener::is_elsewhere(const rtps::RemoteLocatorList& locators) const {
  const auto is_own = [this](const auto& locator) {
    return rtps::IPLocator::toIPv4string(locator) == own_;
  };
  return !locators.unicast.empty() &&
         std::none_of(locators.unicast.begin(), locators.unicast.end(), is_own);
}

}  // namespace stormproof::live
