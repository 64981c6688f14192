// Writing is the vendor's writer's; here the text is read again, so that no file leaves the program
// that says something else than what was measured.
#include "checker/experiments/tune/deploy.hpp"

#include <fmt/format.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/profile_files.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/config/vendor/xml_text.hpp"

namespace stormproof::tune {

using model::DdsProfile;
using model::config::InputError;
using model::config::Result;
using model::config::SpecPath;
namespace vendor = model::config::vendor;

namespace {

constexpr const char* written = "the written XML";
constexpr std::int64_t default_wmem_max = 212'992;  // of Linux

DdsProfile without_notes(DdsProfile profile) {
  profile.unmodelled.clear();
  return profile;
}

}  // namespace

Result<DdsProfile> read_back(const std::string& xml, const std::string& preset,
                             const SpecPath& specs) {
  const auto root = vendor::parse_xml(xml, written);
  if (!root) return root.error();
  const auto read = vendor::read_vendor_profile(*root, {"", preset});
  if (!read) return read.error();
  const auto resolved =
      model::config::resolve_profile(read->changes, model::config::SpecKind::dds, specs);
  if (!resolved) return resolved.error();
  return model::config::checked<DdsProfile>(resolved->tree);
}

Result<std::string> deployable(const Subject& subject, const DdsProfile& profile,
                               const std::string& comment, const SpecPath& specs) {
  DdsProfile settings = profile;
  settings.unmodelled = subject.base.unmodelled;  // what the model has not cannot be written
  auto xml =
      vendor::write_vendor_xml(subject.vendor, subject.preset, subject.base, settings, comment);
  if (!xml) return xml;
  auto again = read_back(*xml, subject.preset, specs);
  if (!again) return again.error();
  if (!profile.spdp.lease) again->spdp.lease.reset();  // raised with the period, if at all
  if (without_notes(*again) != without_notes(profile)) {
    return InputError{written, "does not give the profile that it was written for"};
  }
  return xml;
}

std::vector<std::string> prerequisites(const Subject& subject, const DdsProfile& profile) {
  std::vector<std::string> list;
  const std::int64_t buffer = profile.sedp.piggyback_threshold_bytes.count();
  const bool is_set = buffer != subject.base.sedp.piggyback_threshold_bytes.count();
  if (subject.vendor == vendor::Vendor::fastdds && is_set && buffer > default_wmem_max) {
    list.push_back(
        fmt::format("Linux grants a send buffer of at most net.core.wmem_max, usually {} bytes: "
                    "run 'sysctl -w net.core.wmem_max={}' on every host, and put it into "
                    "/etc/sysctl.d.",
                    default_wmem_max, buffer));
  }
  if (subject.vendor == vendor::Vendor::fastdds && is_set) {
    list.emplace_back(
        "The buffer needs a UDP transport of its own and useBuiltinTransports false, so user data "
        "between processes of one host no longer goes through shared memory.");
  }
  const model::SpdpProfile& spdp = profile.spdp;
  const model::SpdpProfile& before = subject.base.spdp;
  if (spdp.period > before.period || spdp.startup_period > before.startup_period ||
      spdp.startup_announcements < before.startup_announcements) {
    list.emplace_back(
        "It announces participants more rarely. That suits the starts and the losses of this "
        "scenario; a participant that is missed by all announcements is found later.");
  }
  for (const auto& [setting, effect] : profile.unmodelled) {
    if (subject.base.unmodelled.contains(setting)) continue;
    list.push_back(
        fmt::format("Your profile also sets {}, which the model has not: carry it over "
                    "by hand. ({})",
                    setting, effect));
  }
  return list;
}

std::vector<std::string> how_to_load(vendor::Vendor vendor, const std::string& file) {
  if (vendor == vendor::Vendor::cyclonedds) {
    return {"export RMW_IMPLEMENTATION=rmw_cyclonedds_cpp",
            fmt::format("export CYCLONEDDS_URI=file://$PWD/{}", file)};
  }
  return {"export RMW_IMPLEMENTATION=rmw_fastrtps_cpp",
          fmt::format("export FASTRTPS_DEFAULT_PROFILES_FILE=$PWD/{}  # Fast DDS 2", file),
          fmt::format("export FASTDDS_DEFAULT_PROFILES_FILE=$PWD/{}   # Fast DDS 3", file)};
}

std::string reference_to(const std::string& file, const Subject& subject) {
  if (subject.preset == vendor::default_base(subject.vendor)) return file;
  return file + "@" + subject.preset;
}

}  // namespace stormproof::tune
