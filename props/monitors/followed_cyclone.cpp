// Follows Cyclone DDS's composition: which submessages reach whom, which sides of user topics open,
// and what the event thread does with timers and messages. How messages share packets is no choice
// of the host's there (specs/guide/cyclone.md, "Timers and the event thread"), so that each packet
// is what the rules say, with its size.
#include <map>

#include "fsm/composition/cyclone.hpp"
#include "props/monitors/followed_cyclone_thread.hpp"
#include "props/monitors/followed_rules.hpp"

namespace stormproof::props {

namespace {

namespace cyclone = comp::cyclone;
namespace slot = model::cyclone::writer;
using model::Stream;

std::uint32_t slot_of(Stream stream) {
  return stream == Stream::pub ? slot::publications : slot::subscriptions;
}
Stream other(Stream stream) { return stream == Stream::pub ? Stream::sub : Stream::pub; }

class CycloneFollower final : public FollowedRules<CycloneFollower, cyclone::Cyclone> {
 public:
  static constexpr bool readers_in_order_of_match = false;
  static constexpr bool cancels_any_timer = false;

  CycloneFollower(const model::Scenario& scenario, const model::Topology& topology)
      : FollowedRules{scenario,
                      topology,
                      {model::cyclone::writers_per_participant(topology), slot::first_topic}},
        threads_(topology.participant_count()) {
    for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
      const Place liveliness = writer_place(stride() * i + slot::liveliness);
      assign<cyclone::Exists>(liveliness, 1);
      assign<cyclone::Sent>(liveliness, 1);
    }
  }

  void started() override {
    begin("The start");
    for (std::uint32_t i = 0; i < topology_.participant_count(); ++i) {
      expect(Scheduled{model::EventKind::participant_start, i, topology_.start(i)}, {});
      take_creations(i, [](const Scheduled&) {});
    }
  }
  void due(const model::Event& event) override {
    const std::uint32_t i = event.subject;
    if (event.kind == model::EventKind::participant_start) {
      run<comp::Happens<cyclone::Starts>>({.participant = i});
    } else if (event.kind == model::EventKind::endpoint_creation) {
      const std::uint32_t publications = topology_.descriptor_count(i, Stream::pub);
      const auto [stream, d] =
          model::creation_order(event.detail, publications - model::default_publications);
      Place place = writer_place(stride() * i + slot_of(stream));
      place.descriptor = d;
      run<comp::Happens<cyclone::Created>>(place);
    } else {
      FollowedRules::due(event);
    }
  }
  /// What reaches a participant before it listens is lost.
  void received(const Message& message, std::uint32_t receiver, model::Nanoseconds) override {
    const model::Participant& participant = scenario_.deployment.participants[receiver];
    if (now_ < participant.open.value_or(participant.start)) return;
    const bool of_group = message.to_group;
    const std::uint32_t sender = of_group ? message.pair : topology_.pair(message.pair).source;
    for (const Message& content : message.contents) {
      hear(content, sender, receiver);
      if (run_ends()) return;
    }
    run<comp::Happens<cyclone::PacketEnds>>({.participant = receiver});
  }

  static constexpr model::MachineRef::Kind machine_kind(comp::Owner owner) {
    using enum model::MachineRef::Kind;
    if (owner == comp::owner::relation) return endpoint_relation;
    if (owner == comp::owner::writer) return endpoint_writer;
    return owner == comp::owner::pair ? pair : participant;
  }
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t writer) const {
    const std::uint32_t number = writer % stride();
    if (number > slot::subscriptions) return number == slot::liveliness ? 1 : 0;
    return topology_.descriptor_count(writer / stride(), model::streams[number]);
  }
  using FollowedRules::becomes;
  void becomes(comp::X x, const Place& place) {
    if (place.writer % stride() <= slot::subscriptions) FollowedRules::becomes(x, place);
  }
  void becomes(cyclone::WriterOpen open, const Place& place) {
    FollowedRules::becomes(open, place);
    ++versions_[place.writer];
  }

