// Translates what the product's probe and the oracle's log tell into one form, and compares.
#include "tests/oracle/comparison.hpp"

#include <algorithm>

#include "model/probe.hpp"
#include "model/reference.hpp"
#include "model/simulator.hpp"

namespace stormproof::oracle {

namespace {

class EventRecorder final : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    events.push_back({event.time.count(), static_cast<int>(event.event_class()), event.insertion(),
                      model::name_of(event.kind)});
  }
  std::vector<ObservedEvent> events;
};

EventLog log_into(Observed& observed) {
  return [&observed](const LogEntry& entry) {
    observed.events.push_back({entry.time_ns, entry.event_class, entry.insertion, entry.kind});
  };
}

void take_outcome(Observed& observed, const Outcome& o, std::int64_t user_control) {
  observed.outcome = {{"T_disc", o.t_disc_ns},
                      {"initial DATA", o.initial_data},
                      {"repair DATA", o.repair_data},
                      {"HEARTBEAT", o.heartbeat},
                      {"ACKNACK", o.acknack},
                      {"SPDP multicast", o.spdp_multicast},
                      {"SPDP unicast", o.spdp_unicast},
                      {"user control", user_control},
                      {"lookups", 0},
                      {"DATA(p)", 0},
                      {"HEARTBEAT(p)", 0},
                      {"ACKNACK(p)", 0},
                      {"GAP", 0},
                      {"events", static_cast<std::int64_t>(o.events)},
                      {"missing", static_cast<std::int64_t>(o.missing.size())}};
  const std::size_t listed = std::min(o.missing.size(), model::RunResult::missing_listed);
  observed.missing.assign(o.missing.begin(), o.missing.begin() + static_cast<long>(listed));
}

std::string in_words(const ObservedEvent& event) {
  static constexpr const char* classes[] = {"service", "protocol", "dispatch"};
  return std::string{event.kind} + " at " + std::to_string(event.time_ns) + " ns (" +
         classes[event.event_class] + ", insertion " + std::to_string(event.insertion) + ")";
}

std::string in_words(const Missing& m) {
  return std::string{model::name_of(m.stream)} + " descriptor " + std::to_string(m.descriptor) +
         " of participant " + std::to_string(m.source) + " at " + std::to_string(m.destination);
}

bool same(const ObservedEvent& a, const ObservedEvent& b) {
  return a.time_ns == b.time_ns && a.event_class == b.event_class && a.insertion == b.insertion;
}
bool same(const Missing& a, const Missing& b) { return a == b; }

template <class T>
std::optional<std::string> first_difference(const char* what, const std::vector<T>& product,
                                            const std::vector<T>& oracle) {
  const std::size_t most = std::max(product.size(), oracle.size());
  for (std::size_t k = 0; k < most; ++k) {
    if (k < product.size() && k < oracle.size() && same(product[k], oracle[k])) continue;
    const auto side = [k](const std::vector<T>& list) {
      return k < list.size() ? in_words(list[k]) : std::string{"nothing more"};
    };
    return std::string{what} + " " + std::to_string(k) + ": the product has " + side(product) +
           ", the oracle " + side(oracle);
  }
  return {};
}

}  // namespace

Observed observe_product(const model::Scenario& scenario, const model::Mutation* mutation,
                         std::uint64_t max_events) {
  EventRecorder recorder;
  model::RunOptions options;
  options.probe = &recorder;
  options.mutation = mutation;
  options.max_events = max_events;
  const model::RunResult r = model::simulate(scenario, options);
  Observed observed;
  observed.events = std::move(recorder.events);
  const model::Counts& c = r.counts;
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  observed.outcome = {{"T_disc", r.discovery_time ? r.discovery_time->count() : -1},
                      {"initial DATA", number(c.initial_data)},
                      {"repair DATA", number(c.repair_data)},
                      {"HEARTBEAT", number(c.heartbeat)},
                      {"ACKNACK", number(c.acknack)},
                      {"SPDP multicast", number(c.spdp_multicast)},
                      {"SPDP unicast", number(c.spdp_unicast)},
                      {"user control", number(r.user_control)},
                      {"lookups", number(c.lookup)},
                      {"DATA(p)", number(c.pdp_data)},
                      {"HEARTBEAT(p)", number(c.pdp_heartbeat)},
                      {"ACKNACK(p)", number(c.pdp_acknack)},
                      {"GAP", number(c.gap)},
                      {"events", number(r.events)},
                      {"missing", number(r.missing_count)}};
  for (const model::MissingDescriptor& m : r.missing) {
    observed.missing.push_back({m.source.value, m.destination.value, m.stream, m.descriptor.value});
  }
  return observed;
}

