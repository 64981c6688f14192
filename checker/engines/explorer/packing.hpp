// What the rules of a composition leave to a host: how what is sent at once is put into packets.
// Each composition that does that in a way of its own has a packing; what no packing does happens
// as its contract says, in one packet.
#pragma once

#include <memory>
#include <string_view>

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
                                                  const Scope& scope);
[[nodiscard]] std::unique_ptr<Packing> paper_packing(const model::Scenario& running,
                                                     const Scope& scope);
[[nodiscard]] std::unique_ptr<Packing> fastdds_packing(const model::Scenario& running,
                                                       const Scope& scope);

}  // namespace stormproof::explorer
