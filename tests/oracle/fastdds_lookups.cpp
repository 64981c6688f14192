// Types that participants do not know: who knows which, whom they ask, and what happens to the
// descriptors that wait meanwhile. A chain is four samples: a question about dependencies, its
// answer, a question about the type, its answer. It is about a type of one stream, or of both, or
// about all types of a participant that wait.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

/// Those whose types may be unknown, in their order.
std::vector<std::pair<int, Id>> listed(const World& w, Id i) {
  std::vector<std::pair<int, Id>> list;
  for (Id k = 0; k < 6; ++k) {
    list.emplace_back(sub, 1 + k);
    list.emplace_back(pub, 2 + k);
  }
  for (Id d = 9; d < descriptor_count(w.scenario, i, pub); ++d) list.emplace_back(pub, d);
  for (Id d = 8; d < descriptor_count(w.scenario, i, sub); ++d) list.emplace_back(sub, d);
  return list;
}

std::string type_of(const World& w, Id i, int s, Id d) {
  const std::vector<std::pair<int, Id>> list = listed(w, i);
  const auto place = std::find(list.begin(), list.end(), std::pair{s, d});
  if (place == list.end()) {
    if (d == 0) return "ros_discovery_info";
    return s == pub && d == 1 ? "rosout" : "parameter_events";
  }
  const auto number = static_cast<std::uint32_t>(place - list.begin());
  if (number < w.scenario.deployment.types->unknown_per_participant) {
    return std::to_string(number) + " of participant " + std::to_string(i);
  }
  return number < 12 ? "service " + std::to_string(number) : "user";
}

bool knows(World& w, Id j, const std::string& type) {
  if (w.participants.at(j).looked_up.contains(type)) return true;
  for (const int s : {pub, sub}) {
    const Id there = w.makes(Mistake::all_own_types_known) ? descriptor_count(w.scenario, j, s)
                                                           : writer(w, j, s).existing;
    for (Id d = 0; d < there; ++d) {
      if (type_of(w, j, s, d) == type) return true;
    }
  }
  return false;
}

void queue_sample(World& w, const Sample& sample) {
  Participant& p = w.participants.at(sample.from);
  p.samples.push_back(sample);
  if (p.run_pending) return;
  p.run_pending = true;
  schedule(w, w.now, EventClass::protocol,
           make_event(EventKind::async_run, sample.from, sample.from, 0));
}

void note_notified(World& w, Id i, Id j, int s, Id d) {
  const bool counts = with_types(w) && !w.makes(Mistake::complete_when_received);
  if (counts && is_needed(w, i, j, s, d)) {
    --w.missing;
    note_completion(w);
    if (w.ended) return;
  }
  notified(w, i, j, s, d);
}

void answer(World& w, const Sample& question) {
  Sample sample = question;
  sample.from = question.to;
  sample.to = question.from;
  sample.is_question = false;
  queue_sample(w, sample);
}

void ask_for_type(World& w, const Sample& dependencies) {
  Sample sample = dependencies;
  sample.from = dependencies.to;
  sample.to = dependencies.from;
  sample.is_question = true;
  sample.is_about_dependencies = false;
  queue_sample(w, sample);
}

void learn(World& w, Id j, const Sample& last, const std::string& type) {
  w.participants.at(j).looked_up.insert(type);
  std::vector<int> order{pub, sub};
  if (w.makes(Mistake::subscriptions_first)) order = {sub, pub};
  if (w.makes(Mistake::one_list_only)) order = {last.stream};
  for (const int s : order) {
    const std::vector<std::pair<Id, Id>> list = w.waiting[{j, s, type}];
    w.waiting.erase({j, s, type});
    for (const auto& [i, d] : list) {
      relation(w, i, j, s).waiting.erase(d);
      note_notified(w, i, j, s, d);
    }
  }
}

void take(World& w, Id j, const Sample& sample) {
  if (sample.is_question) return answer(w, sample);
  if (sample.is_about_dependencies && !w.makes(Mistake::one_question)) {
    return ask_for_type(w, sample);
  }
  for (const std::string& type : sample.types) learn(w, j, sample, type);
  w.participants.at(j).asked.erase(sample.from);
  ask_for_all(w, j, sample.from);
}

void ask(World& w, Id j, Id i, int s, const std::vector<std::string>& types) {
  Sample question;
  question.from = j;
  question.to = i;
  question.stream = s;
  question.types = types;
  queue_sample(w, question);
}

}  // namespace

bool with_types(const World& w) { return w.scenario.deployment.types.has_value(); }