  using FollowedRules::knob;
  [[nodiscard]] std::int64_t knob(cyclone::SendTime) const {
    return scenario_.deployment.time_to_send().count();
  }
  using FollowedRules::answer;
  bool answer(cyclone::IsQueued, World& w) { return is_queued(w, false); }
  bool answer(cyclone::IsQueuedForIt, World& w) { return is_queued(w, true); }
  bool answer(cyclone::QueueIsFull, World& w) {
    return std::ranges::count_if(thread(w).queue, &CycloneMessage::is_repair) >=
           dds().sedp.max_queued_rexmit_messages;
  }
  bool answer(cyclone::AnswerIsKept, World& w) {
    return thread(w).answer && thread(w).answer->relation == w.place().relation;
  }
  bool answer(cyclone::SomeAnswerIsKept, World& w) { return thread(w).answer.has_value(); }

  // What submessages say, besides what packets of others do.
  using FollowedRules::says;
  static bool says(cyclone::IsDirected, const Message& heard) { return heard.directed; }
  static std::int64_t says(cyclone::Count, const Message& heard) { return heard.count; }
  using FollowedRules::say;
  /// DATA carries the sample of its place.
  template <class Term>
  static void say(Message& content, World& w, const comp::Says<comp::Carries, Term>&) {
    content.descriptors.add(w.place().descriptor);
  }
  static void say(Message& content, World&, const comp::Says<cyclone::IsDirected, bool>& directed) {
    content.directed = directed.value;
  }
  static void say(Message& content, World&, const comp::Says<cyclone::Count, std::int64_t>& count) {
    content.count = count.value;
  }

  // Messages. What a timer gives goes into the packet that is open; all else waits in the queue.
  template <class Sayings>
  void emit(cyclone::Spdp, World& w, const Sayings& sayings, comp::Site) {
    enqueue(w, message(w, model::PacketKind::spdp_unicast, sayings, to_reader(w)));
  }
  template <class Sayings>
  void emit(cyclone::Data, World& w, const Sayings& sayings, comp::Site) {
    CycloneMessage data = message(w, model::PacketKind::data, sayings, to_reader(w));
    data.is_repair = true;
    enqueue(w, std::move(data));
  }
  template <class Sayings>
  void emit(cyclone::Heartbeat, World& w, const Sayings& sayings, comp::Site) {
    const bool to_all = w.place().pair == Place::nowhere;
    CycloneMessage heartbeat =
        message(w, model::PacketKind::heartbeat, sayings, to_all ? to_readers(w) : to_reader(w));
    if (heartbeat.content.directed) {
      thread(w).answer = {w.place().relation, std::move(heartbeat)};
    } else {
      thread(w).give(std::move(heartbeat));
    }
  }
  template <class Sayings>
  void emit(cyclone::AckNack, World& w, const Sayings& sayings, comp::Site) {
    const auto to_writer = CycloneDestination::only(w.place().participant);
    threads_[reader(w)].give(message(w, model::PacketKind::acknack, sayings, to_writer));
  }

  using FollowedRules::perform;
  void perform(cyclone::HeartbeatToAll, World& w) { cyclone::emit_heartbeat(w, false); }
  void perform(cyclone::DataToAll, World& w) {
    const auto sample = comp::says(comp::Says{comp::Carries{}, comp::everyone});
    enqueue(w, message(w, model::PacketKind::data, sample, to_readers(w)));
  }
  void perform(cyclone::Announce, World& w) {
    CycloneDestination to{.is_set = true, .addresses = {CycloneDestination::group}};
    for (const std::uint32_t pair : known_peers(w.place().participant)) {
      if (!multicast_) to.addresses.push_back(topology_.pair(pair).destination);
    }
    enqueue(w, message(w, model::PacketKind::spdp_unicast, comp::says(), std::move(to)));
  }
  void perform(cyclone::SendToAllInstead, World& w) {
    for (CycloneMessage& queued : thread(w).queue) {
      const bool is_of_another = !queued.to.is_set && !queued.to.is_only(reader(w));
      if (is_of_another && repeats(queued, w)) queued.to = to_readers(w);
    }
  }
  void perform(cyclone::LetAnswerGo, World& w) {
    if (auto answer = std::exchange(thread(w).answer, {})) enqueue(w, std::move(answer->message));
  }
  template <class Part>
  void perform(cyclone::JoinList, World& w, Part) {
    using Fires = decltype(occasion_of(Part{}));
    const bool is_readers = std::is_same_v<Part, cyclone::AckTimer>;
    const std::uint32_t i = is_readers ? reader(w) : w.place().participant;
    threads_[i].list.push_back([this, place = w.place()] { run<comp::Happens<Fires>>(place); });
  }
  void perform(cyclone::Work, World& w) { work(w.place().participant); }
  /// After a creation, or the notification of one.
  void perform(cyclone::OpenTopics, World& w) {
    const std::uint32_t number = w.place().writer % stride();
    if (number > slot::subscriptions) return;
    const Stream stream = model::streams[number];
    const std::uint32_t topic = model::cyclone::topic_writer(stream, w.place().descriptor);
    if (topic == slot::none) return;
    const std::uint32_t counterpart = model::cyclone::descriptor_of(topic, other(stream));
    if (w.place().pair == Place::nowhere) {
      const std::uint32_t i = w.place().participant;
      for (std::uint32_t p = topology_.first_pair(i); p < topology_.first_pair(i + 1); ++p) {
        const Place told =
            relation_place(stride() * topology_.pair(p).reverse + slot_of(other(stream)));
        if (has<cyclone::Notified>(told, counterpart)) open_side(p, stream, topic);
      }
    } else {
      const std::uint32_t p = topology_.pair(w.place().pair).reverse;
      const Place own = writer_place(stride() * reader(w) + slot_of(other(stream)));
      if (has<cyclone::Exists>(own, counterpart)) open_side(p, other(stream), topic);
    }
  }

