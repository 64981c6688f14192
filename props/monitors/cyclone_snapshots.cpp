// safety.snapshot of Cyclone DDS's reader: an ACKNACK is made when its timer fires; then its base
// is the first sample that is missing, and it lists nothing, or all that is known to exist and is
// missing; a pre-emptive one claims nothing. It leaves later, when the thread gets to it, and
// arrives as it was made, however much has come in the meantime.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/descriptors.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/relation_words.hpp"
#include "props/monitors/submessage_observer.hpp"

namespace stormproof::props {

namespace {

class CycloneSnapshots : public SubmessageObserver<> {
 public:
  CycloneSnapshots() : SubmessageObserver{"safety.snapshot"} {}

  void run_started(const model::Topology& topology) override {
    SubmessageObserver::run_started(topology);
    relations_.assign(numbers().relation_count(), {});
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} ACKNACKs reached their writer as they were made.", compared_)};
  }

 private:
  using Kind = model::Submessage::Kind;

  struct View {
    std::uint32_t base = 0;  ///< samples that lie below the first one that is missing
    Descriptors lacking;     ///< samples that are known to exist, and missing
    bool operator==(const View&) const = default;
  };
  struct Relation {
    Descriptors received;     ///< samples
    std::uint32_t known = 0;  ///< how many samples are known to exist
    std::vector<View> made;   ///< when the timer fired, since the last ACKNACK that has left
    std::vector<std::pair<std::int64_t, View>> sent;  ///< with their counts, the last one last
  };

  static View said(const model::Submessage& acknack) {
    return {acknack.sample, Descriptors{acknack.bitmap}};
  }

  void timer_fired(std::uint32_t relation) override {
    Relation& reader = relations_[relation];
    View view;
    view.base = reader.received.first_gap();
    for (std::uint32_t k = view.base / 64; 64 * k < reader.known; ++k) {
      view.lacking.add(k, RelationWords::below(reader.known, k) & ~reader.received.word(k));
    }
    reader.made.push_back(std::move(view));
  }
  void heard(std::uint32_t relation, const model::Submessage& taken,
             const States& states) override {
    Relation& reader = relations_[relation];
    if (taken.kind == Kind::acknack) return compare(relation, reader, taken);
    if (states.before == "Closed") return;
    if (taken.kind == Kind::heartbeat) reader.known = std::max(reader.known, taken.sample);
    if (taken.kind != Kind::data || states.before == "Unheard") return;
    reader.known = std::max(reader.known, taken.sample + 1);
    reader.received.add(taken.sample);
  }
  void sent(const model::Packet& packet, const model::Submessage& acknack) override {
    if (acknack.kind != Kind::acknack) return;
    const std::uint32_t relation = relation_answered(packet, acknack);
    Relation& reader = relations_[relation];
    View leaving = said(acknack);
    const auto is_said = [&](const View& view) {
      if (acknack.initial) return leaving == View{};
      return view.base == leaving.base && (leaving.lacking.empty() || view == leaving);
    };
    const auto view = std::ranges::find_if(reader.made, is_said);
    if (view == reader.made.end()) {
      object_to(relation, "is not what it knew and lacked when it was made");
      reader.made.clear();
    } else {
      reader.made.erase(reader.made.begin(), view + 1);
    }
    reader.sent.emplace_back(acknack.count, std::move(leaving));
  }
  void compare(std::uint32_t relation, Relation& reader, const model::Submessage& acknack) {
    const auto is_it = [&](const auto& one) { return one.first == acknack.count; };
    const auto sent = std::find_if(reader.sent.rbegin(), reader.sent.rend(), is_it);  // the latest
    if (sent == reader.sent.rend() || sent->second != said(acknack)) {
      return object_to(relation, "arrives as another one than was sent");
    }
    ++compared_;
  }
  void object_to(std::uint32_t relation, const char* reason) {
    const model::Pair& ends = numbers().ends(relation);
    object_now(fmt::format("At {} an ACKNACK of participant {} to {} of participant {} {}.",
                           time_text(now()), ends.destination,
                           model::cyclone::name_of_writer(relation % numbers().stride()),
                           ends.source, reason));
  }

  std::vector<Relation> relations_;
  std::uint64_t compared_ = 0;
};

}  // namespace

MonitorPtr watch_acknack_samples() { return attentive<CycloneSnapshots>(); }

}  // namespace stormproof::props
