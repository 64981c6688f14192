// Holds a capture against a profile: announcements by participant, HEARTBEATs by writer, DATA and
// ACKNACKs by relation.
#include "checker/evidence/conform/conform.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "checker/evidence/conform/acknack_counts.hpp"
#include "checker/evidence/conform/announcements.hpp"
#include "checker/evidence/conform/cyclone.hpp"
#include "checker/evidence/conform/dialogue.hpp"
#include "checker/evidence/conform/heartbeats.hpp"
#include "checker/evidence/conform/ledger.hpp"
#include "checker/evidence/conform/library.hpp"
#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/reader_side.hpp"
#include "checker/evidence/conform/server.hpp"
#include "checker/evidence/conform/to_everybody.hpp"
#include "checker/evidence/conform/type_lookups.hpp"
#include "checker/evidence/conform/words.hpp"
#include "checker/evidence/conform/writer_side.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::conform {

namespace {

using model::config::InputError;

bool is_of_cyclone(const model::DdsProfile& dds) {
  return model::traits_of(dds).writer == model::Writer::of_cyclone;
}

class Check {
 public:
  explicit Check(const Request& request)
      : request_{request},
        is_of_cyclone_{is_of_cyclone(request.dds)},
        has_server_{model::traits_of(request.dds).has_server},
        dialogue_{sort_out(
            request.conversation, request.until_ns,
            {.sedp_multicast =
                 is_of_cyclone_ && request.dds.allow_multicast == model::AllowMulticast::always,
             .has_server = has_server_,
             .lookups = is_of_cyclone_ || model::fastdds::looks_up_types(request.dds),
             .max_data_per_message = request.dds.version.max_data_per_message})} {
    result_.bounds = request.bounds;
    result_.checked = dialogue_.checked;
    result_.not_checked = dialogue_.not_checked;
  }

