// What several verbs say of captures, as JSON.
#pragma once

#include "checker/evidence/capture/events.hpp"
#include "checker/presentation/json/type.hpp"

namespace stormproof::capture {

template <class V>
void describe(V& v, const CaptureInfo& capture) {
  v("name", capture.name);
  v("packets", capture.packets);
  v("datagrams", capture.datagrams);
  v("merged", capture.merged);
}

/// With one of each, as its parts name each other.
inline Conversation example_of(report::Type<Conversation>) {
  Conversation conversation;
  conversation.captures.emplace_back();
  conversation.datagrams.emplace_back();
  conversation.events.emplace_back();
  return conversation;
}

}  // namespace stormproof::capture
