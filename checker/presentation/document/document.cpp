// The running text of documents, and their blocks.
#include "checker/presentation/document/document.hpp"

namespace stormproof::report {

Blocks::Blocks() = default;
Blocks::Blocks(std::initializer_list<Block> blocks) : vector{blocks} {}
Blocks::Blocks(const Blocks& other) = default;
Blocks::Blocks(Blocks&& other) noexcept = default;
Blocks& Blocks::operator=(const Blocks& other) = default;
Blocks& Blocks::operator=(Blocks&& other) noexcept = default;
Blocks::~Blocks() = default;

Text::Text(std::string plain) {
  if (!plain.empty()) spans_.push_back({Span::Kind::plain, std::move(plain)});
}

Text::Text(std::string_view plain) : Text{std::string{plain}} {}

Text::Text(const char* plain) : Text{std::string{plain}} {}

Text::Text(Span span) { spans_.push_back(std::move(span)); }

Text& Text::operator+=(Text more) {
  for (Span& span : more.spans_) spans_.push_back(std::move(span));
  return *this;
}

std::string Text::plain() const {
  std::string text;
  for (const Span& span : spans_) text += span.text;
  return text;
}

Text code(std::string_view text) { return Text{Span{Span::Kind::code, std::string{text}}}; }

Text strong(std::string_view text) { return Text{Span{Span::Kind::strong, std::string{text}}}; }

Text badge(Tone tone, std::string_view word, std::string_view sign) {
  return Text{Span{Span::Kind::badge, std::string{word}, {}, tone, std::string{sign}}};
}

Text link(std::string_view text, std::string_view target) {
  return Text{Span{Span::Kind::link, std::string{text}, std::string{target}}};
}

std::string_view sign_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "✓";
    case Tone::info:
      return "≈";
    case Tone::warn:
      return "?";
    case Tone::bad:
      return "✗";
    case Tone::plain:
      break;
  }
  return "";
}

Location::Location(const model::config::Place& place, std::string text)
    : line{place.line}, column{place.column}, message{std::move(text)} {
  if (place.source != nullptr && place.line > 0) file = *place.source;
}

}  // namespace stormproof::report
