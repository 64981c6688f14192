// Watches what a participant of Fast DDS discovers.
#pragma once

#include <string>
#include <utility>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/rtps/common/RemoteLocators.hpp>

#include "progress.hpp"

namespace stormproof::live {

class Listener : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// `own`: the host's IPv4 address; endpoints that announce another are of another host.
  Listener(std::string own, Progress& progress) : own_(std::move(own)), progress_(progress) {}

  void on_publication_matched(
      eprosima::fastdds::dds::DataWriter* writer,
      const eprosima::fastdds::dds::PublicationMatchedStatus& status) override;
  void on_subscription_matched(
      eprosima::fastdds::dds::DataReader* reader,
      const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& found) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& found) override;

 private:
  [[nodiscard]] bool is_elsewhere(
      const eprosima::fastrtps::rtps::RemoteLocatorList& locators) const;

  std::string own_;
  Progress& progress_;
};

}  // namespace stormproof::live
