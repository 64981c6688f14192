// The list, read off the rules of all implementations, and the normal form that follows from it.
// Normal forms exist to be compared; with sizes that nobody reads set to their defaults, one need
// not be a profile that a file could hold.
#include "checker/experiments/diff/normal_form.hpp"

#include <numeric>

#include <fmt/core.h>

#include "checker/experiments/diff/diff.hpp"
#include "model/implementations.hpp"

namespace stormproof::diff {

namespace {

using Dds = model::DdsProfile;

constexpr model::Bytes mtu_limit{1'472};  // what `grouping: mtu` fills a packet up to

// The choices that leave something unread.
bool is_periodic(const Dds& dds) {
  return dds.sedp.heartbeat_policy == model::HeartbeatPolicy::periodic;
}
bool is_adaptive(const Dds& dds) { return !is_periodic(dds); }
bool opens_by_receiver(const Dds& dds) {
  return dds.sedp.relation_opening == model::RelationOpening::receiver;
}
bool asks_never_first(const Dds& dds) {
  return dds.sedp.initial_acknack_delay == model::Nanoseconds{0};
}
bool has_no_piggyback(const Dds& dds) { return dds.sedp.piggyback == model::Piggyback::off; }
bool has_no_startup(const Dds& dds) { return dds.spdp.startup_announcements == 0; }
bool has_fixed_rules(const Dds& dds) { return model::traits_of(dds).fixed_rules.has_value(); }
bool has_fixed_sizes(const Dds& dds) { return !model::traits_of(dds).has_size_knobs; }
bool sends_singly(const Dds& dds) {
  return !has_fixed_sizes(dds) && dds.sedp.grouping == model::Grouping::single;
}
bool has_fixed_limit(const Dds& dds) {
  return !has_fixed_sizes(dds) && dds.sedp.grouping != model::Grouping::message;
}
bool fills_messages_of_one_mtu(const Dds& dds) {
  return !has_fixed_sizes(dds) && dds.sedp.grouping == model::Grouping::message &&
         dds.sedp.grouping_limit_bytes == mtu_limit;
}
/// Those of a group follow what has been sent before.
bool piggybacks_on_everything(const Dds& dds) {
  return !has_no_piggyback(dds) && dds.sedp.piggyback != model::Piggyback::group &&
         dds.sedp.piggyback_threshold_bytes == model::Bytes{0};
}
bool asks_for_no_types(const Dds& dds) { return dds.version.type_lookup == model::Whether::no; }
bool has_no_default_descriptors(const Dds& dds) {
  const auto& [publications, subscriptions, bytes, user_bytes] = dds.descriptors;
  return publications == 0 && subscriptions == 0;
}

// One knob of a section from one profile to another.
template <auto Member>
void set_version(Dds& to, const Dds& from) {
  to.version.*Member = from.version.*Member;
}
template <auto Member>
void set_spdp(Dds& to, const Dds& from) {
  to.spdp.*Member = from.spdp.*Member;
}
template <auto Member>
void set_sedp(Dds& to, const Dds& from) {
  to.sedp.*Member = from.sedp.*Member;
}
template <auto Member>
void set_adaptive(Dds& to, const Dds& from) {
  to.sedp.adaptive.*Member = from.sedp.adaptive.*Member;
}
template <auto Member>
void set_descriptors(Dds& to, const Dds& from) {
  to.descriptors.*Member = from.descriptors.*Member;
}
void set_epsilon(Dds& to, const Dds& from) {
  to.sedp.adaptive.epsilon_numerator = from.sedp.adaptive.epsilon_numerator;
  to.sedp.adaptive.epsilon_denominator = from.sedp.adaptive.epsilon_denominator;
}
void set_mtu(Dds& to, const Dds&) { to.sedp.grouping = model::Grouping::mtu; }
void set_cumulative(Dds& to, const Dds&) { to.sedp.piggyback = model::Piggyback::cumulative; }

constexpr std::string_view built_in{};
constexpr std::string_view with_periodic = "with heartbeat_policy: periodic there are no cycles";
constexpr std::string_view without_questions = "with type_lookup: false nobody asks for types";
constexpr std::string_view without_piggyback = "with piggyback: off no DATA carries a HEARTBEAT";

using Version = model::VersionProfile;
using Spdp = model::SpdpProfile;
using Sedp = model::SedpProfile;
using Adaptive = model::AdaptiveProfile;
using Descriptors = model::DescriptorProfile;

constexpr UnreadRule rules[] = {
    {"typelookup_filter", asks_for_no_types, set_version<&Version::typelookup_filter>,
     without_questions},
    {"typelookup_unit", asks_for_no_types, set_version<&Version::typelookup_unit>,
     without_questions},
    {"spdp.startup_period", has_no_startup, set_spdp<&Spdp::startup_period>,
     "with startup_announcements: 0 the period after the first announcement is spdp.period"},
    {"spdp.payload_bytes", has_fixed_sizes, set_spdp<&Spdp::payload_bytes>, built_in},
    {"sedp.relation_opening", has_fixed_rules, set_sedp<&Sedp::relation_opening>, built_in},
    {"sedp.initial_data", has_fixed_rules, set_sedp<&Sedp::initial_data>, built_in},
    {"sedp.unmatched", has_fixed_rules, set_sedp<&Sedp::unmatched>, built_in},
    {"sedp.unmatched", opens_by_receiver, set_sedp<&Sedp::unmatched>,
     "with relation_opening: receiver the reader side never opens after the writer side"},
    {"sedp.initial_acknack", has_fixed_rules, set_sedp<&Sedp::initial_acknack>, built_in},
    {"sedp.initial_acknack", asks_never_first, set_sedp<&Sedp::initial_acknack>,
     "with initial_acknack_delay: 0 there are no initial ACKNACKs"},
    {"sedp.initial_acknack_interval", asks_never_first, set_sedp<&Sedp::initial_acknack_interval>,
     "with initial_acknack_delay: 0 there are no initial ACKNACKs"},
    {"sedp.acknowledge", has_fixed_rules, set_sedp<&Sedp::acknowledge>, built_in},
    {"sedp.heartbeat_timer", has_fixed_rules, set_sedp<&Sedp::heartbeat_timer>, built_in},
    {"sedp.heartbeat_timer", is_adaptive, set_sedp<&Sedp::heartbeat_timer>,
     "with heartbeat_policy: adaptive cycles replace the periodic HEARTBEAT timer"},
    {"sedp.heartbeat_recipients", has_fixed_rules, set_sedp<&Sedp::heartbeat_recipients>, built_in},
    {"sedp.heartbeat_recipients", is_adaptive, set_sedp<&Sedp::heartbeat_recipients>,
     "with heartbeat_policy: adaptive each cycle chooses its recipients"},
    {"sedp.adaptive.min_period", is_periodic, set_adaptive<&Adaptive::min_period>, with_periodic},
    {"sedp.adaptive.max_period", is_periodic, set_adaptive<&Adaptive::max_period>, with_periodic},
    {"sedp.adaptive.epsilon", is_periodic, set_epsilon, with_periodic},
    {"sedp.grouping", has_fixed_sizes, set_sedp<&Sedp::grouping>, built_in},
    {"sedp.grouping", fills_messages_of_one_mtu, set_mtu,
     "grouping: mtu and grouping: message with a limit of 1472 bytes are the same"},
    {"sedp.grouping_limit_bytes", has_fixed_limit, set_sedp<&Sedp::grouping_limit_bytes>,
     "only grouping: message fills packets up to this limit"},
    {"sedp.piggyback", piggybacks_on_everything, set_cumulative,
     "with piggyback_threshold_bytes: 0 any charge uses up the budget"},
    {"sedp.piggyback_threshold_bytes", has_no_piggyback, set_sedp<&Sedp::piggyback_threshold_bytes>,
     without_piggyback},
    {"sedp.heartbeat_bytes", has_fixed_sizes, set_sedp<&Sedp::heartbeat_bytes>, built_in},
    {"sedp.acknack_bytes", has_fixed_sizes, set_sedp<&Sedp::acknack_bytes>, built_in},
    {"sedp.piggyback_heartbeat_bytes", has_fixed_sizes, set_sedp<&Sedp::piggyback_heartbeat_bytes>,
     built_in},
    {"sedp.piggyback_heartbeat_bytes", has_no_piggyback, set_sedp<&Sedp::piggyback_heartbeat_bytes>,
     without_piggyback},
    {"sedp.shared_header_bytes", has_fixed_sizes, set_sedp<&Sedp::shared_header_bytes>, built_in},
    {"sedp.shared_header_bytes", sends_singly, set_sedp<&Sedp::shared_header_bytes>,
     "with grouping: single no two descriptors share a header"},
    // The numbers of default descriptors are constants there as well, but the deployment is laid
    // out with them.
    {"descriptors.default_bytes", has_fixed_sizes, set_descriptors<&Descriptors::default_bytes>,
     built_in},
    {"descriptors.default_bytes", has_no_default_descriptors,
     set_descriptors<&Descriptors::default_bytes>,
     "with default_publications: 0 and default_subscriptions: 0 no descriptor has this size"},
    {"descriptors.user_bytes", has_fixed_sizes, set_descriptors<&Descriptors::user_bytes>,
     built_in},
};

}  // namespace

std::span<const UnreadRule> unread_rules() { return rules; }

std::string why_unread(const UnreadRule& rule, const model::DdsProfile& profile) {
  if (!rule.why.empty()) return std::string{rule.why};
  return fmt::format("with implementation: {} this is a constant", model::traits_of(profile).name);
}

const UnreadRule* unread_rule(const model::DdsProfile& profile, std::string_view key) {
  for (const UnreadRule& rule : rules) {
    if (rule.key == key && rule.applies(profile)) return &rule;
  }
  return nullptr;
}

model::DdsProfile with_reduced_fractions(model::DdsProfile profile) {
  auto& adaptive = profile.sedp.adaptive;
  const auto divisor = std::gcd(adaptive.epsilon_numerator, adaptive.epsilon_denominator);
  if (divisor == 0) return profile;
  adaptive.epsilon_numerator /= divisor;
  adaptive.epsilon_denominator /= divisor;
  return profile;
}

model::DdsProfile normal_form(const model::DdsProfile& profile) {
  const model::DdsProfile defaults;
  model::DdsProfile normal = with_reduced_fractions(profile);
  normal.unmodelled.clear();
  normal.spdp.lease.reset();  // what acts elsewhere, see `Relation`
  normal.max_participants_per_host = 0;
  for (const UnreadRule& rule : rules) {
    if (rule.applies(normal)) rule.set(normal, defaults);
  }
  return normal;
}

}  // namespace stormproof::diff
