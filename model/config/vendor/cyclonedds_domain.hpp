// The walk over the elements of one Cyclone DDS domain: every name is looked up in the table of
// settings, every value is read by its type, and what the table has not becomes a remark.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/vendor/cyclonedds_settings.hpp"

namespace stormproof::model::config::vendor {

/// Whether the library has a group (or an old name of one) like this in a Domain.
[[nodiscard]] bool is_cyclone_group(std::string_view name);

/// The ids of the Domain elements below a root, each once, without "any".
[[nodiscard]] std::vector<std::string> domain_ids(const XmlElement& root);

/// Collects settings and remarks of one Domain element after the other.
class CycloneDomainReader {
 public:
  CycloneDomainReader(VendorProfile& profile, CycloneSettings& settings)
      : profile_{profile}, settings_{settings}, version_{settings.version} {}

  /// The contents of a Domain element, or of what stands for one.
  void read(const XmlElement& domain);
  /// An element below `parent`, a path in the spelling of the table.
  void read_element(const XmlElement& element, std::string_view parent);

  /// The first value that the library refuses.
  [[nodiscard]] const std::optional<InputError>& failure() const { return failure_; }

 private:
  void remark(Severity severity, std::string_view rule, const Place& place, std::string message,
              std::string hint = {});
  void fail(const Place& place, std::string message);
  void resolve_alias(std::string& path, const XmlElement& element);
  void read_attributes(const XmlElement& element, std::string_view path);
  void read_text(const XmlElement& element, std::string_view path);
  /// With the values of environment variables; nothing, and a remark, if they have none.
  std::optional<std::string> expanded(std::string_view path, const std::string& text,
                                      const Place& place);
  void read_value(std::string_view path, const std::string& written, const Place& place);
  void read_opaque(const XmlElement& element, const CycloneGroup& group);
  void refuse(const Place& place, const std::string& path, std::string_view parent,
              const std::string& name, bool is_attribute);
  void keep(CycloneReading reading);

  VendorProfile& profile_;
  CycloneSettings& settings_;
  CycloneVersion version_;
  std::set<std::string_view> seen_;  ///< in this Domain
  std::optional<InputError> failure_;
  std::size_t hints_left_ = 1000;  ///< a hint compares with every name there is
};

}  // namespace stormproof::model::config::vendor
