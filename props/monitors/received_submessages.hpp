// Which submessage of the packet that is received a machine of Cyclone DDS hears: they are
// processed in their order, and those that no machine hears have been ignored.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/cyclone/endpoints.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/submessage.hpp"
#include "model/probe.hpp"

namespace stormproof::props {

class ReceivedSubmessages {
 public:
  using Kind = model::Submessage::Kind;

  void reset(const model::Topology& topology) {
    topology_ = &topology;
    stride_ = model::cyclone::writers_per_participant(topology);
    submessages_.reset();
  }
  /// To be called from `received`.
  void arriving(const model::Packet& packet) {
    submessages_ = packet.submessages;
    next_ = 0;
  }
  /// To be called from `transition`, of each machine: the submessage that it hears, or null.
  const model::Submessage* heard(const model::MachineRef& machine, std::string_view event) {
    if (machine.machine == "CautiousReader") {
      if (event == "HeartbeatReceived") return next(Kind::heartbeat, machine.subject);
      if (event == "DataReceived") return next(Kind::data, machine.subject);
    }
    const bool acknack = machine.machine == "MatchedReader" && event == "AckNackReceived";
    return acknack ? next(Kind::acknack, machine.subject) : nullptr;
  }

  // The numbers of relations and writers.
  [[nodiscard]] std::uint32_t stride() const { return stride_; }
  [[nodiscard]] std::uint32_t writer_count() const {
    return stride_ * topology_->participant_count();
  }
  [[nodiscard]] std::uint32_t relation_count() const { return stride_ * topology_->pair_count(); }
  /// Of a participant: 0 publications, 1 subscriptions, …
  [[nodiscard]] std::uint32_t writer_of(std::uint32_t relation) const {
    return stride_ * ends(relation).source + relation % stride_;
  }
  [[nodiscard]] const model::Pair& ends(std::uint32_t relation) const {
    return topology_->pair(relation / stride_);
  }
  /// Whose descriptors are counted: of the two streams.
  [[nodiscard]] bool is_of_stream(std::uint32_t relation_or_writer) const {
    return relation_or_writer % stride_ <= model::cyclone::writer::subscriptions;
  }
  /// The writer that has one sample more after the event, which is a creation.
  [[nodiscard]] std::uint32_t writer_of_creation(const model::Event& event) const {
    const std::uint32_t publications =
        topology_->descriptor_count(event.subject, model::Stream::pub) -
        model::default_publications;
    const bool is_publication =
        model::creation_order(event.detail, publications).stream == model::Stream::pub;
    return stride_ * event.subject + (is_publication ? model::cyclone::writer::publications
                                                     : model::cyclone::writer::subscriptions);
  }

 private:
  const model::Submessage* next(Kind kind, std::uint32_t relation) {
    while (submessages_ != nullptr && next_ < submessages_->size()) {
      const model::Submessage& m = (*submessages_)[next_++];
      if (m.kind == kind && m.writer == relation % stride_) return &m;
    }
    return nullptr;
  }

  const model::Topology* topology_ = nullptr;
  std::uint32_t stride_ = 1;
  std::shared_ptr<const std::vector<model::Submessage>> submessages_;
  std::size_t next_ = 0;
};

}  // namespace stormproof::props
