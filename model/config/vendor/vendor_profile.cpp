// The names of what a vendor's file can say, and which vendor a file is for.
#include "model/config/vendor/vendor_profile.hpp"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "model/config/vendor/any_case.hpp"
#include "model/config/vendor/cyclonedds_domain.hpp"

namespace stormproof::model::config::vendor {

const char* name_of(Vendor vendor) {
  return vendor == Vendor::fastdds ? "Fast DDS" : "Cyclone DDS";
}

const char* name_of(Effect effect) {
  constexpr std::array names{"knob", "none", "unmodelled", "outside", "unknown"};
  return names[static_cast<std::size_t>(effect)];
}

const char* name_of(Severity severity) {
  constexpr std::array names{"error", "warning", "note"};
  return names[static_cast<std::size_t>(severity)];
}

std::string_view default_base(Vendor vendor) {
  return vendor == Vendor::fastdds ? "fastdds-2.6.11" : "cyclonedds-0.10";
}

std::optional<Vendor> vendor_of(const XmlElement& root) {
  constexpr std::array<std::string_view, 3> fastdds_roots{"dds", "profiles", "participant"};
  if (std::ranges::find(fastdds_roots, root.name) != fastdds_roots.end()) return Vendor::fastdds;
  if (is_same_word(root.name, "CycloneDDS")) return Vendor::cyclonedds;
  return std::nullopt;
}

Result<VendorProfile> read_vendor_profile(const XmlElement& root, const Selection& selection) {
  const std::optional<Vendor> vendor = vendor_of(root);
  if (!vendor) {
    return error_at(root.place,
                    fmt::format("root element <{}>; expected <dds>, <profiles> or <participant> of "
                                "Fast DDS, or <CycloneDDS>",
                                root.name));
  }
  return *vendor == Vendor::fastdds ? read_fastdds_profile(root, selection)
                                    : read_cyclonedds_profile(root, selection);
}

namespace {

/// The element that the library reads: Fast DDS looks for <dds>, then for <profiles>; Cyclone DDS
/// takes the first, and in CYCLONEDDS_URI groups without a root as well.
XmlElement root_of(XmlDocument& document) {
  std::vector<XmlElement>& roots = document.roots;
  for (const char* name : {"dds", "profiles", "participant"}) {
    const auto found = std::ranges::find(roots, name, &XmlElement::name);
    if (found != roots.end()) return std::move(*found);
  }
  const bool is_domain = is_same_word(roots.front().name, "Domain");
  if (!is_domain && !is_cyclone_group(roots.front().name)) return std::move(roots.front());
  document.oddities.push_back({XmlOddity::no_root, roots.front().place});
  XmlElement root;
  root.place = root.text_place = roots.front().place;
  XmlElement domain = root;
  root.name = "CycloneDDS";
  domain.name = "Domain";
  (is_domain ? root : domain).children = std::move(roots);
  if (!is_domain) root.children.push_back(std::move(domain));
  return root;
}

/// Whether the vendor's library takes it only in an environment variable.
bool is_inline(XmlOddity oddity) {
  return oddity == XmlOddity::nameless_end || oddity == XmlOddity::missing_end ||
         oddity == XmlOddity::no_root;
}

Remark remark_on(const XmlDocument::Odd& one, Vendor vendor, bool is_fragment) {
  const auto say = [&](Severity severity, const char* rule, std::string message, std::string hint) {
    return Remark{severity, std::string{"xml."} + rule, one.place, std::move(message),
                  std::move(hint)};
  };
  const std::string library = name_of(vendor);
  switch (one.oddity) {
    case XmlOddity::hyphens:
      return say(Severity::note, "not-well-formed",
                 "\"--\" inside of a comment is no XML; " + library + " takes it",
                 "editors and other programs refuse the file");
    case XmlOddity::blanks:
      return say(Severity::note, "not-well-formed",
                 "white space before <?xml is no XML; " + library + " takes it",
                 "editors and other programs refuse the file");
    case XmlOddity::second_root:
      if (vendor == Vendor::cyclonedds && is_fragment) {
        return say(Severity::note, "fragment", "one more element without a root around it",
                   "Cyclone DDS reads one after the other");
      }
      return say(Severity::note, "second-root",
                 "an element beside the root element; " + library + " does not read it",
                 "XML has one root element: other programs refuse the file");
    case XmlOddity::nameless_end:
      return say(Severity::warning, "inline-only",
                 "</> is taken in CYCLONEDDS_URI itself; in a file Cyclone DDS refuses it",
                 "write the name of the element");
    case XmlOddity::missing_end:
      return say(Severity::warning, "inline-only",
                 "ends are missing, which is taken in CYCLONEDDS_URI itself; in a file Cyclone DDS "
                 "refuses it",
                 "close every element");
    case XmlOddity::no_root:
      break;
  }
  return say(Severity::warning, "inline-only",
             "no <CycloneDDS> around it, which is taken in CYCLONEDDS_URI itself; a file of it is "
             "refused",
             "write <CycloneDDS><Domain Id=\"any\">…</Domain></CycloneDDS>");
}

}  // namespace

std::optional<Vendor> vendor_of(const XmlDocument& document) {
  XmlDocument copy = document;
  return vendor_of(root_of(copy));
}

std::vector<std::string> domains_of(XmlDocument document) {
  const XmlElement root = root_of(document);
  if (vendor_of(root) != Vendor::cyclonedds) return {};
  return domain_ids(root);
}

Result<VendorProfile> read_vendor_profile(XmlDocument document, const Selection& selection) {
  const XmlElement root = root_of(document);
  const bool is_fragment =
      !document.oddities.empty() && document.oddities.back().oddity == XmlOddity::no_root;
  const auto is_odd_end = [](const XmlDocument::Odd& one) { return is_inline(one.oddity); };
  if (vendor_of(root) != Vendor::cyclonedds && std::ranges::any_of(document.oddities, is_odd_end)) {
    return *std::move(document.not_well_formed);
  }
  Result<VendorProfile> profile = read_vendor_profile(root, selection);
  if (!profile || document.oddities.empty()) return profile;
  std::vector<Remark> remarks;
  for (const XmlDocument::Odd& one : document.oddities) {
    if (document.is_variable && is_inline(one.oddity)) continue;
    remarks.push_back(remark_on(one, profile->vendor, is_fragment));
  }
  profile->remarks.insert(profile->remarks.begin(), remarks.begin(), remarks.end());
  return profile;
}

}  // namespace stormproof::model::config::vendor
