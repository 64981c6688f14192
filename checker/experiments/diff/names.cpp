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
    case Relation::elsewhere:
      return "elsewhere";
    case Relation::unmodelled:
      return "unmodelled";
    case Relation::different:
      return "different";
  }
  return "";
}

const char* unit_of(Measure measure) {
  if (measure == Measure::completion) return "ns";
  if (measure == Measure::backlog) return "packets";
  return "";
}

}  // namespace stormproof::diff