Observed observe_oracle(const model::Scenario& scenario, Mistake mistake,
                        std::uint64_t max_events) {
  Observed observed;
  take_outcome(observed, run(scenario, log_into(observed), mistake, max_events), 0);
  return observed;
}

namespace {
/// With what is counted with a Discovery Server or types only.
void take_fastdds_outcome(Observed& observed, const FastddsOutcome& outcome) {
  take_outcome(observed, outcome, outcome.user_control);
  for (auto& [name, value] : observed.outcome) {
    const std::string_view key{name};
    if (key == "lookups") value = outcome.lookup;
    if (key == "DATA(p)") value = outcome.pdp_data;
    if (key == "HEARTBEAT(p)") value = outcome.pdp_heartbeat;
    if (key == "ACKNACK(p)") value = outcome.pdp_acknack;
    if (key == "GAP") value = outcome.gap;
    if (key == "missing") value += outcome.held_in_vain;
  }
}
}  // namespace

Observed observe_oracle(const model::Scenario& scenario, FastddsMistake mistake,
                        std::uint64_t max_events) {
  Observed observed;
  take_fastdds_outcome(observed, run_fastdds(scenario, log_into(observed), mistake, max_events));
  return observed;
}

Observed observe_oracle(const model::Scenario& scenario, ServerMistake mistake,
                        std::uint64_t max_events) {
  Observed observed;
  take_fastdds_outcome(observed, run_fastdds(scenario, log_into(observed), FastddsMistake::none,
                                             max_events, WifiMistake::none, mistake));
  return observed;
}

Observed observe_oracle(const model::Scenario& scenario, WifiMistake mistake,
                        std::uint64_t max_events) {
  Observed observed;
  const FastddsOutcome outcome =
      run_fastdds(scenario, log_into(observed), FastddsMistake::none, max_events, mistake);
  take_outcome(observed, outcome, outcome.user_control);
  return observed;
}

Observed observe_oracle(const model::Scenario& scenario, CycloneMistake mistake,
                        std::uint64_t max_events) {
  Observed observed;
  const CycloneOutcome outcome = run_cyclone(scenario, log_into(observed), mistake, max_events);
  take_outcome(observed, outcome, outcome.user_control);
  return observed;
}

Observed observe_oracle(const model::Scenario& scenario, std::uint64_t max_events) {
  switch (scenario.dds.implementation) {
    case model::ImplementationKind::paper:
    case model::ImplementationKind::paper_amended:
      break;
    case model::ImplementationKind::fastdds:
    case model::ImplementationKind::fastdds_static:
    case model::ImplementationKind::fastdds_server:
      return observe_oracle(scenario, FastddsMistake::none, max_events);
    case model::ImplementationKind::cyclone:
      return observe_oracle(scenario, CycloneMistake::none, max_events);
  }
  return observe_oracle(scenario, Mistake::none, max_events);
}

std::optional<std::string> first_difference(const Observed& product, const Observed& oracle) {
  if (auto found = first_difference("event", product.events, oracle.events)) return found;
  for (std::size_t k = 0; k < product.outcome.size(); ++k) {
    const auto& [name, value] = product.outcome[k];
    const std::int64_t expected = oracle.outcome[k].second;
    if (value == expected) continue;
    return std::string{name} + ": the product has " + std::to_string(value) + ", the oracle " +
           std::to_string(expected);
  }
  return first_difference("missing descriptor", product.missing, oracle.missing);
}

std::optional<std::string> difference(const model::Scenario& scenario) {
  const Observed product_run = observe_product(scenario, nullptr, most_compared_events);
  const Observed oracle_run = observe_oracle(scenario, most_compared_events);
  if (auto found = first_difference(product_run, oracle_run)) return found;
  if (scenario.wireless.kind != model::ServiceKind::shared_channel) return {};
  if (scenario.dds.implementation != model::ImplementationKind::paper) return {};
  const std::int64_t product = model::open_loop_airtime(scenario)->count();
  const std::int64_t expected = open_loop_ns(scenario);
  if (product == expected) return {};
  return "open-loop airtime: the product has " + std::to_string(product) + " ns, the oracle " +
         std::to_string(expected) + " ns";
}

}  // namespace stormproof::oracle
