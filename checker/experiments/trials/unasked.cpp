// The words.
#include "checker/experiments/trials/unasked.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/presentation/text/numbers.hpp"

namespace stormproof::trials {

namespace {

std::vector<std::string> lacking(const Unasked& unasked) {
  std::vector<std::string> words;
  for (const Unasked::Fewer& one : unasked.fewer) {
    words.push_back(fmt::format("{} of {} {}", report::grouped(one.made),
                                report::grouped(one.wanted), one.what));
  }
  for (const std::string& what : unasked.left_out) words.push_back("no " + what);
  return words;
}

std::vector<std::string> cut(const Unasked& unasked) {
  std::vector<std::string> words;
  for (const Unasked::Cut& one : unasked.cuts) {
    words.push_back(fmt::format("{} {} at {} of simulated time", report::grouped(one.runs),
                                one.what, report::duration(one.at)));
  }
  return words;
}

}  // namespace

void Unasked::note(std::string what, std::size_t made, std::size_t wanted) {
  if (made < wanted) fewer.push_back({std::move(what), made, wanted});
}

std::vector<std::string> sentences_of(const Unasked& unasked) {
  std::vector<std::string> sentences = lacking(unasked);
  for (const std::string& words : cut(unasked)) sentences.push_back("cut: " + words);
  return sentences;
}

void add_unasked(report::Facts& facts, const Unasked& unasked) {
  if (const auto words = lacking(unasked); !words.empty()) {
    facts.rows.emplace_back("not asked",
                            fmt::format("to keep to --time: {}", fmt::join(words, "; ")));
  }
  if (const auto words = cut(unasked); !words.empty()) {
    facts.rows.emplace_back(
        "cut", fmt::format("{}: they take at least that long, which counts as not complete, and "
                           "their messages are those until then",
                           fmt::join(words, "; ")));
  }
}

}  // namespace stormproof::trials
