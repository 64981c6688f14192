// The parts that HTML reports are put together from. Every function that takes "plain" text escapes
// it; parameters called `html` are HTML already.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checker/presentation/document/document.hpp"
#include "model/dds_profile.hpp"
#include "props/verdict.hpp"

namespace stormproof::report::parts {

/// "✗ violated", in a coloured frame. Plain text.
[[nodiscard]] std::string badge(Tone tone, std::string_view words);
[[nodiscard]] Tone tone_of(props::VerdictKind kind);
/// "✗ violated".
[[nodiscard]] std::string signed_name(props::VerdictKind kind);

/// A framed paragraph at the top of a page: the first line in plain text, then HTML.
[[nodiscard]] std::string banner(Tone tone, std::string_view line, std::string_view html = {});

/// "<h2 id=…>": plain text.
[[nodiscard]] std::string heading(std::string_view words, std::string_view id);
[[nodiscard]] std::string paragraph_html(std::string_view plain, std::string_view classes = {});
[[nodiscard]] std::string bullets(std::span<const std::string> plain);
/// Folded; opened on paper.
[[nodiscard]] std::string details(std::string_view plain_summary, std::string_view html,
                                  bool open = false);
/// A text with its own line breaks.
[[nodiscard]] std::string preformatted(std::string_view plain);
[[nodiscard]] std::string code(std::string_view plain);

/// A table. Cells are HTML.
struct HtmlTable {
  std::string caption;            ///< plain; may be empty
  std::vector<std::string> head;  ///< plain
  std::string align;              ///< one letter a column: l, r, t (left, on one line)
  std::vector<std::vector<std::string>> rows;
  std::vector<bool> marked;       ///< rows in another colour; may be shorter
  bool stacked_on_paper = false;  ///< cells have long details, which get the whole width of a page
};
[[nodiscard]] std::string to_html(const HtmlTable& table);

/// A drawing that may be larger than the screen, with its caption (plain). `svg` is what `Drawings`
/// made of it.
[[nodiscard]] std::string drawing_html(std::string_view svg, std::string_view caption);

/// What the profile's vendor has and the model has not; nothing if there is no such setting.
[[nodiscard]] std::string unmodelled_html(const model::DdsProfile& profile,
                                          std::string_view profile_name);

}  // namespace stormproof::report::parts
