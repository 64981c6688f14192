// What the script of the page calls: one scenario at a time, text in, JSON out. Times are in
// nanoseconds and exact: a double of JavaScript holds 104 days of them.
#include <algorithm>
#include <string>

#include <emscripten/emscripten.h>
#include <nlohmann/json.hpp>

#include "checker/engines/exact/health.hpp"
#include "checker/page/knowledge.hpp"
#include "checker/page/moment.hpp"
#include "checker/page/recording.hpp"
#include "checker/presentation/diagrams/machine_svg.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "fsm/machines.hpp"
#include "fsm/state_words.hpp"
#include "model/config/scenario_file.hpp"
#include "model/implementations.hpp"
#include "model/simulator.hpp"

namespace stormproof::page {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_known_bytes = 64 * 1024 * 1024;

struct Engine {
  std::optional<model::Scenario> scenario;
  Recording recording;
  std::string answer;
};

Engine& engine() {
  static Engine one;
  return one;
}

const char* answered(const Json& json) {
  engine().answer = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return engine().answer.c_str();
}

Json or_null(const std::optional<model::Nanoseconds>& time) {
  return time ? Json(time->count()) : Json();
}

/// The keys are those of `stormproof simulate --format json`.
Json described(const model::RunResult& result) {
  Json counts;
  for (const model::Counts::Entry& count : result.counts.entries()) {
    counts[std::string{count.name}] = count.value;
  }
  if (result.counts.lookup > 0) counts["lookup"] = result.counts.lookup;
  counts["total"] = result.counts.total();
  Json channels = Json::array();
  for (const model::ChannelUse& channel : result.channels) {
    Json busy = Json::array();
    for (const model::Nanoseconds time : channel.busy) busy.push_back(time.count());
    channels.push_back({{"name", channel.name}, {"busy_ns", busy}});
  }
  return {{"end", model::name_of(result.end)},
          {"end_ns", result.end_time.count()},
          {"t_disc_ns", or_null(result.discovery_time)},
          {"counts", counts},
          {"user_control", result.user_control},
          {"events", result.events},
          {"missing", result.missing_count},
          {"channels", channels}};
}

Json described(const exact::RunHealth& health) {
  const exact::Outlook outlook{{health}};
  return {{"name", exact::name_of(health.health)},
          {"headline", outlook.headline()},
          {"sentence", outlook.sentence()}};
}

Json described(const Moment& moment) {
  Json steps = Json::array();
  for (const Step& step : moment.steps) {
    steps.push_back({{"machine", step.machine},
                     {"of", step.of},
                     {"event", step.event},
                     {"before", step.before},
                     {"after", step.after},
                     {"descriptors", step.descriptors},
                     {"mine", step.mine}});
  }
  Json readers = Json::array();
  for (const ReaderStates& states : moment.readers) {
    readers.push_back({{"reader", states.reader},
                       {"stream", model::index_of(states.stream)},
                       {"counts", states.counts}});
  }
  Json machines = Json::array();
  for (const MachineState& one : moment.machines) {
    machines.push_back({{"machine", one.machine}, {"of", one.of}, {"state", one.state}});
  }
  return {{"event", moment.event},
          {"time_ns", moment.time.count()},
          {"what", moment.what},
          {"effects", moment.effects},
          {"steps", steps},
          {"packets", moment.packets},
          {"descriptor_machine", moment.descriptor_machine},
          {"readers", readers},
          {"machines", machines},
          {"missing", moment.missing}};
}

}  // namespace

extern "C" {

/// Style sheet, machines and their drawings: what does not depend on a scenario.
EMSCRIPTEN_KEEPALIVE const char* page_constants() {
  Json machines = Json::object();
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    machines[std::string{machine.name}] = {{"states", machine.states},
                                           {"svg", draw::machine_svg(machine)}};
  }
  Json classes = Json::array();
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    classes.push_back(model::words_of(static_cast<model::TrafficClass>(k)));
  }
  Json words = Json::object();
  for (const fsm::StateWords& state : fsm::state_words()) {
    words[std::string{state.state}] = state.words;
  }
  return answered({{"style", report::page_style()},
                   {"machines", machines},
                   {"classes", classes},
                   {"state_words", words}});
}