 private:
  [[nodiscard]] std::uint32_t stride() const { return writers().stride; }
  static cyclone::AckTimerFires occasion_of(cyclone::AckTimer) { return {}; }
  static cyclone::HeartbeatTimerFires occasion_of(cyclone::HeartbeatTimer) { return {}; }
  static cyclone::SpdpTimerFires occasion_of(cyclone::SpdpTimer) { return {}; }
  static cyclone::ReplyTimerFires occasion_of(cyclone::ReplyTimer) { return {}; }

  [[nodiscard]] CycloneThread& thread(const World& w) { return threads_[w.place().participant]; }
  [[nodiscard]] std::uint32_t reader(const World& w) const {
    return topology_.pair(w.place().pair).destination;
  }
  [[nodiscard]] CycloneDestination to_reader(const World& w) const {
    return CycloneDestination::only(reader(w));
  }
  [[nodiscard]] CycloneDestination to_readers(const World& w) {
    const std::uint32_t writer = w.place().writer;
    CycloneDestination to{true, {}, writer, versions_[writer]};
    for (const std::uint32_t relation : readers(writer)) {
      to.addresses.push_back(topology_.pair(relation / stride()).destination);
    }
    if (multicast_ && to.addresses.size() > 1) to.addresses = {CycloneDestination::group};
    return to;
  }
  /// A retransmission of the sample of this place.
  [[nodiscard]] bool repeats(const CycloneMessage& queued, const World& w) const {
    return queued.is_repair && queued.content.writer == w.place().writer % stride() &&
           queued.content.descriptors.least() == w.place().descriptor;
  }
  [[nodiscard]] bool is_queued(const World& w, bool only_for_it) {
    return std::ranges::any_of(thread(w).queue, [&](const CycloneMessage& queued) {
      return repeats(queued, w) && (!only_for_it || queued.to.is_only(reader(w)));
    });
  }
  void enqueue(const World& w, CycloneMessage&& message) {
    thread(w).queue.push_back(std::move(message));
  }
  /// About the writer of this place.
  template <class... Sayings>
  CycloneMessage message(World& w, model::PacketKind kind, const std::tuple<Sayings...>& sayings,
                         CycloneDestination to) {
    Message content;
    content.kind = kind;
    content.pair = w.place().participant;
    content.writer = w.place().writer % stride();
    std::apply([&](const auto&... each) { (say(content, w, each), ...); }, sayings);
    const auto known = w.count([](World& d) { return d(cyclone::Known{}); });
    const std::int64_t bytes = bytes_of(content, known, multicast_);
    return {std::move(content), std::move(to), bytes};
  }

