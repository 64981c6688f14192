// The classes have the words of the model; the others have theirs here.
#include "checker/experiments/statistics/measure.hpp"

namespace stormproof::statistics {

namespace {

constexpr std::array<const char*, 2> first_names{"completion", "messages"};
constexpr std::array<const char*, 9> last_names{
    "user_control", "lookup",          "amplification",   "backlog",       "recovery",
    "lost_pairs",   "messages_before", "messages_during", "messages_after"};
constexpr std::array<const char*, 9> last_words{
    "user control", "lookups",         "amplification",   "highest backlog",        "recovery",
    "lost pairs",   "messages before", "messages during", "messages until recovery"};

bool is_class(Measure measure) {
  return index_of(measure) >= 2 && index_of(measure) < discovery_measure_count;
}
model::MessageClass class_of(Measure measure) {
  return model::message_classes[index_of(measure) - 2];
}

}  // namespace

const char* name_of(Measure measure) {
  if (is_class(measure)) return model::name_of(class_of(measure));
  return index_of(measure) < 2 ? first_names[index_of(measure)]
                               : last_names[index_of(measure) - discovery_measure_count];
}

const char* words_of(Measure measure) {
  if (is_class(measure)) return model::words_of(class_of(measure));
  return index_of(measure) < 2 ? first_names[index_of(measure)]
                               : last_words[index_of(measure) - discovery_measure_count];
}

}  // namespace stormproof::statistics
