// What readers take of the DATA that reaches them, and so X: gathered once for all monitors of a
// run that need it. Each of them is told of what is taken when X has it.
#pragma once

#include <bit>
#include <memory>
#include <utility>
#include <vector>

#include "props/monitors/observer.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

class DataProbe final : public model::Probe {
 public:
  class Listener {
   public:
    virtual ~Listener() = default;
    /// The reader takes the DATA; `fresh` of its descriptors are new to it. X has them.
    virtual void took(const model::Packet& data, std::uint32_t fresh) = 0;
  };

  /// `forgets`: whether a new reader has nothing, or what the one before it had.
  explicit DataProbe(bool forgets) : forgets_{forgets} {}

  [[nodiscard]] bool gathers_as(const DataProbe& other) const { return forgets_ == other.forgets_; }
  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    reports.set(model::Report::received);
    reports.set(model::Report::reader_transition);
    return reports;
  }
  void listen(Listener& listener) { listeners_.push_back(&listener); }

  void run_started(const model::Topology& topology) override {
    received_.reset(topology);
    lacking_.clear();
    for (std::uint32_t relation = 0; relation < topology.relation_count(); ++relation) {
      lacking_.push_back(topology.descriptor_count(relation));
    }
    all_ = lacking_;
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::Transition& fired) override {
    if (const model::Packet* data = received_.taken(fired.machine, fired.event)) {
      const std::uint32_t fresh = fresh_in(*data);
      received_.take(*data);
      lacking_[data->relation()] -= fresh;
      for (Listener* one : listeners_) one->took(*data, fresh);
    } else if (forgets_ && ReceivedDescriptors::is_new(fired.machine, fired.event)) {
      received_.lose(fired.machine.subject);
      lacking_[fired.machine.subject] = all_[fired.machine.subject];
    }
  }

  [[nodiscard]] const ReceivedDescriptors& x() const { return received_; }
  /// How many descriptors the reader of the relation has not received.
  [[nodiscard]] std::uint32_t lacking(std::uint32_t relation) const { return lacking_[relation]; }

 private:
  [[nodiscard]] std::uint32_t fresh_in(const model::Packet& data) const {
    const model::DescriptorSet& set = data.descriptors;
    if (set.empty()) return 0;
    int fresh = 0;
    for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) {
      fresh += std::popcount(set.word(k) & ~received_.word(data.relation(), k));
    }
    return static_cast<std::uint32_t>(fresh);
  }

  const bool forgets_;
  ReceivedDescriptors received_;
  std::vector<std::uint32_t> lacking_;  // by relation
  std::vector<std::uint32_t> all_;      // the same before the run
  std::vector<Listener*> listeners_;
};

/// A monitor that needs X.
template <class Base = Observer>
class DataObserver : public Base, private DataProbe::Listener {
 public:
  using Feeder = DataObserver;
  static constexpr bool gathers_data = true;

  using Base::Base;

  void join(model::Company& company) override {
    Base::join(company);
    const auto own = std::exchange(probe_, company.gatherer_like(probe_));
    if (probe_ != own) probe_->listen(*this);
  }
  void run_started(const model::Topology& topology) override {
    Base::run_started(topology);
    if (this->is_alone()) probe_->run_started(topology);
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    Base::received(packet, receiver);
    if (this->is_alone()) probe_->received(packet, receiver);
  }
  void transition(const model::Transition& fired) override {
    if (this->is_alone() && fired.descriptors == 0) {
      probe_->transition(fired);
    }
  }

 protected:
  [[nodiscard]] const ReceivedDescriptors& x() const { return probe_->x(); }
  [[nodiscard]] std::uint32_t lacking(std::uint32_t relation) const {
    return probe_->lacking(relation);
  }
  /// A reader that forgets has nothing; to be called before the run.
  void let_readers_forget() { probe_ = own_probe(true); }
  void took(const model::Packet& /*data*/, std::uint32_t /*fresh*/) override {}

 private:
  [[nodiscard]] std::shared_ptr<DataProbe> own_probe(bool forgets) {
    auto own = std::make_shared<DataProbe>(forgets);
    own->listen(*this);
    return own;
  }

  std::shared_ptr<DataProbe> probe_ = own_probe(false);
};

}  // namespace stormproof::props