  void hear(const Message& content, std::uint32_t sender, std::uint32_t receiver) {
    const bool to_writer = content.kind == model::PacketKind::acknack;
    const std::uint32_t pair = to_writer ? topology_.pair_between(receiver, sender)
                                         : topology_.pair_between(sender, receiver);
    const Place place = relation_place(stride() * pair + content.writer);
    switch (content.kind) {
      case model::PacketKind::data:
        return run<comp::Received<cyclone::Data>>(place, &content);
      case model::PacketKind::heartbeat:
        return run<comp::Received<cyclone::Heartbeat>>(place, &content);
      case model::PacketKind::acknack:
        return run<comp::Received<cyclone::AckNack>>(place, &content);
      default:
        return run<comp::Received<cyclone::Spdp>>(place, &content);
    }
  }

  template <class Flag>
  bool has(Place place, std::uint32_t descriptor) {
    if (descriptor >= descriptor_count(place.writer)) return false;
    place.descriptor = descriptor;
    return value<Flag>(place) != 0;
  }
  /// The source of the pair has created its endpoint of the topic and knows the destination's.
  void open_side(std::uint32_t pair, Stream own, std::uint32_t topic) {
    const std::uint32_t back = topology_.pair(pair).reverse;
    const bool writes = own == Stream::pub;
    World side = world_at(relation_place(stride() * (writes ? pair : back) + topic));
    if (writes) side.raise(cyclone::WriterOpens{});
    if (!writes) side.raise(comp::ReaderOpens{});
  }

  // The event thread.
  void work(std::uint32_t i) {
    CycloneThread& thread = threads_[i];
    while (!difference()) {
      if (!thread.left.empty()) {
        send_copy(i);
        if (pauses()) return run<comp::Happens<cyclone::ThreadPauses>>({.participant = i});
        continue;
      }
      const std::vector<CycloneMessage> packet = thread.fill(dds().sedp);
      if (packet.empty()) return run<comp::Happens<cyclone::ThreadSleeps>>({.participant = i});
      begin_to_send(i, packet);
    }
  }
  void begin_to_send(std::uint32_t i, const std::vector<CycloneMessage>& packet) {
    CycloneThread& thread = threads_[i];
    thread.sent = {};
    thread.sent.kind = model::PacketKind::rtps_message;
    thread.sent.bytes = static_cast<std::uint32_t>(bytes_of(packet));
    for (const CycloneMessage& message : packet) {
      thread.sent.contents.push_back(message.content);
      if (message.content.kind == model::PacketKind::data) have_sent(i, message.content);
    }
    const std::vector<std::uint32_t>& addresses = packet.front().to.addresses;
    thread.left.assign(addresses.begin(), addresses.end());
  }
  /// It and all samples below it.
  void have_sent(std::uint32_t i, const Message& data) {
    Place place = writer_place(stride() * i + data.writer);
    for (place.descriptor = 0; place.descriptor <= data.descriptors.least(); ++place.descriptor) {
      assign<cyclone::Sent>(place, 1);
    }
  }
  void send_copy(std::uint32_t i) {
    CycloneThread& thread = threads_[i];
    const std::uint32_t to = thread.left.front();
    thread.left.pop_front();
    Message copy = thread.sent;
    copy.to_group = to == CycloneDestination::group;
    copy.pair = copy.to_group ? i : topology_.pair_between(i, to);
    for (std::uint32_t p = topology_.first_pair(i);
         copy.to_group && p < topology_.first_pair(i + 1); ++p) {
      if (topology_.pair(p).cross_host) continue;
      copy.loops_to = topology_.pair(p).destination;
      expect(copy, site_);
    }
    copy.loops_to = UINT32_MAX;
    expect(copy, site_);
  }
  /// After each copy if that takes time; whether it does because the participant stalls shows in
  /// the run.
  [[nodiscard]] bool pauses() const {
    if (knob(cyclone::SendTime{}) > 0) return true;
    if (scenario_.wireless.sender != model::Sender::stalls) return false;
    const Move* next = deeds_.next<Move>();
    return next != nullptr && next->event == fsm::name_of<fsm::event_thread::CopySent>();
  }

  const bool multicast_ = dds().allow_multicast == model::AllowMulticast::always;
  std::vector<CycloneThread> threads_;
  std::map<std::uint32_t, std::uint64_t> versions_;  ///< by writer: how many readers were matched
};

}  // namespace

std::unique_ptr<Follower> follow(model::Of<cyclone::Cyclone>, const model::Scenario& scenario,
                                 const model::Topology& topology) {
  return std::make_unique<CycloneFollower>(scenario, topology);
}

}  // namespace stormproof::props
