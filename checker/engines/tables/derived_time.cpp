// Deadlines, and the step in which time passes.
#include "checker/engines/tables/derived_time.hpp"

#include <algorithm>

namespace stormproof::tables {
namespace {

std::string pending_name(const std::string& timer) { return "pending " + timer; }
Expr certainly() { return smt::SymbolicContext::current().bool_val(true); }

}  // namespace

namespace timed {
std::string due(std::string_view timer) { return "due " + std::string{timer}; }
std::string earliest(std::string_view timer) { return "earliest " + std::string{timer}; }
std::string in_flight(std::string_view packet) { return "in flight " + std::string{packet}; }
std::string arrives(std::string_view packet) { return "arrives " + std::string{packet}; }
std::string sent(std::string_view packet) { return "emitted " + std::string{packet}; }
std::string first(std::string_view packet) { return "first " + std::string{packet}; }
std::string leaving(std::string_view packet) { return "leaving " + std::string{packet}; }
std::string leaves(std::string_view packet) { return "leaves " + std::string{packet}; }
}  // namespace timed

DerivedTime::DerivedTime(Derivation& derivation, Network network)
    : derivation_{derivation}, network_{std::move(network)} {
  derivation_.declare_count(timed::now);
  derivation_.declare_count(timed::limit);
}

void DerivedTime::declare_timer(const std::string& timer, bool counted) {
  timers_.push_back({timer, counted});
  derivation_.declare_count(timed::due(timer));
  if (!counted) derivation_.declare_count(timed::earliest(timer));
}

void DerivedTime::declare_packet(const std::string& packet, bool leaves) {
  for (const std::string& kind : kinds_of(packet)) {
    arriving_.push_back(kind);
    derivation_.declare(timed::in_flight(kind), false);
    derivation_.declare_count(timed::arrives(kind));
  }
  if (network_.exact) {
    derivation_.declare(timed::sent(packet), false);
    derivation_.declare_count(timed::first(packet));
  }
  if (!leaves) return;
  leaving_.push_back(packet);
  derivation_.declare(timed::leaving(packet), false);
  derivation_.declare_count(timed::leaves(packet));
}

std::vector<std::string> DerivedTime::kinds_of(const std::string& packet) const {
  const auto further = network_.further.find(packet);
  if (further == network_.further.end()) return {packet};
  return {packet, further->second};
}

Expr DerivedTime::is_pending(const Timer& timer) {
  const Expr& pending = derivation_.now(pending_name(timer.name));
  return timer.counted ? pending >= 1 : pending;
}

void DerivedTime::started(const std::string& name, const Expr& when, const Expr& due) {
  const Timer& timer = *std::ranges::find(timers_, name, &Timer::name);
  const Expr other = derivation_.now(timed::due(name));
  const Expr stays = is_pending(timer) && (timer.counted ? other >= due : other <= due);
  derivation_.assign(timed::due(name), when && !stays, due);
  if (timer.counted) return;
  const Expr first =
      !derivation_.now("started " + name) || due < derivation_.now(timed::earliest(name));
  derivation_.assign(timed::earliest(name), when && first, due);
}

void DerivedTime::fires(const std::string& name) {
  const Timer& timer = *std::ranges::find(timers_, name, &Timer::name);
  for (const std::string& packet : arriving_) {
    derivation_.require(!derivation_.now(timed::in_flight(packet)) ||
                        now() < derivation_.now(timed::arrives(packet)));
  }
  if (!timer.counted) return derivation_.require(now() >= derivation_.now(timed::earliest(name)));
  const Expr due = derivation_.now(timed::due(name));
  derivation_.require(now() <= due);
  derivation_.require(derivation_.now(pending_name(name)) >= 2 || now() == due);
}

void DerivedTime::look_at(const std::string& flag, const std::string& by, const Expr& when,
                          const Expr& end) {
  derivation_.assign(by, when, end);
  derivation_.assign(flag, when, certainly());
}

void DerivedTime::emitted_as(const std::string& kind, const Expr& when, const Says& says) {
  const Expr matters = (when && network_.matters(kind, says)).simplify();
  if (matters.is_false()) return;
  const Expr lost = network_.loses ? derivation_.unknown() : !certainly();
  const Expr looked_at = matters && !derivation_.now(timed::in_flight(kind));
  derivation_.assign(timed::limit, looked_at && lost, network_.lost(derivation_.now(timed::limit)));
  look_at(timed::in_flight(kind), timed::arrives(kind), looked_at && !lost, now() + network_.delay);
}

void DerivedTime::emitted(const std::string& packet, const Expr& when, const Says& says) {
  if (network_.exact) {
    look_at(timed::sent(packet), timed::first(packet),
            when && !derivation_.now(timed::sent(packet)), now() + network_.delay);
  }
  for (const std::string& kind : kinds_of(packet)) emitted_as(kind, when, says);
  if (std::ranges::find(leaving_, packet) == leaving_.end()) return;
  const Expr leaves = when && network_.matters_at_source(packet, says);
  look_at(timed::leaving(packet), timed::leaves(packet),
          leaves && !derivation_.now(timed::leaving(packet)), now() + network_.source);
}

void DerivedTime::arrived(const std::string& packet, const Says& says) {
  if (network_.exact) derivation_.require(now() >= derivation_.now(timed::first(packet)));
  for (const std::string& kind : kinds_of(packet)) {
    const Expr it = network_.matters(kind, says) && derivation_.unknown();
    derivation_.assign(timed::in_flight(kind), it, !certainly());
  }
}

void DerivedTime::left(const std::string& packet, const Says& says) {
  const Expr it = network_.matters_at_source(packet, says) && derivation_.unknown();
  derivation_.assign(timed::leaving(packet), it, !certainly());
}

void DerivedTime::derive_passing() {
  derivation_.begin();
  const Expr later = now() + 1 + derivation_.unknown_count();
  for (const Timer& timer : timers_) {
    derivation_.require(!is_pending(timer) || later <= derivation_.now(timed::due(timer.name)));
  }
  for (const std::string& packet : arriving_) {
    derivation_.require(!derivation_.now(timed::in_flight(packet)) ||
                        later <= derivation_.now(timed::arrives(packet)));
  }
  for (const std::string& packet : leaving_) {
    derivation_.require(!derivation_.now(timed::leaving(packet)) ||
                        later <= derivation_.now(timed::leaves(packet)));
  }
  derivation_.assign(timed::now, certainly(), later);
  derivation_.end(timed::passing);
}

}  // namespace stormproof::tables
