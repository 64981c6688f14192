// Changes one knob after the other.
#include "checker/evidence/conform/changes.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <utility>

#include <fmt/core.h>

#include "model/config/tree/quantities.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/implementations.hpp"

namespace stormproof::conform {

namespace {

namespace fs = std::filesystem;
using model::config::InputError;
using model::config::Result;

/// Collects the changes of one profile.
class Changes {
 public:
  explicit Changes(const model::DdsProfile& dds) : dds_{dds} {}

  void add(std::string name, std::string set, std::vector<Rule> rules, const auto& apply) {
    Change change{std::move(name), std::move(set), dds_, std::move(rules)};
    apply(change.dds);
    if (change.dds != dds_) all_.push_back(std::move(change));
  }

  /// A timer of SEDP, `numerator`/`denominator` times as long.
  void timer(const char* symbol, const char* key, model::Nanoseconds model::SedpProfile::*member,
             std::int64_t numerator, std::int64_t denominator, const std::vector<Rule>& rules) {
    const model::Nanoseconds changed{(dds_.sedp.*member).count() * numerator / denominator};
    add(denominator == 1 ? fmt::format("{} × {}", symbol, numerator)
                         : fmt::format("{} / {}", symbol, denominator),
        fmt::format("sedp.{}={}", key, model::config::print_duration(changed)), rules,
        [&](model::DdsProfile& dds) { dds.sedp.*member = changed; });
  }

  /// A delay of a Discovery Server or of its clients.
  void timer(const char* symbol, const char* key, model::Nanoseconds model::ServerProfile::*member,
             std::int64_t numerator, std::int64_t denominator, const std::vector<Rule>& rules) {
    const model::Nanoseconds changed{(dds_.server.*member).count() * numerator / denominator};
    add(denominator == 1 ? fmt::format("{} × {}", symbol, numerator)
                         : fmt::format("{} / {}", symbol, denominator),
        fmt::format("{}={}", key, model::config::print_duration(changed)), rules,
        [&](model::DdsProfile& dds) { dds.server.*member = changed; });
  }

  std::vector<Change> take() && { return std::move(all_); }

