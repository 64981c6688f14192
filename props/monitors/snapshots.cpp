// safety.snapshot: the bitmap of an ACKNACK is what the reader lacked when it was generated, and it
// reaches the writer as it was generated, however much the reader has received since. Fast DDS: it
// lists what was lacking below `announced`, and its base is the first descriptor that was lacking;
// an initial ACKNACK claims nothing (base 0, empty bitmap).
#include <algorithm>
#include <map>
#include <tuple>

#include "model/implementations.hpp"
#include "props/monitors/data_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/descriptors.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/number_map.hpp"

namespace stormproof::props {

namespace {

struct Snapshot {
  Descriptors listed;
  std::uint32_t base = 0;
  bool operator==(const Snapshot&) const = default;
};

class Snapshots : public DataObserver<> {
 public:
  static constexpr std::array hears_machines{model::Report::reader_transition};
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}
          .only({model::Report::emitted, model::Report::looped_back, model::Report::arrived},
                {model::PacketKind::acknack})
          .only({model::Report::received}, {model::PacketKind::data, model::PacketKind::heartbeat,
                                            model::PacketKind::acknack});

  explicit Snapshots(const model::Scenario& scenario)
      : DataObserver{"safety.snapshot"},
        bases_{model::traits_of(scenario.dds).acknacks_have_bases} {}

  void run_started(const model::Topology& topology) override {
    DataObserver::run_started(topology);
    announced_.assign(topology.relation_count(), 0);
  }
  void took(const model::Packet& data, std::uint32_t) override {
    if (!data.descriptors.empty()) raise(data.relation(), data.descriptors.highest() + 1);
  }
  void transition(const model::Transition& fired) override {
    DataObserver::transition(fired);
    if (announcing_ == nullptr || announced_in_ != event()) return;
    const std::uint32_t relation = announcing_->relation();
    const bool is_new =
        fired.machine.subject == relation && announcing_->detail > announced_[relation];
    if (is_new && fired.event == "HeartbeatReceived") announced_[relation] = announcing_->detail;
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind != model::PacketKind::acknack) return;
    Snapshot snapshot = check(packet);
    if (Snapshot* place = under_way_.add(packet.number)) *place = std::move(snapshot);
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override {
    if (packet.kind == model::PacketKind::acknack) looped_[key(packet)].push_back(check(packet));
  }
  void arrived(const model::Packet& packet, bool lost) override {
    if (lost && packet.kind == model::PacketKind::acknack) under_way_.remove(packet.number);
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    DataObserver::received(packet, receiver);
    const bool announces = packet.kind == model::PacketKind::heartbeat || packet.carries_heartbeat;
    announcing_ = announces ? &packet : nullptr;
    announced_in_ = event();
    if (packet.kind == model::PacketKind::acknack) compare(packet);
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(compared_) + " ACKNACKs reached their writer as generated."};
  }

 private:
  using LoopKey = std::tuple<std::uint32_t, std::int64_t, bool>;
  static LoopKey key(const model::Packet& packet) {
    return {packet.relation(), packet.emitted.count(), packet.initial_acknack};
  }
  void raise(std::uint32_t relation, std::uint32_t announced) {
    announced_[relation] = std::max(announced_[relation], announced);
  }

  Snapshot content(const model::Packet& packet) const {
    return {Descriptors{packet.descriptors}, bases_ ? packet.detail : 0};
  }

  /// What the reader lacks now, as an ACKNACK should say it.
  Snapshot expected(const model::Packet& packet) const {
    const std::uint32_t relation = packet.relation();
    const std::uint32_t count = topology().descriptor_count(relation);
    const bool claims = !(bases_ && packet.initial_acknack);
    Snapshot snapshot;
    std::uint32_t first = count;
    for (std::uint32_t k = 0; k < x().word_count(relation); ++k) {
      const std::uint64_t lacking = RelationWords::below(count, k) & ~x().word(relation, k);
      const std::uint32_t limit = bases_ ? announced_[relation] : count;
      if (claims) snapshot.listed.add(k, lacking & RelationWords::below(limit, k));
      if (lacking != 0 && first == count) {
        first = 64 * k + static_cast<std::uint32_t>(std::countr_zero(lacking));
      }
    }
    if (bases_ && claims) snapshot.base = first;
    return snapshot;
  }

  Snapshot check(const model::Packet& packet) {
    Snapshot snapshot = content(packet);
    if (snapshot != expected(packet)) {
      object_now("The ACKNACK about " + relation_text(topology(), packet.relation()) +
                 " that is generated at " + time_text(now()) +
                 " does not list what its reader lacks then.");
    }
    return snapshot;
  }

  void compare(const model::Packet& packet) {
    const Snapshot arriving = content(packet);
    bool same = true;
    if (topology().pair(packet.pair).cross_host) {
      const Snapshot* const found = under_way_.find(packet.number);
      if (found == nullptr) return;
      same = *found == arriving;
      under_way_.remove(packet.number);
    } else {
      const auto found = looped_.find(key(packet));
      if (found == looped_.end()) return;
      const auto match = std::ranges::find(found->second, arriving);
      same = match != found->second.end();
      if (same) found->second.erase(match);
      if (found->second.empty()) looped_.erase(found);
    }
    ++compared_;
    if (same) return;
    object_now("The ACKNACK about " + relation_text(topology(), packet.relation()) +
               " that was generated at " + time_text(packet.emitted) +
               " arrives with another bitmap at " + time_text(now()) + ".");
  }

  bool bases_;
  const model::Packet* announcing_ = nullptr;  // which lives as long as the event
  std::uint64_t announced_in_ = 0;
  std::vector<std::uint32_t> announced_;  // by relation
  NumberMap<Snapshot> under_way_;
  std::map<LoopKey, std::vector<Snapshot>> looped_;
  std::uint64_t compared_ = 0;
};

}  // namespace

MonitorPtr watch_snapshots(const model::Scenario& scenario) {
  if (has_samples(scenario)) return watch_acknack_samples();
  return attentive<Snapshots>(scenario);
}

}  // namespace stormproof::props
