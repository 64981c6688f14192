// Fast DDS fills a message for those who asked. When another reader is matched before the message
// is sent, the writer's selection of readers is made anew, and the message goes to everybody, also
// to those who did not ask (StatefulWriter::matched_reader_add → update_reader_info, 2.6.11
// and 2.9.1). The model has one thread, so it has no such message; here it is admitted.
#pragma once

#include <set>
#include <vector>

#include "checker/evidence/conform/bounds.hpp"
#include "checker/evidence/conform/messages.hpp"

namespace stormproof::conform {

/// The DATA events of messages that may have gone to everybody because a reader was matched: the
/// first that a writer sent after the match, if it went to all its readers.
[[nodiscard]] std::set<std::size_t> sent_to_everybody(const Dialogue& dialogue,
                                                      const std::vector<Message>& messages,
                                                      const Bounds& bounds);

}  // namespace stormproof::conform
