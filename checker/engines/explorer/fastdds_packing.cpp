// What Fast DDS's rules (fsm/composition/fastdds.hpp) leave to a host, for a default participant's
// nine publications, of which the last ones may be created after the match, and its eight
// subscriptions. What is sent at once by one writer to the same readers is one message, as long as
// there is room. Piggybacked HEARTBEATs are left out, because they depend on everything that the
// participant sends.
#include <bit>
#include <utility>

#include "checker/engines/explorer/packing.hpp"
#include "checker/engines/explorer/rule_runner.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::explorer {
namespace {

class FastDdsPacking final : public Packing {
 public:
  using Packing::Packing;

  [[nodiscard]] unsigned descriptors(model::Stream stream) const override {
    return stream == model::Stream::pub ? model::fastdds::default_publications
                                        : model::fastdds::default_subscriptions;
  }
  Specialised::Action action(std::string_view step) override {
    if (step.starts_with("Pack ")) {
      return [this](RuleRunner& w, const Specialised::Call& call) {
        pack(w, w.emitted_by(call.contract));
      };
    }
    if (!step.starts_with("Flush ")) return {};
    return [this](RuleRunner& w, const auto&) {
      if (message_ != 0) flush(w);
    };
  }

 private:
  /// The descriptor, which goes to these.
  void pack(RuleRunner& w, const std::vector<Slot>& each) {
    const Members it = member(w.descriptor());
    unsigned served = 0;
    for (const Slot& packet : each) served |= 1U << packet.relation;
    const std::int64_t added =
        model::fastdds::timestamp_bytes +
        model::fastdds::submessage_bytes(running().dds, model::streams[w.writer()], w.descriptor());
    const bool fits = served == served_ && (message_ & it) == 0 &&
                      bytes_ + added <= sedp().grouping_limit_bytes.count();
    if (message_ != 0 && !fits) flush(w);
    if (message_ == 0) {
      bytes_ = model::fastdds::message_header_bytes +
               (std::has_single_bit(served) ? model::fastdds::destination_bytes : 0);
    }
    served_ = served;
    message_ |= it;
    bytes_ += added;
    for (const Slot& packet : each) {
      w.note_generated(packet.relation, it, packet.has(Slot::from_repair));
    }
  }
  void flush(RuleRunner& w) {
    const Members members = std::exchange(message_, Members{0});
    for (unsigned left = served_; left != 0; left &= left - 1) {
      const auto relation = static_cast<std::uint8_t>(std::countr_zero(left));
      mark_left(w.frame(), relation, members);
      w.send({What::data, 0, members, 0, relation});
    }
  }

  // The message that is open; between events none is.
  Members message_ = 0;     ///< what it carries
  unsigned served_ = 0;     ///< in which relations it goes, one bit each
  std::int64_t bytes_ = 0;  ///< UDP payload so far
};

}  // namespace

std::unique_ptr<Packing> fastdds_packing(const model::Scenario& running, const Scope& scope) {
  return std::make_unique<FastDdsPacking>(running, scope);
}

}  // namespace stormproof::explorer