bool asks_for_types_of(const World& w, Id i, Id j) {
  return profile(w, i).version.type_lookup == model::Whether::yes &&
         profile(w, j).version.type_lookup == model::Whether::yes;
}

bool asks_for_types(const World& w, Id i, Id j) {
  return with_types(w) && asks_for_types_of(w, i, j);
}

std::int64_t sample_bytes(const World& w, const Sample& sample) {
  const auto others = static_cast<std::int64_t>(sample.types.size()) - 1;
  if (sample.is_question) return (sample.is_about_dependencies ? 156 : 148) + 16 * others;
  if (sample.is_about_dependencies) return 96;
  const std::int64_t object = profile(w, sample.from).version.type_object_bytes.count();
  return object > 96 ? object + others * (object - 96) : object;
}

void hand_over(World& w, Id i, Id j, int s, Id d) {
  if (!asks_for_types(w, i, j) || w.makes(Mistake::nobody_waits))
    return note_notified(w, i, j, s, d);
  if (!cross_host(w, i, j) && w.makes(Mistake::no_questions_on_host)) return;
  const std::string type = type_of(w, i, s, d);
  if (knows(w, j, type)) return note_notified(w, i, j, s, d);
  std::vector<std::pair<Id, Id>>& list = w.waiting[{j, s, type}];
  list.emplace_back(i, d);
  relation(w, i, j, s).waiting.insert(d);
  const model::LookupUnit unit = w.scenario.dds.version.typelookup_unit;
  if (unit == model::LookupUnit::participant) return;
  const bool together = unit == model::LookupUnit::type && !w.makes(Mistake::streams_ask_apart);
  const bool is_asked =
      list.size() > 1 || (together && !w.waiting[{j, pub + sub - s, type}].empty());
  if (!is_asked || w.makes(Mistake::everybody_is_asked)) ask(w, j, i, s, {type});
}

void ask_for_all(World& w, Id j, Id i) {
  if (!asks_for_types(w, i, j)) return;
  if (w.scenario.dds.version.typelookup_unit != model::LookupUnit::participant) return;
  std::set<Id>& asked = w.participants.at(j).asked;
  if (asked.contains(i) && !w.makes(Mistake::asks_without_answer)) return;
  std::vector<std::string> types;
  for (const int s : {pub, sub}) {
    for (const Id d : relation(w, i, j, s).waiting) {
      const std::string type = type_of(w, i, s, d);
      const bool is_first = w.waiting[{j, s, type}].front() == std::pair{i, d};
      const bool is_new = std::find(types.begin(), types.end(), type) == types.end();
      if ((is_first || w.makes(Mistake::everybody_is_asked)) && is_new) types.push_back(type);
    }
  }
  if (types.empty()) return;
  asked.insert(i);
  ask(w, j, i, pub, types);
}

void receive_samples(World& w, const Packet& packet) {
  const Id j = *packet.destination;
  Control& c = control(w, packet.source, j, packet.topic);
  if (!c.reader_open) return;
  if (!w.makes(Mistake::samples_not_got)) c.got = std::max(c.got, packet.samples.back().number);
  for (const Sample& sample : packet.samples) {
    if (sample.to == j) take(w, j, sample);
  }
  if (packet.heartbeats > 0) receive_control_heartbeat(w, packet);
}

void arm_lookups(World& w, Id i, int topic) {
  Writer& wr = writer(w, i, topic);
  if (!asks_for_types(w, i, i) || wr.expiry_pending) return;
  wr.expiry_pending = true;
  Event event = make_event(EventKind::lookup_expiry, i, i, 0);
  event.topic = topic;
  schedule_after(w, profile(w, i).version.typelookup_heartbeat_period, event);
}

void lookup_expiry(World& w, Id i, int topic) {
  Writer& wr = writer(w, i, topic);
  wr.expiry_pending = false;
  const auto lacks = [&](Id j) {
    const Control& c = control(w, i, j, topic);
    return c.low < (w.makes(Mistake::filtered_samples_lack) ? wr.existing : c.told);
  };
  if (!std::any_of(wr.readers.begin(), wr.readers.end(), lacks)) return;
  const std::int64_t payload = wr.readers.size() == 1 ? heartbeat_payload : heartbeat_to_several;
  for (const Id j : wr.readers) {
    if (w.makes(Mistake::expiry_of_lookups_to_lacking) && !lacks(j)) continue;
    send_control(w, PacketKind::control_heartbeat, i, j, topic, false, payload);
  }
  wr.budget = sedp(w, i).piggyback_threshold_bytes.count();
  arm_lookups(w, i, topic);
}

}  // namespace stormproof::oracle::fastdds
