// order.commutation: for each pair of same-time event kinds on one relation, whether their order
// matters, compared with the matrix that specs/expected/commutation.yaml keeps. So the list of
// pairs that the tie rule must decide can neither grow nor shrink unnoticed.
#include <map>
#include <set>

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include "checker/engines/tables/commutation_matrix.hpp"
#include "checker/engines/tables/ignored_pairs.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {
namespace {

using Pair = std::pair<std::string, std::string>;

struct Expected {
  Verdict verdict = Verdict::commutes;
  std::string why;
};

Pair ordered(std::string a, std::string b) {
  return a < b ? Pair{std::move(a), std::move(b)} : Pair{std::move(b), std::move(a)};
}

void read(const YAML::Node& entries, Verdict verdict, std::map<Pair, Expected>& expected) {
  for (const YAML::Node& entry : entries) {
    const Pair pair =
        ordered(entry["pair"][0].as<std::string>(), entry["pair"][1].as<std::string>());
    std::string why = entry["why"].as<std::string>();
    if (entry["decided"]) why += " Tie rule: " + entry["decided"].as<std::string>();
    expected[pair] = {verdict, std::move(why)};
  }
}

std::map<Pair, Expected> expected_matrix(std::string_view implementation) {
  const YAML::Node file = YAML::Load(expected_commutation_text);
  const YAML::Node section = file["implementations"][std::string{implementation}];
  std::map<Pair, Expected> expected;
  read(section["matters"], Verdict::matters, expected);
  read(section["only_unreachable"], Verdict::unreachable, expected);
  return expected;
}

std::string in_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::matters:
      return "the order matters";
    case Verdict::unreachable:
      return "the order matters only in states that no run reaches";
    default:
      return "the order does not matter";
  }
}

void compare(Proof& proof, const EventGroup& group, const PairResult& result,
             std::map<Pair, Expected>& expected) {
  const Pair pair = ordered(group.kinds[result.first].name, group.kinds[result.second].name);
  const std::string text = pair.first + ", " + pair.second + ": ";
  const auto found = expected.find(pair);
  const bool listed = found != expected.end();
  const Expected entry = listed ? found->second : Expected{};
  if (listed) expected.erase(found);
  if (result.verdict == Verdict::unknown) return;
  const bool plain = result.verdict == Verdict::commutes;
  const bool same = listed ? result.verdict == entry.verdict : plain;
  if (!same) {
    proof.violate(text + in_words(result.verdict) + ", but expected is: " +
                  in_words(entry.verdict) + (result.witness.empty() ? "" : "; " + result.witness));
  } else if (listed) {
    proof.detail(text + in_words(result.verdict) + ". " + entry.why);
    proof.detail("  witness: " + result.witness);
  }
}

}  // namespace

Finding order_commutation(const CheckRequest& request) {
  Proof proof{"order.commutation", request};
  const model::DdsProfile& dds = proof.scenario().dds;
  const Extent extent;
  proof.assume(fmt::format(
      "Looked at are {} descriptors of {} readers of each of {} writers of a participant, exactly; "
      "that more of them change no answer is tested, not proved.",
      extent.descriptors, extent.readers, extent.streams));
  proof.assume(
      "The knobs of the profile are free, except that the HEARTBEAT policy is the periodic one: "
      "the cycle events of the adaptive policy are not among the kinds.");
  proof.assume(
      "Equal are two orders that lead to the same state and emit and schedule the same things at "
      "the "
      "same times. Left out are the order of emission, what HEARTBEATs and DATA announce, and "
      "packing: each descriptor goes alone, and what only the piggyback budget decides is the same "
      "in both orders.");
  proof.assume(hosts_keep_contracts);
  std::map<Pair, Expected> expected = expected_matrix(model::traits_of(dds).name);
  const std::vector<EventGroup> groups =
      model::visit_engine_composition(dds, [](auto composition) { return events_of(composition); });
  // Of a mutant it is only asked whether it is noticed: the first pair decides.
  const bool first_decides = request.mutant != nullptr;
  for (const EventGroup& group : groups) {
    const auto results = commutation_matrix(proof, group, extent, [&](const PairResult& result) {
      if (first_decides) compare(proof, group, result, expected);
      return !first_decides || !proof.violated();
    });
    if (first_decides && proof.violated()) break;
    proof.detail("events of " + group.of_what + ":");
    for (std::string& line : matrix_lines(group, results)) proof.detail(std::move(line));
    if (first_decides) continue;
    for (const PairResult& result : results) compare(proof, group, result, expected);
  }
  if (!first_decides || !proof.violated()) {
    for (const auto& [pair, entry] : expected) {
      proof.violate("expected, but no such pair: " + pair.first + ", " + pair.second);
    }
  }
  return proof.finish(
      "both orders of each pair of event kinds, from every state and input, "
      "compared with the expected matrix");
}

}  // namespace stormproof::tables
