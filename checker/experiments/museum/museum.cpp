// One exhibit after the other.
#include "checker/experiments/museum/museum.hpp"

#include <algorithm>

#include "checker/experiments/museum/certified.hpp"

namespace stormproof::museum {

namespace {

Found decided(const Exhibit& exhibit, const Variant& variant, const std::function<bool()>& go_on) {
  Found found = search(exhibit, variant, go_on);
  if (variant.expected == props::VerdictKind::proved) certify(found, exhibit, variant, go_on);
  return found;
}

}  // namespace

bool ShownExhibit::as_expected() const {
  const auto is = [](const Found& found, const Variant& variant) {
    return found.verdict == variant.expected;
  };
  return is(before, exhibit.before) && is(after, exhibit.after) &&
         std::ranges::equal(decoys, exhibit.decoys, is);
}

bool Report::as_expected() const {
  return finished && std::ranges::all_of(exhibits, &ShownExhibit::as_expected);
}

Report show(std::vector<Exhibit> exhibits, const std::function<bool()>& go_on) {
  Report report;
  const auto still = [&] {
    report.finished = report.finished && go_on();
    return report.finished;
  };
  for (Exhibit& exhibit : exhibits) {
    ShownExhibit& shown = report.exhibits.emplace_back();
    shown.exhibit = std::move(exhibit);
    shown.before = decided(shown.exhibit, shown.exhibit.before, still);
    shown.after = decided(shown.exhibit, shown.exhibit.after, still);
    for (const Variant& decoy : shown.exhibit.decoys) {
      shown.decoys.push_back(decided(shown.exhibit, decoy, still));
    }
  }
  return report;
}

}  // namespace stormproof::museum
