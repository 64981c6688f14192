// The callbacks of Fast DDS, turned into counts.
#include "progress.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>

#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>

namespace stormproof::live {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void sleep_until_ns(std::int64_t instant_ns) {
  const timespec instant{.tv_sec = instant_ns / 1'000'000'000,
                         .tv_nsec = instant_ns % 1'000'000'000};
  while (clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &instant, nullptr) == EINTR) {
  }
}

void Progress::on_publication_matched(dds::DataWriter* /*writer*/,
                                      const dds::PublicationMatchedStatus& status) {
  app.add(status.current_count_change);
}

void Progress::on_subscription_matched(dds::DataReader* /*reader*/,
                                       const dds::SubscriptionMatchedStatus& status) {
  app.add(status.current_count_change);
}

void Progress::on_publisher_discovery(dds::DomainParticipant* /*participant*/,
                                      rtps::WriterDiscoveryInfo&& found) {
  if (found.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER &&
      is_at_peer(found.info.remote_locators())) {
    strict.add(1);
  }
}

void Progress::on_subscriber_discovery(dds::DomainParticipant* /*participant*/,
                                       rtps::ReaderDiscoveryInfo&& found) {
  if (found.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER &&
      is_at_peer(found.info.remote_locators())) {
    strict.add(1);
  }
}

bool Progress::is_at_peer(const rtps::RemoteLocatorList& locators) const {
  return std::any_of(locators.unicast.begin(), locators.unicast.end(), [this](const auto& locator) {
    return rtps::IPLocator::toIPv4string(locator) == peer_;
  });
}

}  // namespace stormproof::live
