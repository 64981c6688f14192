// safety.ack-implies-received: a descriptor that the writer takes as acknowledged (A) has been
// received (X = 1). X never goes back, so it is enough to look when a descriptor enters A; and that
// holds for both implementations, though Fast DDS's writer may leave A again.
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

namespace {

class Acknowledgments : public Observer {
 public:
  Acknowledgments() : Observer{"safety.ack-implies-received"} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    received_.reset(topology);
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::MachineRef& machine, std::string_view event, std::string_view,
                  std::string_view after, std::uint32_t first_word,
                  std::uint64_t descriptors) override {
    if (const model::Packet* data = received_.taken(machine, event)) received_.take(*data);
    if (descriptors == 0 || after != "A") return;
    acknowledged_ += static_cast<std::uint64_t>(std::popcount(descriptors));
    const std::uint64_t wrong = descriptors & ~received_.word(machine.subject, first_word);
    if (wrong == 0) return;
    const auto d = 64 * first_word + static_cast<std::uint32_t>(std::countr_zero(wrong));
    object_now("The writer takes " + descriptor_text(topology(), machine.subject, d) +
               " as acknowledged at " + time_text(now()) + ", but it has not been received there.");
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(acknowledged_) + " descriptors became acknowledged."};
  }

 private:
  ReceivedDescriptors received_;
  std::uint64_t acknowledged_ = 0;
};

}  // namespace

MonitorPtr watch_acknowledgments(const model::Scenario&) { return attentive<Acknowledgments>(); }

}  // namespace stormproof::props
