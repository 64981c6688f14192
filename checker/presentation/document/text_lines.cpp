// Breaks at spaces, wherever spans begin and end. A badge is one word.
#include "checker/presentation/document/text_lines.hpp"

#include <limits>

#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

struct Word {
  std::string shown;
  std::size_t columns = 0;
};

std::string_view colour_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "32";
    case Tone::info:
      return "36";
    case Tone::warn:
      return "33";
    case Tone::bad:
      return "1;31";
    case Tone::plain:
      break;
  }
  return "1";
}

std::string_view colour_of(const Span& span) {
  switch (span.kind) {
    case Span::Kind::code:
      return "36";
    case Span::Kind::strong:
      return "1";
    case Span::Kind::badge:
      return colour_of(span.tone);
    case Span::Kind::plain:
    case Span::Kind::link:
      break;
  }
  return "";
}

std::string coloured(std::string_view text, std::string_view colour) {
  if (text.empty() || colour.empty()) return std::string{text};
  return "\x1b[" + std::string{colour} + "m" + std::string{text} + "\x1b[0m";
}

std::vector<Word> words_of(const Text& text, bool colours) {
  std::vector<Word> words;
  bool begins = true;
  const auto add = [&](std::string_view part, const Span& span) {
    if (part.empty()) return;
    if (begins) words.emplace_back();
    begins = false;
    words.back().shown += coloured(part, colours ? colour_of(span) : "");
    words.back().columns += columns(part);
  };
  for (const Span& span : text.spans()) {
    const std::string all = valid_text(shown_text(span));
    std::string_view rest = all;
    if (span.kind == Span::Kind::badge) {
      add(rest, span);
      continue;
    }
    while (!rest.empty()) {
      const std::size_t space = std::min(rest.find_first_of(" \n\t"), rest.size());
      add(rest.substr(0, space), span);
      if (space < rest.size()) begins = true;
      rest.remove_prefix(std::min(space + 1, rest.size()));
    }
  }
  return words;
}

}  // namespace

std::string shown_text(const Span& span) {
  if (span.kind != Span::Kind::badge) return span.text;
  const std::string_view sign = span.sign.empty() ? sign_of(span.tone) : span.sign;
  return sign.empty() ? span.text : std::string{sign} + " " + span.text;
}

std::string emphasised(std::string_view words, Tone tone, bool colours) {
  return colours ? coloured(words, tone == Tone::plain ? "1" : colour_of(tone))
                 : std::string{words};
}

std::vector<TextLine> broken(const Text& text, std::size_t width, bool colours) {
  std::vector<TextLine> lines(1);
  for (const Word& word : words_of(text, colours)) {
    if (lines.back().columns > 0 && lines.back().columns + 1 + word.columns > width) {
      lines.emplace_back();
    }
    TextLine& line = lines.back();
    if (line.columns > 0) {
      line.shown += ' ';
      ++line.columns;
    }
    line.shown += word.shown;
    line.columns += word.columns;
  }
  return lines;
}

TextLine unbroken(const Text& text, bool colours) {
  return broken(text, std::numeric_limits<std::size_t>::max() / 2, colours).front();
}

}  // namespace stormproof::report
