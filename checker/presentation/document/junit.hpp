// JUnit XML, the form in which CI systems take test results: one writer for all reports.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stormproof::report {

struct JUnitCase {
  enum class Outcome : std::uint8_t {
    passed,
    failed,  ///< it does not hold
    error    ///< nobody knows
  };
  std::string class_name;
  std::string name;
  double seconds = 0;
  Outcome outcome = Outcome::passed;
  std::string type;     ///< of a failure or an error: "violated"
  std::string message;  ///< of a failure or an error: one sentence
  std::string text;     ///< everything else
};

struct JUnitSuite {
  std::string name;
  double seconds = 0;
  std::vector<JUnitCase> cases;
  std::string notes{};  ///< about all of them; may be empty
};

[[nodiscard]] std::string to_xml(const JUnitSuite& suite);

}  // namespace stormproof::report