  Conformance run() {
    for (const std::size_t k : dialogue_.strange) strange(k);
    for (const std::size_t k : dialogue_.crowded) crowded(k);
    for (const Beyond& one : dialogue_.beyond) beyond(one);
    if (looks_up_types()) lookups();
    const std::size_t all = dialogue_.participants() + dialogue_.relations.size();
    std::size_t done = 0;
    bool goes_on = true;
    for (std::size_t i = 0; goes_on && i < dialogue_.participants(); ++i) {
      goes_on = report(done++, all);
      if (goes_on) announcements(i);
    }
    for (std::size_t first = 0; goes_on && first < dialogue_.relations.size();) {
      std::size_t last = first;
      while (last < dialogue_.relations.size() && same_writer(first, last)) ++last;
      writer(first, last);
      for (; goes_on && first < last; ++first) goes_on = report(done++, all);
    }
    conclude(goes_on);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool report(std::size_t done, std::size_t all) const {
    return !request_.progress || request_.progress(done, all);
  }
  [[nodiscard]] bool same_writer(std::size_t a, std::size_t b) const {
    const Place& one = dialogue_.relations[a].place;
    const Place& other = dialogue_.relations[b].place;
    return one.source == other.source && one.writer == other.writer;
  }

  /// Runs `explain` for one place and files what it finds.
  void at(const Place& place, const auto& explain) {
    PlaceResult& one = places_.try_emplace(place, PlaceResult{place}).first->second;
    Ledger ledger{result_, one, machines_};
    if (auto fault = explain(ledger)) {
      ++one.unexplained;
      result_.unexplained.push_back(std::move(*fault));
    }
  }

  void announcements(std::size_t i) {
    at({i, {}, capture::entity::spdp_writer}, [&](Ledger& ledger) {
      if (is_of_cyclone_) return cyclone::explain_announcements(context_, i, ledger);
      auto other = other_version(context_, i);
      if (dialogue_.server == i) return other;  // it answers
      auto fault = has_server_ ? server::explain_registration(context_, i, ledger)
                               : explain_announcements(context_, i, ledger);
      return earlier(std::move(other), std::move(fault));
    });
  }

  void writer(std::size_t first, std::size_t last) {
    WriterRelations writer;
    for (std::size_t r = first; r < last; ++r) writer.relations.push_back(&dialogue_.relations[r]);
    if (is_of_cyclone_) return writer_of_cyclone(writer);
    const Place& place = writer.place();
    const RelationKind kind = kind_of(dialogue_, place);
    const model::DdsProfile& dds =
        place.writer == capture::entity::spdp_writer ? announcing_ : request_.dds;
    const Context its{dialogue_, dds, request_.bounds};
    std::set<std::size_t> to_everybody;
    if (kind == RelationKind::relay) {
      at({place.source, {}, place.writer},
         [&](Ledger& ledger) { return server::explain_relay(its, writer, ledger); });
    } else if (kind == RelationKind::descriptors) {
      at({place.source, {}, place.writer},
         [&](Ledger& ledger) { return explain_heartbeats(its, writer, ledger); });
      to_everybody = sent_to_everybody(
          dialogue_, messages_of(dialogue_, place.source, request_.bounds), request_.bounds);
    }
    const AnnouncedSince announced = announced_since(writer);
    WriterContext context{its, announced,
                          last - first == 1 && !dialogue_.has_neighbour[place.source], to_everybody,
                          request_.interrupted};
    if (kind == RelationKind::relay) {
      context.knows_readers = !dialogue_.has_neighbour[place.source];
      context.others = writer.relations;
    }
    for (std::size_t r = first; r < last; ++r) {
      const Relation& relation = dialogue_.relations[r];
      if (kind != RelationKind::registration) {  // that is explained by participant
        at(relation.place, [&](Ledger& ledger) { return explain_data(context, relation, ledger); });
      }
      at(relation.place, [&](Ledger& ledger) {
        auto fault = explain_reader(its, relation, ledger);
        return earlier(std::move(fault), acknack_counts_.fault_in(relation));
      });
    }
  }

  void writer_of_cyclone(const WriterRelations& writer) {
    const Place place{writer.place().source, {}, writer.place().writer};
    at(place,
       [&](Ledger& ledger) { return cyclone::explain_heartbeats(context_, writer, ledger); });
    at(place, [&](Ledger& ledger) { return cyclone::explain_data(context_, writer, ledger); });
    for (const Relation* relation : writer.relations) {
      at(relation->place, [&](Ledger& ledger) {
        auto fault = cyclone::explain_reader(context_, *relation, ledger);
        return earlier(std::move(fault), acknack_counts_.fault_in(*relation));
      });
    }
  }

  /// Of two faults the one that comes first.
  static std::optional<Unexplained> earlier(std::optional<Unexplained> one,
                                            std::optional<Unexplained> other) {
    if (!one || !other) return one ? std::move(one) : std::move(other);
    return other->event < one->event ? std::move(other) : std::move(one);
  }

  /// An event that nothing in the profile sends.
  void strange(std::size_t k) {
    const capture::Event& event = request_.conversation.events[k];
    const auto& topology = request_.conversation.topology;
    Place place{topology.index_of(*topology.find(event.source)), {}, event.writer};
    const bool is_spdp = event.traffic() == capture::Traffic::spdp;
    const bool is_lookup = event.traffic() == capture::Traffic::type_lookup;
    const char* what = is_lookup                                       ? "a lookup of types"
                       : is_spdp && event.is_multicast                 ? "SPDP by multicast"
                       : has_server_ && !event.is_multicast            ? "a message past the server"
                       : event.is_multicast && event.data() != nullptr ? "SEDP DATA by multicast"
                       : event.is_multicast                            ? "SEDP by multicast"
                       : event.gap() != nullptr                        ? "GAP"
                       : event.data() != nullptr                       ? "DATA_FRAG"
                                                                       : "SPDP that is not DATA";
    const bool known = std::any_of(result_.unexplained.begin(), result_.unexplained.end(),
                                   [&](const Unexplained& one) {
                                     return one.place == place && one.fault == Fault::no_such_rule;
                                   });
    if (known) return;
    at(place, [&](Ledger&) -> std::optional<Unexplained> {
      return Unexplained{
          k, Fault::no_such_rule, place, what, "no rule of the profile sends it", {}, {k}};
    });
  }

  [[nodiscard]] bool looks_up_types() const {
    return !is_of_cyclone_ && model::fastdds::looks_up_types(request_.dds);
  }
  void lookups() {
    for (Unexplained& one : faults_of_lookups(context_)) {
      at(one.place, [&](Ledger&) { return std::optional{std::move(one)}; });
    }
  }

  /// DATA in a message that holds as many as one may; the first of each relation.
  void crowded(std::size_t k) {
    const capture::Event& event = request_.conversation.events[k];
    const auto& topology = request_.conversation.topology;
    const auto number = [&](const capture::GuidPrefix& of) {
      return topology.index_of(*topology.find(of));
    };
    const Place place{number(event.source), number(*event.destination), event.writer};
    const auto is_known = [&](const Unexplained& other) {
      return other.place == place && other.fault == Fault::no_such_rule;
    };
    if (std::ranges::any_of(result_.unexplained, is_known)) return;
    const std::uint32_t most = request_.dds.version.max_data_per_message;
    at(place, [&](Ledger&) -> std::optional<Unexplained> {
      return Unexplained{k,
                         Fault::no_such_rule,
                         place,
                         fmt::format("DATA number {} of a message", most + 1),
                         fmt::format("a message holds no more than {}", most),
                         {{"a larger max_data_per_message", {}, {}}},
                         {k}};
    });
  }

  /// An event with a number that its writer cannot have reached; the first of each relation.
  void beyond(const Beyond& one) {
    const auto is_known = [&](const Unexplained& other) {
      return other.place == one.place && other.fault == Fault::number_beyond;
    };
    if (std::ranges::any_of(result_.unexplained, is_known)) return;
    const capture::Event& event = request_.conversation.events[one.event];
    const char* what = event.data() != nullptr        ? "DATA of sample"
                       : event.heartbeat() != nullptr ? "a HEARTBEAT that announces sample"
                                                      : "an ACKNACK about sample";
    at(one.place, [&](Ledger&) -> std::optional<Unexplained> {
      return Unexplained{
          one.event,
          Fault::number_beyond,
          one.place,
          fmt::format("{} {}", what, one.number),
          fmt::format("by what else the capture shows of this writer, no number beyond {} is "
                      "believed; is the capture damaged?",
                      one.most),
          {{"numbers that the writer can have reached", {}, {}}},
          {one.event}};
    });
  }

  /// Whether a descriptor was sent from host to host: without one nothing was discovered, and any
  /// profile announces itself.
  [[nodiscard]] bool has_descriptor() const {
    return std::ranges::any_of(dialogue_.relations, [](const Relation& relation) {
      return std::ranges::any_of(relation.sent, [](const Submessage& submessage) {
        return submessage.descriptor.has_value();
      });
    });
  }

  void conclude(bool is_complete) {
    std::stable_sort(result_.unexplained.begin(), result_.unexplained.end(),
                     [](const Unexplained& a, const Unexplained& b) { return a.event < b.event; });
    for (const auto& [place, one] : places_) result_.places.push_back(one);
    std::stable_sort(result_.hidden.begin(), result_.hidden.end(),
                     [](const Hidden& a, const Hidden& b) { return a.time_ns < b.time_ns; });
    is_of_cyclone_ ? machines_.cyclone.report(result_.rows)
                   : machines_.fastdds.report(result_.rows);
    result_.verdict = Verdict::conforms;
    if (!has_descriptor()) {
      result_.verdict = Verdict::inconclusive;
      result_.why_inconclusive = fmt::format(
          "next to nothing was checked: no descriptor (SEDP DATA) is among the {} events",
          result_.checked);
    }
    if (result_.not_replayed > 0) {
      result_.verdict = Verdict::inconclusive;
      result_.why_inconclusive = "the machines did not confirm every explanation";
    }
    if (result_.undecided > 0) {
      result_.verdict = Verdict::inconclusive;
      result_.why_inconclusive = "the search for an assignment was given up after its time limit";
    }
    if (!is_complete) {
      result_.verdict = Verdict::inconclusive;
      result_.why_inconclusive = "interrupted";
    }
    if (!result_.unexplained.empty()) result_.verdict = Verdict::does_not_conform;
    assume();
  }

  void assume() {
    auto& all = result_.assumptions;
    if (is_of_cyclone_) all = cyclone::assumptions(request_.bounds);
    if (has_server_) all = server::assumptions(dialogue_);
    all.emplace_back(
        "the capture holds everything that left the hosts since before the first announcement");
    all.emplace_back("between two participants datagrams arrive in order, or are lost");
    if (dialogue_.ends_early != nullptr) all.emplace_back(dialogue_.ends_early);
    if (std::find(dialogue_.has_neighbour.begin(), dialogue_.has_neighbour.end(), true) !=
        dialogue_.has_neighbour.end()) {
      all.emplace_back(
          "participants on one host exchange what no capture between hosts shows: where such "
          "traffic can arm a timer or use up the piggyback budget, it is assumed to; on their own "
          "host nothing is lost");
    }
    if (looks_up_types()) {
      all.emplace_back(
          "of endpoints that look up types (dds.type_lookup) only what they say is looked at: who "
          "asks whom about what, and who answers; not when, nor their HEARTBEATs and ACKNACKs");
    }
    for (const auto& [setting, effect] : request_.dds.unmodelled) {
      all.push_back(fmt::format("{} is not modelled: {}", setting, effect));
    }
  }

  const Request& request_;
  bool is_of_cyclone_;
  bool has_server_;
  Dialogue dialogue_;
  const model::DdsProfile announcing_{server::of_announcements(request_.dds)};
  Conformance result_;
  std::map<Place, PlaceResult> places_;
  Machines machines_;
  const Context context_{dialogue_, request_.dds, request_.bounds};
  const AckNackCounts acknack_counts_{dialogue_, is_of_cyclone_};
};

}  // namespace

std::optional<std::string> refuse_profile(const model::DdsProfile& dds) {
  if (is_of_cyclone(dds)) return std::nullopt;
  const model::ImplementationTraits& traits = model::traits_of(dds);
  if (traits.writer != model::Writer::stateful && !traits.has_server) {
    return "a capture can be held against a profile with `implementation: fastdds` or `cyclone`; "
           "this "
           "one has the writer of the paper's model, which is not message for message that of any "
           "program";
  }
  if (dds.sedp.heartbeat_policy != model::HeartbeatPolicy::periodic) {
    return "a capture can be held against a profile with `heartbeat_policy: periodic`; no program "
           "sends by the adaptive one";
  }
  return std::nullopt;
}

model::config::Result<Conformance> conform(const Request& request) {
  const auto& topology = request.conversation.topology;
  const std::string where = request.conversation.captures.empty()
                                ? "capture"
                                : request.conversation.captures.front().name;
  if (topology.hosts < 2) {
    return InputError{where,
                      "discovery between hosts was expected, but all participants are on "
                      "one host"};
  }
  if (auto why = refuse_profile(request.dds)) return InputError{"--dds", *std::move(why)};
  return Check{request}.run();
}

}  // namespace stormproof::conform
