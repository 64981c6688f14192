// The words that reports, policies and JSON share.
#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

const char* name_of(Judgment judgment) {
  switch (judgment) {
    case Judgment::better:
      return "better";
    case Judgment::same:
      return "same";
    case Judgment::worse:
      return "worse";
    case Judgment::regression:
      return "regression";
    case Judgment::unclear:
      return "unclear";
  }
  return "";
}

const char* name_of(Relation relation) {
  switch (relation) {
    case Relation::identical:
      return "identical";
    case Relation::equivalent:
      return "equivalent";
    case Relation::unmodelled:
      return "unmodelled";
    case Relation::different:
      return "different";
  }
  return "";
}

const char* name_of(Measure measure) {
  switch (measure) {
    case Measure::completion:
      return "completion";
    case Measure::messages:
      return "messages";
    case Measure::initial_data:
      return "initial_data";
    case Measure::repair_data:
      return "repair_data";
    case Measure::heartbeat:
      return "heartbeat";
    case Measure::acknack:
      return "acknack";
    case Measure::spdp_multicast:
      return "spdp_multicast";
    case Measure::spdp_unicast:
      return "spdp_unicast";
    case Measure::user_control:
      return "user_control";
    case Measure::amplification:
      return "amplification";
    case Measure::backlog:
      return "backlog";
  }
  return "";
}

const char* unit_of(Measure measure) {
  if (measure == Measure::completion) return "ns";
  if (measure == Measure::backlog) return "packets";
  return "";
}

}  // namespace stormproof::diff
