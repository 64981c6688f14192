// The knobs in which two profiles differ, by the tables of the profile reader, and what can be said
// about the two without running anything. The argument behind `equivalent`: a run is a function of
// the scenario, and the rules of the model read the DDS profile only through knobs that the normal
// form keeps, so equal normal forms are equal inputs of every rule.
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/diff/normal_form.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/implementations.hpp"

namespace stormproof::diff {

namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<std::pair<std::string, std::string>>;  // key → as a file would say it

constexpr std::string_view absent = "–";
constexpr std::string_view unmodelled_prefix = "unmodelled.";

void flatten(const Json& json, const std::string& prefix, Values& values) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object())
      flatten(value, prefix + key + ".", values);
    else
      values.emplace_back(prefix + key,
                          value.is_string() ? value.get<std::string>() : value.dump());
  }
}

Values values_of(const model::DdsProfile& profile) {
  Values values;
  flatten(model::config::effective_json(profile), {}, values);
  return values;
}

std::string value_in(const Values& values, const std::string& key) {
  for (const auto& [name, value] : values) {
    if (name == key) return value;
  }
  return std::string{absent};
}

/// All keys of both, in the order of the table: `fuller` has all keys of the other, but for
/// settings that the model has not.
std::vector<std::string> keys_of(const Values& fuller, const Values& other) {
  std::vector<std::string> keys;
  std::set<std::string> known;
  const auto add = [&](const Values& values, bool unmodelled) {
    for (const auto& [key, value] : values) {
      if (key.starts_with(unmodelled_prefix) == unmodelled && known.insert(key).second) {
        keys.push_back(key);
      }
    }
  };
  for (const bool unmodelled : {false, true}) {
    add(fuller, unmodelled);
    add(other, unmodelled);
  }
  return keys;
}

model::config::Place place_of(const model::config::TracedProfile& traced, const std::string& key) {
  const auto found = traced.places.find(key);
  return found == traced.places.end() ? model::config::Place{} : found->second;
}

constexpr std::string_view lease_key = "spdp.lease";
constexpr std::string_view crowd_key = "max_participants_per_host";

/// Whether it acts where somebody leaves, the network fails or a host is crowded.
bool is_elsewhere(const KnobChange& change) {
  return change.key == lease_key || change.key == crowd_key;
}

/// What differs there.
std::string elsewhere(const model::DdsProfile& base, const model::DdsProfile& candidate) {
  std::string text;
  const model::Nanoseconds before = lease_of(base), after = lease_of(candidate);
  if (before != after && before.count() > 0 && after.count() > 0) {
    const std::string one = model::config::print_duration(before);
    const std::string other = model::config::print_duration(after);
    const bool is_longer = after > before;
    text = fmt::format(
        "A participant that leaves without a goodbye stays in the lists of the others, as a ghost, "
        "for {} after its last packet with the base and for {} with the candidate. Where the "
        "network fails for longer than {} and shorter than {}, the {} has to recover by a new "
        "discovery, and with the {} nobody forgets anybody. ",
        one, other, is_longer ? one : other, is_longer ? other : one,
        is_longer ? "base" : "candidate", is_longer ? "candidate" : "base");
  }
  const auto most = [](const model::DdsProfile& dds) {
    const std::uint32_t count = participants_of_a_host(dds);
    return count == 0 ? std::string{"all"} : std::to_string(count);
  };
  if (most(base) != most(candidate)) {
    text += fmt::format(
        "Of the participants of a host {} start with the base and {} with the "
        "candidate. ",
        most(base), most(candidate));
  }
  return text;
}

bool is_unmodelled(const KnobChange& change) { return change.key.starts_with(unmodelled_prefix); }

/// Whether the change can make a difference, and why not.
void judge(KnobChange& change, const model::DdsProfile& base, const model::DdsProfile& candidate,
           bool same_runs) {
  if (is_unmodelled(change)) {
    change.modelled = false;
    change.matters = false;
    change.why = "the model has no such setting: what it does to discovery is not known here";
    return;
  }
  if (is_elsewhere(change)) {
    change.matters = false;
    const std::string what = elsewhere(base, candidate);
    change.why = what.empty() ? "it is what the library has anyway"
                 : change.key == lease_key
                     ? "a lease acts where somebody leaves or the network fails"
                     : "it decides how many participants of a host start";
    return;
  }
  const UnreadRule* const before = unread_rule(base, change.key);
  const UnreadRule* const after = unread_rule(candidate, change.key);
  // In profiles that differ elsewhere a knob is idle only if neither of them reads it.
  change.matters = !same_runs && !(before != nullptr && after != nullptr);
  if (change.matters) return;
  change.why = before != nullptr  ? why_unread(*before, base)
               : after != nullptr ? why_unread(*after, candidate)
                                  : "";
}

Relation relation_of(const std::vector<KnobChange>& changes, bool same_runs,
                     bool differs_elsewhere) {
  if (!same_runs) return Relation::different;
  if (changes.empty()) return Relation::identical;
  for (const KnobChange& change : changes) {
    if (is_unmodelled(change)) return Relation::unmodelled;
  }
  return differs_elsewhere ? Relation::elsewhere : Relation::equivalent;
}

std::string proof_of(Relation relation) {
  switch (relation) {
    case Relation::identical:
      return "Every knob has the same value in both profiles. A run is a function of the scenario "
             "alone, so in every deployment and on every channel both have the same run, event by "
             "event.";
    case Relation::equivalent:
      return "No rule reads the knobs that differ, given the choices that the profiles make "
             "otherwise: their normal forms are equal. A run is a function of what its rules read, "
             "so in every deployment and on every channel both have the same run, event by event.";
    case Relation::unmodelled:
      return "In the model both profiles have the same run in every deployment and on every "
             "channel: what differs is read by no rule. The real systems may differ, because the "
             "model has not got some of these settings.";
    case Relation::elsewhere:
      return "While nobody leaves, the network does not fail and every participant starts, both "
             "have the same run, event by event: no rule reads what differs. ";
    case Relation::different:
      break;
  }
  return {};
}

}  // namespace

Comparison compare_profiles(const model::config::TracedProfile& base,
                            const model::config::TracedProfile& candidate) {
  const model::DdsProfile one = with_reduced_fractions(base.value);
  const model::DdsProfile other = with_reduced_fractions(candidate.value);
  const bool same_runs = normal_form(one) == normal_form(other);
  const Values before = values_of(one);
  const Values after = values_of(other);

  // Where rules and sizes are built in, they are no knobs.
  const bool base_is_fuller = !model::traits_of(one).fixed_rules;
  Comparison comparison;
  for (const std::string& key : base_is_fuller ? keys_of(before, after) : keys_of(after, before)) {
    KnobChange change{key, value_in(before, key), value_in(after, key), {}, {}, true, true, {}};
    if (change.before == change.after) continue;
    change.before_place = place_of(base, key);
    change.after_place = place_of(candidate, key);
    judge(change, one, other, same_runs);
    comparison.changes.push_back(std::move(change));
  }
  const std::string there = elsewhere(one, other);
  comparison.relation = relation_of(comparison.changes, same_runs, !there.empty());
  comparison.proof = proof_of(comparison.relation);
  if (comparison.relation == Relation::elsewhere || comparison.relation == Relation::unmodelled) {
    comparison.proof += (comparison.proof.ends_with(' ') ? "" : " ") + there;
    if (!there.empty()) {
      comparison.proof +=
          "That was not run: a scenario with deployment.life describes who leaves and when the "
          "network fails.";
    }
  }
  return comparison;
}

}  // namespace stormproof::diff
