// A kind of packet in a derived system: one variable for each content with which one has been sent
// to or by our relation. What was sent may arrive at any time, any number of times. Numbers that a
// packet says are unknown to its receiver.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "checker/engines/tables/derived.hpp"
#include "fsm/composition/packets.hpp"

namespace stormproof::tables {

template <class P>
class DerivedPacket {
 public:
  using Says = DerivedTime::Says;
  using Content = std::vector<std::pair<std::string, bool>>;

  explicit DerivedPacket(Derived& derived) : derived_{derived} {}

  /// "sent AckNack Listed" and what that packet says, for each content that P can have.
  static std::vector<std::pair<std::string, Content>> all_contents() {
    std::vector<std::pair<std::string, Content>> all{{"sent " + tag_name<P>(), {}}};
    composition::for_each_type(typename P::Fields{}, [&]<class F>() {
      if constexpr (std::derived_from<F, composition::PacketNumber>) return;
      const std::size_t count = all.size();
      for (std::size_t k = 0; k < count; ++k) {
        all.push_back(all[k]);
        all.back().first += " " + tag_name<F>();
        all.back().second.emplace_back(tag_name<F>(), true);
        all[k].second.emplace_back(tag_name<F>(), false);
      }
    });
    return all;
  }

  void emitted(const Expr& when, const Says& says) const {
    if (derived_.emitted) derived_.emitted(tag_name<P>(), when, says);
    if (derived_.time != nullptr) derived_.time->emitted(tag_name<P>(), when, says);
    for (const auto& [name, content] : all_contents()) {
      Expr is = when;
      for (const auto& [field, value] : content) {
        const Expr said = says.contains(field) ? says.at(field) : smt::SymbolicBool{}.expr();
        is = is && (value ? said : !said);
      }
      system().assign(name, is.simplify(), smt::SymbolicBool{true}.expr());
    }
  }

  /// What one that arrives says: inputs of the step.
  [[nodiscard]] Says inputs() const {
    Says says;
    composition::for_each_type(typename P::Fields{}, [&]<class F>() {
      if constexpr (std::derived_from<F, composition::PacketNumber>) return;
      says.emplace(tag_name<F>(), system().input(tag_name<F>()));
    });
    return says;
  }
  /// One has been sent that says this.
  void arrives(const Says& says) const {
    Exprs cases;
    for (const auto& [name, content] : all_contents()) {
      Expr is = system().now(name);
      for (const auto& [field, value] : content) {
        is = is && (value ? says.at(field) : !says.at(field));
      }
      cases.push_back(is);
    }
    system().require(any_of(cases));
    forget_if_unsound();
  }
  /// The mistake of a bitmap that is read when it arrives: some ACKNACK has been sent, and says
  /// what it would say `now`.
  void arrives_as(const Says& says, const Says& now) const {
    const std::string initial = tag_name<composition::IsInitial>();
    Exprs cases;
    for (const auto& [name, content] : all_contents()) {
      const bool is_initial = std::ranges::find(content, std::pair{initial, true}) != content.end();
      cases.push_back(system().now(name) && (is_initial ? says.at(initial) : !says.at(initial)));
    }
    system().require(any_of(cases));
    for (const auto& [field, value] : now) {
      if (field != initial) system().require(says.at(field) == value);
    }
    forget_if_unsound();
  }

 private:
  [[nodiscard]] Derivation& system() const { return derived_.derivation; }
  void forget_if_unsound() const {
    if (!system().is(Unsound::packets_arrive_once)) return;
    for (const auto& content : all_contents()) {
      system().now(content.first) = smt::SymbolicBool{false}.expr();
    }
  }

  Derived& derived_;
};

}  // namespace stormproof::tables
