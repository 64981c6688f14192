// Where a rule is in a model: its relation, and the descriptor that it is about. Flags, timers,
// packets and machines are variables there; what the rule does to them are statements.
#pragma once

#include <cctype>
#include <string>
#include <type_traits>
#include <vector>

#include <boost/pfr.hpp>
#include <fmt/core.h>

#include "checker/engines/promela/script.hpp"
#include "checker/engines/promela/table_macros.hpp"

namespace stormproof::promela {

namespace composition = fsm::composition;

/// A single letter is written small, because X and U are operators of the claims.
template <class T>
std::string name() {
  std::string text{fsm::name_of<T>()};
  if (text.size() == 1) text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}

/// Whether a descriptor has one, so that it is a bit or an element of something.
template <class T>
inline constexpr bool of_descriptors = (T::owner.indices & composition::owner::descriptor_index) !=
                                       0;

class PromelaPlace {
 public:
  using D = Written;

  PromelaPlace(Script& script, const std::vector<fsm::TableMutation>& mistakes, int descriptor)
      : script_{&script}, descriptor_{descriptor}, subject_{descriptor}, mistakes_{&mistakes} {}

  /// The part is in the model, in its initial state.
  template <class P>
  void declare() {
    const std::string initial = Table<P>::state(fsm::name_of<typename P::Machine::initial_state>());
    const std::string count =
        of_descriptors<P> ? fmt::format("[{}]", script_->descriptors()) : std::string{};
    script_->define(Table<P>::states());
    script_->declare(fmt::format("byte {}{} = {};\n", name<P>(), count, initial));
  }
  /// The rule is about this packet.
  void look_at(const std::string& packet) { packet_ = packet; }

 protected:
  // Flags, timers and packets.
  template <class V>
  Truth flag() {
    if (!script_->is_found("set " + name<V>())) return false;
    return of_descriptors<V> ? script_->bit(name<V>(), descriptor_) : script_->truth(name<V>());
  }
  template <class V>
  void assign(const Truth& may_hold, const Expression& value) {
    if (!may_hold.is(false)) script_->find("set " + name<V>());
    if (!script_->is_found("set " + name<V>())) return;
    script_->declare((of_descriptors<V> ? "byte " : "bool ") + name<V>() + ";\n");
    script_->assign(name<V>(), value);
  }
  template <class T>
  void start() {
    script_->find("due " + name<T>());
    script_->declare((T::counted ? "byte " : "bool ") + name<T>() + ";  /* pending */\n");
    if constexpr (T::counted) {
      script_->write(fmt::format("assert({} < 255)", name<T>()));  // a byte can count it
      script_->assign(name<T>(), (script_->number(name<T>()) + 1).expression());
    } else {
      script_->assign(name<T>(), Truth{true}.expression());
    }
  }
  [[nodiscard]] Truth field(const std::string& field, bool bitmap) const {
    const std::string variable = variable_of(packet_, field);
    if (!script_->is_said(variable)) return false;
    return bitmap ? script_->bit(variable, descriptor_) : script_->truth(variable);
  }
  // Machines.
  template <class P>
  using Table = TableMacros<typename P::Machine>;

  template <class P>
  [[nodiscard]] std::string state() const {
    return of_descriptors<P> ? fmt::format("{}[{}]", name<P>(), descriptor_) : name<P>();
  }
  /// The part's table, its outbox empty.
  template <class P, class E>
  Table<P> cleared() {
    declare<P>();
    Table<P> table{*mistakes_};
    typename P::Machine::Io::template Output<D> output;
    for_each_asked<E>(table, output, [&](Truth&, const std::string& outbox) {
      script_->declare("hidden byte " + outbox + ";\n");
      script_->assign(outbox, Number{0}.expression());
    });
    script_->define(table.macro(fsm::Reflect<typename P::Machine>::template event_id<E>));
    return table;
  }
  template <class P, class E>
  void step(const Table<P>& table, const typename P::Machine::Io::template Input<D>& input) {
    std::string call = fmt::format(
        "{}({}, {}", table.name(fsm::Reflect<typename P::Machine>::template event_id<E>),
        state<P>(), of_descriptors<P> ? descriptor_ : 0);
    for (const Truth& finding : table.template findings<E>(input)) {
      call += ", " + script_->say(finding.expression());
    }
    script_->write(call + ")");
    script_->changed(state<P>());
    typename P::Machine::Io::template Output<D> output;
    for_each_asked<E>(table, output,
                      [&](Truth&, const std::string& outbox) { script_->changed(outbox); });
  }
  /// Visits the fields of an outbox that the event can raise, with their variables.
  template <class E, class Macros, class Output, class Visit>
  static void for_each_asked(const Macros& table, Output& output, Visit&& visit) {
    constexpr auto event = fsm::Reflect<typename Macros::Of>::template event_id<E>;
    boost::pfr::for_each_field(output, [&](auto& field, std::size_t k) {
      if constexpr (std::is_invocable_v<Visit, decltype(field), std::string>) {
        if (table.asks(event, k)) visit(field, table.outbox(k));
      }
    });
  }

  Script* script_;
  int descriptor_;
  int subject_;  ///< the descriptor that the rule is about

 private:
  const std::vector<fsm::TableMutation>* mistakes_;
  std::string packet_;
};

}  // namespace stormproof::promela
