// The words of the progress line.
#include "checker/cli/session.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/streams.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/simulator.hpp"

namespace stormproof::cli {

void Session::note_interruption(report::Document& document) {
  if (!interrupted()) return;
  document.complete = false;
  document.tone = report::Tone::warn;
  document.exit_code = inconclusive;
  document.answer = report::Text{"INTERRUPTED; so far: "} + document.answer;
}

namespace {

/// Runs that tell how long the others take.
constexpr std::size_t first_runs = 8;

/// ", about 3 min left", once there are runs to tell it from.
std::string time_left(double seconds, std::size_t done, std::size_t all) {
  if (done < first_runs || all <= done) return {};
  const double left = seconds / static_cast<double>(done) * static_cast<double>(all - done);
  return left < 90 ? fmt::format(", about {:.0f} s left", left)
                   : fmt::format(", about {:.0f} min left", left / 60);
}

}  // namespace

/// Says once, after the first runs of what takes a while, about how long all takes: not everybody
/// has a line that shows progress.
void Session::estimate(double seconds, std::size_t done, std::size_t all) {
  constexpr double first_look = 5;
  const trials::Budget left = time();
  const double look = std::min(first_look, (seconds + left.left()) / 4);
  if (has_estimated_ || seconds < look || done < first_runs || done >= all) return;
  has_estimated_ = true;
  const double rest = seconds / static_cast<double>(done) * static_cast<double>(all - done);
  std::string words = fmt::format("stormproof: {} take about {:.0f} s here",
                                  report::plural(all, "run"), seconds + rest);
  if (rest > left.left()) {
    words += "; not all of them fit into --time";
  } else if (!left.is_limited()) {
    words += "; --time 60s plans for a minute, or stops after it, and says what is known";
  }
  say(words);
}

std::function<bool(std::size_t, std::size_t)> Session::on_runs() {
  return [this, started = seconds()](std::size_t done, std::size_t all) {
    const double passed = seconds() - started;
    estimate(passed, done, all);
    return proceed([&] {
      return fmt::format("{} of {} runs{}", report::grouped(done), report::grouped(all),
                         time_left(passed, done, all));
    });
  };
}

std::function<bool(std::string_view, std::size_t, std::size_t)> Session::on_study() {
  return [this, started = seconds()](std::string_view what, std::size_t done, std::size_t about) {
    const double passed = seconds() - started;
    estimate(passed, done, about);
    return proceed([&] {
      if (done == 0) return fmt::format("{}, {:.0f} s", what, seconds());
      return fmt::format("{}: {} of about {} runs{}", what, report::grouped(done),
                         report::grouped(about), time_left(passed, done, about));
    });
  };
}

std::function<bool(std::string_view)> Session::on_steps(std::string doing) {
  return [this, doing = std::move(doing)](std::string_view what) {
    return proceed([&] { return fmt::format("{}{}, {:.0f} s", doing, what, seconds()); });
  };
}

std::function<bool(const model::Progress&)> Session::on_simulation() {
  return [this](const model::Progress& progress) {
    return proceed([&] {
      const auto delivered = static_cast<double>(progress.required - progress.missing);
      return fmt::format("simulated {}, {} of descriptors delivered, {} events, {:.1f} M/s",
                         report::duration(progress.now),
                         report::percent(delivered, static_cast<double>(progress.required)),
                         report::grouped(progress.events),
                         static_cast<double>(progress.events) / seconds() / 1e6);
    });
  };
}

std::function<bool(std::uint64_t)> Session::on_packets() {
  return [this](std::uint64_t packets) {
    return proceed([&] { return report::grouped(packets) + " packets"; });
  };
}

}  // namespace stormproof::cli
