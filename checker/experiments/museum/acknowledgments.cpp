// safety.ack-implies-received and safety.ack-stable, of rules whose writer may also leave A. What
// was acknowledged before the run is not judged.
#include <bit>

#include <fmt/core.h>

#include "checker/experiments/museum/claims.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::museum {

namespace {

class Acknowledgments final : public ClaimMonitor {
 public:
  explicit Acknowledgments(bool stable)
      : ClaimMonitor{stable ? "safety.ack-stable" : "safety.ack-implies-received"},
        stable_{stable} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    received_.reset(topology);
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::MachineRef& machine, std::string_view event, std::string_view before,
                  std::string_view after, std::uint32_t first_word,
                  std::uint64_t descriptors) override {
    if (const model::Packet* data = received_.taken(machine, event)) received_.take(*data);
    if (received_.is_new(machine, event)) received_.lose(machine.subject);
    const bool is_repair =
        machine.machine == "ReopeningRepair" || machine.machine == "DescriptorRepair";
    const bool has_forgotten = event == "Renewed";  // the writer has: it believes nothing any more
    if (!is_repair || has_forgotten || events() == 0 || before == after) return;
    const std::uint64_t has = received_.word(machine.subject, first_word);
    if (!stable_ && after == "A") judge(machine.subject, first_word, descriptors & ~has);
    if (stable_ && before == "A") judge(machine.subject, first_word, descriptors & has);
  }

 private:
  void judge(std::uint32_t relation, std::uint32_t first_word, std::uint64_t wrong) {
    if (wrong == 0) return;
    const auto d = 64 * first_word + static_cast<std::uint32_t>(std::countr_zero(wrong));
    const std::string what = props::descriptor_text(topology(), relation, d);
    object_now(stable_
                   ? fmt::format("The writer takes back the acknowledgment of {}, which has it "
                                 "and has not forgotten it.",
                                 what)
                   : fmt::format("The writer takes {} for received; its reader lacks it.", what));
  }

  const bool stable_;
  props::ReceivedDescriptors received_;
};

}  // namespace

std::unique_ptr<ClaimMonitor> watch_acknowledgments(bool stable) {
  return std::make_unique<Acknowledgments>(stable);
}

}  // namespace stormproof::museum