 private:
  const model::DdsProfile& dds_;
  std::vector<Change> all_;
};

void add_timers(Changes& changes) {
  using Sedp = model::SedpProfile;
  const std::vector<Rule> periodic{Rule::heartbeat_periodic, Rule::relay_periodic};
  const std::vector<Rule> initial{Rule::acknack_initial, Rule::relay_initial,
                                  Rule::registration_initial};
  changes.timer("τ_N", "nack_response_delay", &Sedp::nack_response_delay, 10, 1,
                {Rule::data_pull, Rule::data_repair, Rule::relay_repair});
  changes.timer("τ_A", "heartbeat_response_delay", &Sedp::heartbeat_response_delay, 1'000, 1,
                {Rule::acknack_reply, Rule::relay_acknack});
  changes.timer("τ_S", "nack_suppression_duration", &Sedp::nack_suppression_duration, 10'000, 1,
                {Rule::data_repair, Rule::relay_repair});
  changes.timer("τ_H", "heartbeat_period", &Sedp::heartbeat_period, 3, 1, periodic);
  changes.timer("τ_H", "heartbeat_period", &Sedp::heartbeat_period, 1, 2, periodic);
  changes.timer("τ_I", "initial_acknack_delay", &Sedp::initial_acknack_delay, 2, 1, initial);
  changes.timer("τ_I", "initial_acknack_delay", &Sedp::initial_acknack_delay, 1, 2, initial);
}

/// One change for each value of a knob that is a word.
template <class Value>
void add_words(Changes& changes, const char* name, const char* key, const std::vector<Rule>& rules,
               const std::vector<std::pair<const char*, Value>>& words,
               const std::function<void(model::DdsProfile&, Value)>& set) {
  for (const auto& choice : words) {
    changes.add(fmt::format("{} {}", name, choice.first), fmt::format("{}={}", key, choice.first),
                rules, [&](model::DdsProfile& dds) { set(dds, choice.second); });
  }
}

void add_choices(Changes& changes) {
  using Interval = model::InitialAckNackInterval;
  using Resend = model::SpdpResend;
  using Piggyback = model::Piggyback;
  const std::vector<std::pair<const char*, Interval>> intervals{{"constant", Interval::constant},
                                                                {"doubling", Interval::doubling}};
  for (const auto& choice : intervals) {
    changes.add("initial ACKNACKs: the other interval",
                fmt::format("sedp.initial_acknack_interval={}", choice.first),
                {Rule::acknack_initial},
                [&](model::DdsProfile& dds) { dds.sedp.initial_acknack_interval = choice.second; });
  }
  add_words<Resend>(changes, "resend", "spdp.resend",
                    {Rule::announcement_resent, Rule::announcement_copy},
                    {{"all_known", Resend::all_known},
                     {"new_only", Resend::new_only},
                     {"new_and_multicast", Resend::new_and_multicast},
                     {"none", Resend::none}},
                    [](model::DdsProfile& dds, Resend value) { dds.spdp.resend = value; });
  const std::vector<Rule> budget{Rule::heartbeat_piggyback, Rule::heartbeat_same_host};
  add_words<Piggyback>(changes, "piggyback", "sedp.piggyback", budget,
                       {{"linear", Piggyback::linear},
                        {"cumulative", Piggyback::cumulative},
                        {"off", Piggyback::off}},
                       [](model::DdsProfile& dds, Piggyback value) { dds.sedp.piggyback = value; });
  changes.add(
      "threshold 4 MB", "sedp.piggyback_threshold_bytes=4000000", budget,
      [](model::DdsProfile& dds) { dds.sedp.piggyback_threshold_bytes = model::Bytes{4'000'000}; });
}

void add_server(Changes& changes) {
  using Server = model::ServerProfile;
  const std::vector<Rule> ticks{Rule::registration_tick, Rule::heartbeat_open};
  changes.timer("τ_T", "client_sync_period", &Server::client_sync_period, 3, 1, ticks);
  changes.timer("τ_T", "client_sync_period", &Server::client_sync_period, 1, 2, ticks);
  changes.timer("τ_R", "server_routine_period", &Server::server_routine_period, 3, 1,
                {Rule::relay_data});
  const std::vector<Rule> periodic{Rule::registration_open, Rule::relay_open};
  changes.timer("τ_PH", "pdp_heartbeat_period", &Server::pdp_heartbeat_period, 3, 1, periodic);
  changes.timer("τ_PH", "pdp_heartbeat_period", &Server::pdp_heartbeat_period, 1, 2, periodic);
  changes.timer("τ_PN", "pdp_nack_response_delay", &Server::pdp_nack_response_delay, 10, 1,
                {Rule::relay_repair});
  changes.timer("τ_PS", "pdp_nack_suppression_duration", &Server::pdp_nack_suppression_duration,
                100, 1, {Rule::relay_repair});
  changes.timer("τ_PA", "pdp_heartbeat_response_delay", &Server::pdp_heartbeat_response_delay, 3, 1,
                {Rule::registration_acknack, Rule::relay_acknack});
  add_words<model::Relay>(
      changes, "relay", "relay", {Rule::relay_data},
      {{"repeat", model::Relay::repeat}, {"once", model::Relay::once}},
      [](model::DdsProfile& dds, model::Relay value) { dds.server.relay = value; });
  add_words<model::Discovery>(
      changes, "discovery", "discovery", {Rule::relay_data},
      {{"server", model::Discovery::server}, {"super_client", model::Discovery::super_client}},
      [](model::DdsProfile& dds, model::Discovery value) { dds.discovery = value; });
}

bool acts(const Change& change, const Conformance& truth) {
  return std::ranges::any_of(
      change.rules, [&](Rule rule) { return truth.by_rule[static_cast<std::size_t>(rule)] > 0; });
}

Tried judged(const Change& change, const Conformance& result) {
  Tried tried{change.name, change.set, Notice::explained, {}, result.unexplained.size()};
  if (result.verdict == Verdict::does_not_conform) {
    tried.notice = Notice::rejected;
    tried.fault = result.unexplained.front().fault;
  } else if (result.verdict == Verdict::inconclusive) {
    tried.notice = Notice::inconclusive;
  }
  return tried;
}

}  // namespace

std::vector<Change> changes_of(const model::DdsProfile& dds) {
  Changes changes{dds};
  add_timers(changes);
  add_choices(changes);
  if (model::traits_of(dds).has_server) add_server(changes);
  return std::move(changes).take();
}

const std::vector<NoKnob>& changes_without_knob() {
  static const std::vector<NoKnob> list{
      {"push instead of pull",
       "no knob of an implementation that a capture can be held against: that existing descriptors "
       "wait for a request is a rule of it, and DATA before its request is data_cause"}};
  return list;
}

std::string_view name_of(Notice notice) {
  constexpr std::array<std::string_view, 4> names{"rejected", "explained", "inconclusive",
                                                  "does not act"};
  return names[static_cast<std::size_t>(notice)];
}

Result<Sensitivity> try_changes(const ChangesRequest& request) {
  const auto held = [&](const model::DdsProfile& dds) {
    return conform({request.conversation, INT64_MAX, dds, request.bounds, {}, request.interrupted});
  };
  const auto truth = held(request.dds);
  if (!truth) return truth.error();
  Sensitivity all{request.capture, request.profile, truth->verdict, {}};
  for (const Change& change : changes_of(request.dds)) {
    if (!acts(change, *truth)) {
      all.tried.push_back({change.name, change.set, Notice::does_not_act, {}, 0});
      continue;
    }
    if (request.progress && !request.progress(change.name)) break;
    const auto result = held(change.dds);
    if (!result) return result.error();
    all.tried.push_back(judged(change, *result));
  }
  return all;
}

Result<std::string> profile_of_capture(const std::string& file) {
  const fs::path path{file};
  const std::string list = (path.parent_path() / "profiles.yaml").string();
  const auto root = model::config::load_yaml(list);
  if (!root) return root.error();
  std::string name = path.filename().string();
  name.resize(std::min(name.find(".pcap"), name.size()));
  const model::config::Node* profile = root->find(name);
  if (profile == nullptr || !profile->is_scalar()) {
    return InputError{file, fmt::format("{} does not say which profile it shows; expected `{}: "
                                        "PROFILE` there, or --dds PROFILE",
                                        list, name)};
  }
  return profile->text;
}

}  // namespace stormproof::conform
