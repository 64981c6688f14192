// The readers of foreign input as fuzz targets: any bytes in, an error or a valid value out, and
// what is valid has to stand further checks. libFuzzer calls them (libfuzzer_main.cpp), and so does
// a test that needs no clang, with the seed corpus (corpus_test.cpp). A target whose check fails
// ends the program.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace stormproof::fuzzing {

/// What a reader made of its input.
enum class Outcome : std::uint8_t { refused, accepted };

/// A packet capture, or a single RTPS message.
Outcome capture(std::string_view input);
/// A scenario file.
Outcome scenario(std::string_view input);
/// A profile file; it may build on those of specs/.
Outcome dds_profile(std::string_view input);
Outcome wireless_profile(std::string_view input);
/// `--set` arguments of a shipped scenario, one a line.
Outcome overrides(std::string_view input);
/// A duration, rate, count or fraction; accepted if it is at least one of them.
Outcome quantities(std::string_view input);
/// A file of a DDS vendor: Fast DDS or Cyclone DDS XML.
Outcome vendor_xml(std::string_view input);
/// A trace or a counterexample, to be replayed.
Outcome trace(std::string_view input);

struct Target {
  std::string_view name;  ///< also of its folder in corpus/
  Outcome (*run)(std::string_view);
};

inline constexpr std::array<Target, 8> targets{{{"capture", capture},
                                                {"scenario", scenario},
                                                {"dds_profile", dds_profile},
                                                {"wireless_profile", wireless_profile},
                                                {"overrides", overrides},
                                                {"quantities", quantities},
                                                {"trace", trace},
                                                {"vendor_xml", vendor_xml}}};

}  // namespace stormproof::fuzzing
