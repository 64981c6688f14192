// Runs the rules of a specialised program (checker/engines/explorer/specialised.hpp) on a state and
// a frame. A term has two readings: as one value, where the rule is, or as the set of the
// descriptors for which it holds. What is scheduled becomes a slot of the frame, what is emitted a
// packet that may be late or lost.
//
// There is one participant, number 0, of which one stream or both are explored, with one or several
// readers: reader r is participant r + 1, and open relations stand in ascending order. In Fast DDS
// that is the order in which they have opened, which the world keeps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "checker/engines/explorer/claims.hpp"
#include "checker/engines/explorer/packing.hpp"
#include "checker/engines/explorer/specialised.hpp"

namespace stormproof::explorer {

class RuleRunner {
 public:
  using Steps = Specialised::Steps;

  /// What the world remembers besides the things of the program.
  struct Remembered {
    Kept asked{};      ///< descriptors: listed by an ACKNACK since they were generated last
    Kept generated{};  ///< descriptors: sent
    Kept announced{};  ///< descriptors of which the reader has heard, if ACKNACKs list only these
    Kept queue{};      ///< with several relations: entries, first in, first out, each a byte
    Kept received{};   ///< X
    Kept open{};       ///< by relation
    Kept queued{};     ///< descriptors: in the queue
  };
  RuleRunner(const Specialised& program, const Remembered& remembered, const Scope& scope,
             std::array<unsigned, most_writers> descriptors, Packing& host);

  /// What rules are about from now on.
  void go_on_with(WorldState& state, Frame& frame) {
    state_ = &state;
    frame_ = &frame;
  }
  /// The rule for a packet or a timer. `emitted`: as what the packet was emitted.
  void run(const Slot& slot, const Slot& emitted);
  /// The same for a participant.
  void run_at(unsigned participant, const Slot& slot);
  /// The same for a descriptor.
  void run(const Slot& slot, unsigned descriptor) {
    descriptor_ = descriptor;
    run(slot, slot);
  }
  /// The rule of an occasion of a participant, or of what it is in its relation.
  void raise(std::string_view occasion, unsigned participant);
  /// What the reader would say if it emitted the ACKNACK now.
  [[nodiscard]] Slot said_now(const Slot& acknack);

  // For packings.
  [[nodiscard]] WorldState& state() { return *state_; }
  [[nodiscard]] Frame& frame() { return *frame_; }
  [[nodiscard]] unsigned relation() const { return relation_; }
  [[nodiscard]] unsigned descriptor() const { return descriptor_; }
  [[nodiscard]] unsigned writer() const { return relation_ % writers_; }
  [[nodiscard]] unsigned descriptors(unsigned relation) const {
    return descriptors_[relation % writers_];
  }
  /// The open relations of the writer, in ascending order.
  [[nodiscard]] std::vector<unsigned> readers() const;
  /// What the steps emit, which is not sent.
  [[nodiscard]] std::vector<Slot> emitted_by(const Steps& contract);
  /// Descriptors are generated for a relation's reader.
  void note_generated(unsigned relation, Members members, bool is_repair);
  void send(const Slot& packet) { frame_->emit(packet); }

 private:
  using Ref = Specialised::Ref;
  using Step = Specialised::Step;
  using Term = Specialised::Term;
  /// Descriptors, one bit each, and beyond those that there are whatever the term says.
  using Lanes = std::uint64_t;

  [[nodiscard]] std::int64_t number(Ref ref);
  [[nodiscard]] std::int64_t selected(const Term& term, Ref ref);
  [[nodiscard]] bool truth(Ref ref) { return number(ref) != 0; }
  [[nodiscard]] std::int64_t read(const Term& term);
  [[nodiscard]] Lanes lanes(Ref ref);
  [[nodiscard]] Lanes in_state(const Term& term) const;
  [[nodiscard]] Members members(Ref ref) { return static_cast<Members>(lanes(ref) & valid()); }
  [[nodiscard]] Lanes valid() const { return valid_[relation_ % writers_]; }
  [[nodiscard]] std::int64_t count_readers(Ref ref);
  [[nodiscard]] bool some_entry(const Term& term);

  void run(const Steps& steps) {
    for (const Step& step : steps) take(step);
  }
  void take(const Step& step);
  void for_readers(const Step& step);
  void for_descriptors(const Step& step);
  void for_queue(const Step& step);
  void feed(const Step& step, std::uint8_t& state);
  void feed_each(const Step& step);
  void set_each(const Step& step);
  void schedule(const Step& step);
  void emit(const Step& step);
  void sent(const Slot& packet);
  void hear(const Step& step);
  void perform(const Step& step);
  void go_on();

  [[nodiscard]] Members get(Kept kept) const { return state_->get<Members>(kept, relation_); }
  void set(Kept kept, unsigned members) {
    state_->set(kept, static_cast<Members>(members), relation_);
  }
  [[nodiscard]] Lanes open_readers() const;
  [[nodiscard]] unsigned queue_capacity() const { return descriptors_[0] * writers_; }

  const Specialised& program_;
  const Remembered remembered_;
  Packing& host_;
  const unsigned readers_;
  const unsigned writers_;
  const std::array<unsigned, most_writers> descriptors_;
  std::array<Lanes, most_writers> valid_{};
  std::vector<std::int64_t> registers_;
  /// What a selection is within one step; one may be part of another many times.
  struct Selected {
    std::uint64_t step = 0;
    std::int64_t value = 0;
  };
  std::vector<Selected> selected_;
  std::uint64_t step_ = 0;
  WorldState* state_ = nullptr;
  Frame* frame_ = nullptr;
  // The place.
  unsigned relation_ = 0;
  unsigned descriptor_ = 0;
  const Slot* packet_ = nullptr;
  const Slot* emitted_ = nullptr;
  std::vector<Slot>* kept_back_ = nullptr;  ///< where packets go that are not sent
  /// An effect that comes after the next one.
  struct Deferred {
    const Steps& effect;
    unsigned relation;
    unsigned descriptor;
    std::vector<std::int64_t> registers;
  };
  std::optional<Deferred> deferred_;
};

}  // namespace stormproof::explorer
