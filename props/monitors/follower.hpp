// Who follows a run (props/monitors/followed.cpp): what happens starts rules, and what the run did
// since is held against what these do. The first difference is kept in words.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "fsm/composition/vocabulary.hpp"
#include "model/event.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"
#include "props/monitors/deeds.hpp"

namespace stormproof::props {

/// Runs the rules of what happens, and holds what the run did against them.
class Follower {
 public:
  Follower(const model::Scenario& scenario, const model::Topology& topology)
      : scenario_{scenario}, topology_{topology}, missing_{topology.required_deliveries()} {}
  virtual ~Follower() = default;

  /// What is done from now on is done at `now`.
  void happens_at(model::Nanoseconds now) { now_ = now; }
  [[nodiscard]] Deeds& deeds() { return deeds_; }
  // What starts rules: the deeds since then must be theirs.
  virtual void started() = 0;
  virtual void due(const model::Event& event) = 0;
  virtual void rescheduled(const model::Event& event, std::uint64_t insertion) = 0;
  virtual void received(const Message& message, std::uint32_t receiver,
                        model::Nanoseconds emitted) = 0;
  virtual void left_source(const Message&) {}
  /// Whether a packet that leaves its source starts one.
  [[nodiscard]] virtual bool follows_leaving(model::PacketKind) const { return false; }
  /// Nothing more follows from what has happened.
  void nothing_more() {
    site_ = {};
    if (!deeds_.empty()) differ("nothing more happens");
    deeds_.clear();
    begin("without a rule");
  }

  /// In words, what the run did that the rules do not say, or the other way around.
  [[nodiscard]] const std::optional<std::string>& difference() const { return difference_; }

  /// How many required deliveries have not happened.
  [[nodiscard]] std::uint64_t missing() const { return missing_; }

  [[nodiscard]] const model::DdsProfile& dds() const { return scenario_.dds; }
  [[nodiscard]] const model::Topology& topology() const { return topology_; }

 protected:
  void begin(std::string_view rule) {
    rule_ = rule;
    site_ = {};
  }
  /// `wanted` is what the rules say that happens next; the run did something else.
  void differ(const std::string& wanted) {
    if (difference_) return;
    std::string place{rule_};
    if (site_.line != 0) {
      place += fmt::format(" ({}:{})", site_.file.substr(site_.file.rfind('/') + 1), site_.line);
    }
    difference_ = fmt::format("{}: by the rules {}; in the run {}.", place, wanted,
                              deeds_.next_in_words(topology_));
  }
  /// The next deed if it is `same`; otherwise there is a difference, and null.
  template <class Kind, class Same>
  const Kind* next(const Kind& wanted, Same&& same) {
    if (difference_) return nullptr;
    const Kind* actual = deeds_.next<Kind>();
    if (actual == nullptr || !same(*actual)) {
      differ(said(wanted, topology_));
      return nullptr;
    }
    deeds_.take();
    return actual;
  }

  const model::Scenario& scenario_;
  const model::Topology& topology_;
  Deeds deeds_;
  model::Nanoseconds now_;
  std::uint64_t missing_;
  fsm::composition::Site site_;  ///< of the effect that is looked at

 private:
  std::string_view rule_;
  std::optional<std::string> difference_;
};

/// The follower of each composition, in a source file of its own.
[[nodiscard]] std::unique_ptr<Follower> follow(model::Of<fsm::composition::paper::Paper>,
                                               const model::Scenario& scenario,
                                               const model::Topology& topology);
[[nodiscard]] std::unique_ptr<Follower> follow(model::Of<fsm::composition::fastdds::FastDds>,
                                               const model::Scenario& scenario,
                                               const model::Topology& topology);
[[nodiscard]] std::unique_ptr<Follower> follow(model::Of<fsm::composition::cyclone::Cyclone>,
                                               const model::Scenario& scenario,
                                               const model::Topology& topology);
[[nodiscard]] std::unique_ptr<Follower> follow(model::Of<fsm::composition::server::FastDdsServer>,
                                               const model::Scenario& scenario,
                                               const model::Topology& topology);
/// Amended rules are not the paper's, and nobody follows them.
std::unique_ptr<Follower> follow(model::Of<fsm::composition::amended::Amended>,
                                 const model::Scenario&, const model::Topology&) = delete;
/// Of Fast DDS whose participants have a life.
[[nodiscard]] std::unique_ptr<Follower> follow_life(const model::Scenario& scenario,
                                                    const model::Topology& topology);

}  // namespace stormproof::props
