// All knobs of a scenario as a flat list, for tests that try every value of every knob.
#pragma once

#include <string>
#include <vector>

#include "model/config/knobs/knob_writer.hpp"
#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {

struct KnobInfo {
  std::string
      key;  ///< as `--set` takes it: "dds.sedp.heartbeat_period"; "*" for an element of a list
  std::string expected;              ///< kind and range
  std::vector<std::string> choices;  ///< words that it takes
  Json default_value;  ///< the value of the paper's evaluation, in the syntax of the file; null if
                       ///< absent
  std::string doc;     ///< one line
  Presence presence;   ///< whether a file without `base:` has to give it, or may not
};

class KnobLister {
 public:
  explicit KnobLister(std::vector<KnobInfo>& out, std::string prefix = {})
      : out_{out}, prefix_{std::move(prefix)} {}

  void knob(std::string_view key, auto&& member, const auto& type, std::string_view doc,
            Presence presence = Presence::required) {
    std::vector<std::string> choices;
    if constexpr (requires { type.names(); }) choices = type.names();
    if constexpr (requires { type.word; }) choices.emplace_back(type.word);
    out_.push_back({prefix_ + std::string{key}, type.expected(), std::move(choices),
                    write_value(type, member), std::string{doc}, presence});
  }
  template <class Section>
  void section(std::string_view key, const Section& member, std::string_view,
               Presence presence = {}, const auto&... context) {
    if constexpr (requires { member.has_value(); }) {
      const typename Section::value_type sample{};
      return section(key, member ? *member : sample, {}, presence, context...);
    } else {
      const std::size_t first = out_.size();
      KnobLister inner{out_, prefix_ + std::string{key} + "."};
      visit_knobs(inner, member, context...);
      if constexpr (std::same_as<Section, Deployment>) {
        const HomogeneousForm form;
        visit_knobs(inner, form);
      }
      if (presence != Presence::of_others) return;
      for (std::size_t k = first; k < out_.size(); ++k) out_[k].presence = presence;
    }
  }
  template <class Item>
  void list(std::string_view key, const std::vector<Item>&, ListSize, std::string_view,
            Presence = {}) {
    KnobLister inner{out_, prefix_ + std::string{key} + ".*."};
    const Item sample{};
    visit_knobs(inner, sample);
  }
  void rule(bool, std::string_view, std::string_view) {}

 private:
  std::vector<KnobInfo>& out_;
  std::string prefix_;
};

/// Every knob of deployment (both forms), DDS profile, wireless profile and scenario. Whatever the
/// implementation, the keys are the same; those that only the paper's model has are then marked
/// `of_others`.
inline std::vector<KnobInfo> scenario_knob_list(
    ImplementationKind implementation = ImplementationKind::paper) {
  std::vector<KnobInfo> knobs;
  KnobLister lister{knobs};
  Scenario sample;
  sample.dds.implementation = implementation;
  visit_knobs(lister, std::as_const(sample));
  return knobs;
}

}  // namespace stormproof::model::config
