// What the rules of a composition leave to a host: how what is sent at once is put into packets,
// and, where rules compare times, what times are. Each composition that does that in a way of its
// own has a packing; what no packing does happens as its contract says, in one packet.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/explorer/frame.hpp"
#include "checker/engines/explorer/specialised.hpp"
#include "model/scenario.hpp"

namespace stormproof::explorer {

class Packing {
 public:
  Packing(const model::Scenario& running, const Scope& scope) : running_{running}, scope_{scope} {}
  virtual ~Packing() = default;
  Packing(const Packing&) = delete;
  Packing& operator=(const Packing&) = delete;

  /// How many a writer has.
  [[nodiscard]] virtual unsigned descriptors(model::Stream) const { return scope_.descriptors; }
  /// How the step of this name is done; nothing: by its contract.
  [[nodiscard]] virtual Specialised::Action action(std::string_view) { return {}; }
  // What a host keeps itself of the numbers of a program, or answers.
  /// The number by which it knows the thing of this name; nothing: it is kept as others are.
  [[nodiscard]] virtual std::optional<unsigned> keeps(std::string_view) const { return {}; }
  /// Whether reading it can decide what was open.
  [[nodiscard]] virtual bool is_decided_by_reading(unsigned) const { return false; }
  [[nodiscard]] virtual std::int64_t read(unsigned, RuleRunner&) { return 0; }
  virtual void set(unsigned, std::int64_t, RuleRunner&) {}

  // What it does with what rules emit and schedule, and with events, in a way of its own: whether
  // it does.
  [[nodiscard]] virtual bool leaves(const Slot&, RuleRunner&) { return false; }
  [[nodiscard]] virtual bool moves(const Slot&, std::int64_t, RuleRunner&) { return false; }
  [[nodiscard]] virtual bool happens(const Slot&, RuleRunner&) { return false; }
  /// Rules act at the other end of the relation as well; a participant there has machines of its
  /// own.
  [[nodiscard]] virtual bool has_two_ends() const { return false; }
  /// Occasions that it makes happen.
  [[nodiscard]] virtual std::vector<std::string_view> occasions() const { return {}; }
  /// The state in words, if it has words of its own.
  [[nodiscard]] virtual std::string describe(const WorldState&) const { return {}; }

  /// Room for what it remembers.
  virtual void keep(Layout&) {}
  virtual void start(WorldState&) {}

 protected:
  [[nodiscard]] const model::SedpProfile& sedp() const { return running_.dds.sedp; }
  [[nodiscard]] const model::Scenario& running() const { return running_; }
  [[nodiscard]] const Scope& scope() const { return scope_; }

 private:
  const model::Scenario running_;
  const Scope scope_;
};

/// That of whoever has the steps that it does.
[[nodiscard]] std::unique_ptr<Packing> packing_of(const fsm::program::Program& program,
                                                  const model::Scenario& running,
                                                  const Scope& scope, const EventRules& rules);
[[nodiscard]] std::unique_ptr<Packing> paper_packing(const model::Scenario& running,
                                                     const Scope& scope);
[[nodiscard]] std::unique_ptr<Packing> cyclone_packing(const fsm::program::Program& program,
                                                       const model::Scenario& running,
                                                       const Scope& scope, const EventRules& rules);
[[nodiscard]] std::unique_ptr<Packing> fastdds_packing(const model::Scenario& running,
                                                       const Scope& scope);

}  // namespace stormproof::explorer
