// The participant of Cyclone DDS 0.10: the same endpoints, created one after the other, on the one
// interface, with SEDP by unicast (spdp) or by multicast.
#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <dds/dds.h>

#include "endpoints.hpp"
#include "participant.hpp"
#include "progress.hpp"

namespace stormproof::live {

namespace {

dds_entity_t made(dds_entity_t entity, const std::string& what) {
  if (entity < 0) {
    throw std::runtime_error("Cyclone DDS does not create " + what + ": " +
                             dds_strretcode(-entity));
  }
  return entity;
}

/// The domain, with the interface of the bed.
void configure(const Options& options) {
  const std::string text =
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"" +
      options.address + "\"/></Interfaces><AllowMulticast>" +
      (options.multicast ? "true" : "spdp") + "</AllowMulticast></General></Domain></CycloneDDS>";
  made(dds_create_domain(0, text.c_str()), "the domain");
}

/// A type that is a name and a number: nothing is published.
dds_entity_t create_topic(dds_entity_t participant, const EndpointPlan& plan) {
  static const std::array<std::uint32_t, 3> ops = {
      static_cast<std::uint32_t>(DDS_OP_ADR) | static_cast<std::uint32_t>(DDS_OP_TYPE_4BY), 0,
      DDS_OP_RTS};
  const dds_topic_descriptor_t type = {.m_size = 4,
                                       .m_align = 4,
                                       .m_flagset = DDS_TOPIC_FIXED_SIZE,
                                       .m_nkeys = 0,
                                       .m_typename = plan.type.c_str(),
                                       .m_keys = nullptr,
                                       .m_nops = 2,
                                       .m_ops = ops.data(),
                                       .m_meta = "",
                                       .type_information = {},
                                       .type_mapping = {},
                                       .restrict_data_representation = 0};
  return made(dds_create_topic(participant, &type, plan.topic.c_str(), nullptr, nullptr),
              "the topic " + plan.topic);
}

class Qos {
 public:
  explicit Qos(const EndpointPlan& plan) {
    dds_qset_reliability(qos_, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(
        qos_, plan.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos_, plan.depth == 0 ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST,
                     plan.depth);
    if (plan.lifespan_seconds != 0 && plan.direction == Direction::publication) {
      dds_qset_lifespan(qos_, DDS_SECS(plan.lifespan_seconds));
    }
  }
  /// Of a participant, as rmw_cyclonedds has it, but that the enclave is the host.
  explicit Qos(std::uint32_t host) {
    const std::string text = user_data_of(host);
    dds_qset_userdata(qos_, text.data(), text.size());
  }
  ~Qos() { dds_delete_qos(qos_); }
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;

  static std::string user_data_of(std::uint32_t host) {
    return "enclave=" + std::to_string(host) + ";";
  }
  [[nodiscard]] const dds_qos_t* get() const { return qos_; }

 private:
  dds_qos_t* qos_ = dds_create_qos();
};

/// Endpoints of other hosts, found in the builtin topics. Called by several threads.
class Watch {
 public:
  Watch(Progress& progress, std::uint32_t own_host)
      : progress_(progress), own_(Qos::user_data_of(own_host)) {}

  Progress& progress() { return progress_; }

  void saw(const dds_builtintopic_participant_t& participant) {
    void* data = nullptr;
    std::size_t size = 0;
    const bool has_data = dds_qget_userdata(participant.qos, &data, &size);
    const std::string text = has_data ? std::string(static_cast<const char*>(data), size) : "";
    dds_free(data);
    if (text.empty() || text == own_) {
      return;
    }
    const std::lock_guard lock(mutex_);
    Found& found = participants_[key_of(participant.key)];
    found.is_elsewhere = true;
    progress_.strict.add(found.endpoints);
    found.endpoints = 0;
  }

  void saw(const dds_builtintopic_endpoint_t& endpoint) {
    const std::lock_guard lock(mutex_);
    Found& found = participants_[key_of(endpoint.participant_key)];
    if (found.is_elsewhere) {
      progress_.strict.add(1);
    } else {
      ++found.endpoints;
    }
  }

 private:
  struct Found {
    bool is_elsewhere = false;
    int endpoints = 0;  ///< that are not counted, as it is not known where it is
  };

