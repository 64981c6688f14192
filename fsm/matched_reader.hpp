// A reader as a writer of Cyclone DDS sees it: whether it is matched, and whether it has replied,
// that is sent an ACKNACK that asks for nothing and acknowledges all that it had acknowledged
// before. A writer sends HEARTBEATs until every reader has.
// Source: specs/guide/cyclone.md, "ACKNACK".
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct MatchedReaderIo {
  template <class D>
  struct Input {
    typename D::Bool accepted{};  ///< its count is new, or the last one is long ago
    typename D::Bool replies{};   ///< it asks for nothing and takes nothing back
  };
  template <class D>
  struct Output {
    typename D::Bool matched{};  ///< the reader is new
    typename D::Bool take{};     ///< the ACKNACK counts
  };
};

namespace matched_reader {

struct Unmatched : State {};
struct Silent : State {};
struct Replied : State {};

struct Opened : Event<MatchedReaderIo> {};
struct AckNackReceived : Event<MatchedReaderIo> {};

struct Accepted : Holds<Accepted> {
  static constexpr auto& flag(auto& in) { return in.accepted; }
};
struct Replies : Holds<Replies> {
  static constexpr auto& flag(auto& in) { return in.replies; }
};

struct Match : Sets<Match> {
  static constexpr auto& flag(auto& out) { return out.matched; }
};
struct Take : Sets<Take> {
  static constexpr auto& flag(auto& out) { return out.take; }
};

using Transitions = Table<Row<Unmatched, Opened, Silent, Match>,
                          Row<Silent, AckNackReceived, Replied, Take, All<Accepted, Replies>>,
                          Row<Silent, AckNackReceived, Silent, Take, All<Accepted, Not<Replies>>>,
                          Row<Replied, AckNackReceived, Replied, Take, Accepted>>;

}  // namespace matched_reader

struct MatchedReader : FrontEnd<MatchedReader> {
  using Io = MatchedReaderIo;
  using initial_state = matched_reader::Unmatched;
  using transition_table = matched_reader::Transitions;
};

}  // namespace stormproof::fsm
