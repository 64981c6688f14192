// Watches what a participant discovers and notes the instant at which it has everything: "app" is
// the paper's measure (all matched counters reached), "strict" means that every endpoint of the
// other host is known, also those that match nothing here.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/rtps/common/RemoteLocators.hpp>

namespace stormproof::live {

/// The wall clock in ns since 1970: that of the captures.
[[nodiscard]] std::int64_t now_ns();
/// Returns at this instant, or at once if it is over.
void sleep_until_ns(std::int64_t instant_ns);

/// Counts up to what is expected and keeps the instant of the last one. Callbacks of several
/// threads may count.
class Milestone {
 public:
  explicit Milestone(std::size_t expected) : expected_(static_cast<std::int64_t>(expected)) {}

  void add(std::int64_t change) {
    if (count_.fetch_add(change) + change == expected_) {
      reached_ns_ = now_ns();
    }
  }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::int64_t expected() const { return expected_; }
  /// ns since 1970; 0: not reached.
  [[nodiscard]] std::int64_t reached_ns() const { return reached_ns_; }

 private:
  std::int64_t expected_;
  std::atomic<std::int64_t> count_{0};
  std::atomic<std::int64_t> reached_ns_{0};
};

class Progress : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// `peer`: the other host's IPv4 address; its endpoints are those that announce it.
  Progress(std::string peer, std::size_t matches, std::size_t discoveries)
      : peer_(std::move(peer)), app(matches), strict(discoveries) {}

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

  [[nodiscard]] bool is_complete() const {
    return app.reached_ns() != 0 && strict.reached_ns() != 0;
  }

 private:
  [[nodiscard]] bool is_at_peer(const eprosima::fastrtps::rtps::RemoteLocatorList& locators) const;

  std::string peer_;

 public:
  Milestone app;
  Milestone strict;
};

}  // namespace stormproof::live
