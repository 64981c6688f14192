// The words of the progress line.
#include "checker/cli/session.hpp"

#include <fmt/core.h>

#include "checker/cli/exit_code.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "model/simulator.hpp"

namespace stormproof::cli {

void Session::note_interruption(report::Document& document) {
  if (!interrupted()) return;
  document.complete = false;
  document.tone = report::Tone::warn;
  document.exit_code = inconclusive;
  document.answer = report::Text{"INTERRUPTED; so far: "} + document.answer;
}

std::function<bool(std::size_t, std::size_t)> Session::on_runs() {
  return [this, started = seconds()](std::size_t done, std::size_t all) {
    return proceed([&] {
      std::string text = fmt::format("{} of {} runs", report::grouped(done), report::grouped(all));
      const double each = (seconds() - started) / static_cast<double>(done);
      if (done > 0)
        text += fmt::format(", about {:.0f} s left", static_cast<double>(all - done) * each);
      return text;
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