/// Reads a scenario, which is that of all calls below from now on if it can be read. Keys: error
/// (where, what), or participants (their hosts) and what there is to know.
EMSCRIPTEN_KEEPALIVE const char* page_open(const char* yaml) {
  const auto specs = model::config::SpecPath::standard();
  auto scenario = model::config::parse_scenario(yaml, "scenario", {}, specs);
  if (!scenario) {
    return answered(
        {{"error", {{"where", scenario.error().where}, {"what", scenario.error().message}}}});
  }
  engine().scenario = *std::move(scenario);
  const model::Scenario& read = *engine().scenario;
  Json hosts = Json::array();
  Json starts = Json::array();
  for (const model::Participant& one : read.deployment.participants) {
    hosts.push_back(one.host.value);
    starts.push_back(one.start.count());
  }
  return answered({{"hosts", hosts},
                   {"starts_ns", starts},
                   {"is_drawn", model::is_drawn(read)},
                   {"seed", model::own_seed(read)},
                   {"time_limit_ns", read.time_limit.count()},
                   {"implementation", model::traits_of(read.dds).name},
                   {"has_server", model::traits_of(read.dds).has_server},
                   {"knows_pairs", Knowledge::is_known(read)}});
}

/// One run of the schedule that the seed draws: result and health.
EMSCRIPTEN_KEEPALIVE const char* page_sample(double seed) {
  model::Scenario drawn = *engine().scenario;
  model::draw(drawn, static_cast<std::uint64_t>(seed));
  const model::RunResult result = model::simulate(drawn);
  Json json = described(result);
  json["seed"] = seed;
  json["health"] = described(exact::health_of(drawn, result));
  return answered(json);
}

/// The run of the scenario as it is, and pictures of it; `page_known` holds who knows whom.
EMSCRIPTEN_KEEPALIVE const char* page_record(int pictures) {
  const model::Scenario& scenario = *engine().scenario;
  Recording& recording = engine().recording;
  // Who knows whom takes memory in the square of the participants: fewer pictures of many.
  const std::size_t pairs =
      scenario.deployment.participants.size() * scenario.deployment.participants.size();
  const std::size_t most =
      std::max<std::size_t>(most_known_bytes / std::max<std::size_t>(pairs, 1), 1);
  recording = record(scenario, std::min(most, static_cast<std::size_t>(std::max(pictures, 1))));
  Json json = described(recording.result);
  json["health"] = described(exact::health_of(scenario, recording.result));
  Json list = Json::array();
  for (const Picture& picture : recording.pictures) {
    list.push_back({picture.time.count(), picture.events, picture.missing, picture.waiting,
                    picture.backlog, picture.sent});
  }
  json["pictures"] = list;
  return answered(json);
}
EMSCRIPTEN_KEEPALIVE const std::uint8_t* page_known() { return engine().recording.known.data(); }
EMSCRIPTEN_KEEPALIVE int page_known_bytes() {
  return static_cast<int>(engine().recording.known.size());
}

/// The moment after an event.
EMSCRIPTEN_KEEPALIVE const char* page_moment(double event, int participant) {
  return answered(described(moment_of(*engine().scenario, static_cast<std::uint64_t>(event),
                                      static_cast<std::uint32_t>(participant))));
}
/// The participant's next step after an event, or the one before it; 0 if there is none.
EMSCRIPTEN_KEEPALIVE double page_step(double event, int participant, int forward) {
  const auto from = static_cast<std::uint64_t>(event);
  const auto who = static_cast<std::uint32_t>(participant);
  const auto found = forward != 0 ? next_step_of(*engine().scenario, from, who)
                                  : step_before_of(*engine().scenario, from, who);
  return static_cast<double>(found.value_or(0));
}

}  // extern "C"

}  // namespace stormproof::page
