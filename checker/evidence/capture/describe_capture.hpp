// What several verbs say of captures, as JSON.
#pragma once

#include "checker/evidence/capture/counting.hpp"
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

template <class V>
void describe(V& v, const LookupFigures& figures) {
  v("data", figures.data);
  v("distinct_samples", figures.samples);
  v("heartbeat", figures.heartbeat);
  v("acknack", figures.acknack);
  v("gap", figures.gap);
  v("data_bytes", figures.data_bytes);
}

template <class V>
void describe(V& v, const Remark& remark) {
  v("what", remark.what);
  v("count", remark.count);
  v("first_place", remark.first);
}

/// What asks for types, and answers.
struct Lookups {
  const Counting& counting;
};

template <class V>
void describe(V& v, const Lookups& all) {
  v("requests", all.counting.lookup_requests);
  v("replies", all.counting.lookup_replies);
  v("datagrams", all.counting.lookup_datagrams);
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