  static std::string key_of(const dds_guid_t& guid) {
    return {reinterpret_cast<const char*>(guid.v), sizeof guid.v};
  }

  Progress& progress_;
  std::string own_;
  std::mutex mutex_;
  std::map<std::string, Found> participants_;
};

template <class Sample>
void on_data(dds_entity_t reader, void* watch) {
  constexpr std::size_t most = 64;
  for (;;) {
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos{};
    const int count = dds_take(reader, samples.data(), infos.data(), most, most);
    if (count <= 0) {
      return;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      if (infos[k].valid_data && infos[k].instance_state == DDS_IST_ALIVE) {
        static_cast<Watch*>(watch)->saw(*static_cast<const Sample*>(samples[k]));
      }
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

template <class Sample>
void watch_builtin(dds_entity_t participant, dds_entity_t topic, Watch& watch) {
  dds_listener_t* listener = dds_create_listener(&watch);
  dds_lset_data_available(listener, on_data<Sample>);
  const dds_entity_t reader =
      made(dds_create_reader(participant, topic, nullptr, listener), "a reader of a builtin topic");
  dds_delete_listener(listener);
  on_data<Sample>(reader, &watch);  // what was there before the listener
}

void publication_matched(dds_entity_t /*writer*/, dds_publication_matched_status_t status,
                         void* watch) {
  static_cast<Watch*>(watch)->progress().app.add(status.current_count_change);
}

void subscription_matched(dds_entity_t /*reader*/, dds_subscription_matched_status_t status,
                          void* watch) {
  static_cast<Watch*>(watch)->progress().app.add(status.current_count_change);
}

/// One description for both sides of a topic.
class Topics {
 public:
  explicit Topics(dds_entity_t participant) : participant_(participant) {}

  dds_entity_t of(const EndpointPlan& plan) {
    const auto [at, is_new] = topics_.try_emplace(plan.topic, 0);
    if (is_new) {
      at->second = create_topic(participant_, plan);
    }
    return at->second;
  }

 private:
  dds_entity_t participant_;
  std::map<std::string, dds_entity_t> topics_;
};

}  // namespace

void create_server(const Options& /*options*/) {
  throw std::invalid_argument("--serves: Cyclone DDS has no Discovery Server");
}

Schedule create_participant(const Options& options, Progress& progress,
                            const std::function<void()>& wait_for_start) {
  if (options.simultaneous || options.discovery != Discovery::simple || options.send_buffer != 0) {
    throw std::invalid_argument(
        "--simultaneous, --discovery and --send-buffer are those of Fast DDS");
  }
  static Watch watch(progress, options.host);  // called until the process ends
  wait_for_start();
  Schedule schedule;
  schedule.created_ns = now_ns();
  configure(options);
  const dds_entity_t participant =
      made(dds_create_participant(0, Qos(options.host).get(), nullptr), "the participant");
  watch_builtin<dds_builtintopic_participant_t>(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT,
                                                watch);
  watch_builtin<dds_builtintopic_endpoint_t>(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, watch);
  watch_builtin<dds_builtintopic_endpoint_t>(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION,
                                             watch);
  dds_listener_t* listener = dds_create_listener(&watch);
  dds_lset_publication_matched(listener, publication_matched);
  dds_lset_subscription_matched(listener, subscription_matched);
  Topics topics(participant);
  const std::vector<EndpointPlan> plans = node_endpoints(options);
  for (std::size_t index = 0; index < plans.size(); ++index) {
    const auto part = static_cast<std::int64_t>(index + 1);
    sleep_until_ns(schedule.created_ns +
                   options.create_over_ns * part / static_cast<std::int64_t>(plans.size()));
    const EndpointPlan& plan = plans[index];
    const Qos qos(plan);
    if (plan.direction == Direction::publication) {
      made(dds_create_writer(participant, topics.of(plan), qos.get(), listener),
           "the publication of " + plan.topic);
    } else {
      made(dds_create_reader(participant, topics.of(plan), qos.get(), listener),
           "the subscription of " + plan.topic);
    }
  }
  dds_delete_listener(listener);
  schedule.endpoints_done_ns = now_ns();
  return schedule;
}

}  // namespace stormproof::live
