// What several verbs say of captures, as JSON.
#pragma once

#include "checker/evidence/capture/events.hpp"

namespace stormproof::capture {

template <class V>
void describe(V& v, const CaptureInfo& capture) {
  v("name", capture.name);
  v("packets", capture.packets);
  v("datagrams", capture.datagrams);
  v("merged", capture.merged);
}

}  // namespace stormproof::capture
