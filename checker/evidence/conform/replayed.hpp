// What a replay asks of the rules of one side of a captured relation, whichever composition they
// are of: those of Fast DDS (reader_host.hpp, writer_host.hpp), or what a Discovery Server adds to
// them (learner_host.hpp, relay_host.hpp). What arrives when is the replay's choice.
#pragma once

#include <cstdint>
#include <optional>

#include "checker/evidence/conform/dialogue.hpp"
#include "fsm/stepper.hpp"
#include "model/engine/descriptor_set.hpp"

namespace stormproof::conform {

/// By which rules an initial ACKNACK and a reply are explained.
struct AckNackRules {
  Rule initial{};
  Rule reply{};
};
/// The same of DATA: pushed, for the first time because it was asked for, and again.
struct DataRules {
  Rule pushed{};
  Rule first{};
  Rule again{};
};

/// An ACKNACK as the rules have it.
struct MadeAckNack {
  bool is_initial = false;
  std::uint32_t base = 0;
  model::DescriptorSet listed{};
};

class ReplayedReader {
 public:
  virtual ~ReplayedReader() = default;

  virtual void open(std::int64_t now_ns) = 0;
  virtual void receive(const Submessage& message, std::int64_t now_ns) = 0;
  /// A HEARTBEAT of which the rule has run asks for its reply only now.
  virtual void ask_again(std::int64_t now_ns) = 0;
  /// What is sent when the initial ACKNACK, or a reply, is due.
  virtual std::optional<MadeAckNack> attempt(std::int64_t now_ns) = 0;
  virtual std::optional<MadeAckNack> reply(std::int64_t now_ns) = 0;
  /// When the timer that was started last is due; it is forgotten with that.
  virtual std::optional<std::int64_t> take_reply_due() = 0;
  /// How long the next initial ACKNACK waits; nothing: there is none.
  virtual std::optional<std::int64_t> take_initial_delay() = 0;
  [[nodiscard]] virtual AckNackRules explained_by() const = 0;
};

class ReplayedWriter {
 public:
  virtual ~ReplayedWriter() = default;

  /// The relation opens when the first `existing` descriptors exist.
  virtual void open(std::uint32_t existing) = 0;
  virtual void receive(const Answer& answer, std::int64_t now_ns) = 0;
  /// The descriptor is new and sent; whether the reader is sent it.
  virtual bool create(std::uint32_t descriptor, std::int64_t now_ns) = 0;
  /// The descriptor's turn in the queue has come; whether the reader is sent it.
  virtual bool serve(std::uint32_t descriptor, std::int64_t now_ns) = 0;
  virtual void respond(std::int64_t now_ns) = 0;
  virtual void end_suppression(std::int64_t now_ns) = 0;
  /// In the machine ChangeForReader.
  [[nodiscard]] virtual fsm::StateId state_of(std::uint32_t descriptor) = 0;
  [[nodiscard]] virtual DataRules explained_by() const = 0;
  /// Whether what an ACKNACK asks for is surely sent again under its number.
  [[nodiscard]] virtual bool answers_all() const = 0;
};

}  // namespace stormproof::conform
