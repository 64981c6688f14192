// Small pieces of HTML.
#include "checker/presentation/document/html_parts.hpp"

#include <fmt/format.h>

#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/text/assumptions.hpp"

namespace stormproof::report::parts {

namespace {

using props::VerdictKind;

const char* class_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::info:
      return "info";
    case Tone::warn:
      return "warn";
    case Tone::bad:
      return "bad";
    case Tone::plain:
      break;
  }
  return "info";
}

const char* old_cell_class(char align) {
  return align == 'r' ? " class=\"number\"" : align == 't' ? " class=\"tight\"" : "";
}

}  // namespace

std::string badge(Tone tone, std::string_view words) {
  return fmt::format("<span class=\"badge {}\">{}</span>", class_of(tone), html_text(words));
}

Tone tone_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::proved:
      return Tone::good;
    case VerdictKind::bounded:
    case VerdictKind::sampled:
      return Tone::info;
    case VerdictKind::violated:
      return Tone::bad;
    case VerdictKind::inconclusive:
      return Tone::warn;
  }
  return Tone::warn;
}

std::string signed_name(VerdictKind kind) {
  const auto with = [&](const char* sign) { return std::string{sign} + " " + name_of(kind); };
  switch (kind) {
    case VerdictKind::proved:
      return with("✓");
    case VerdictKind::bounded:
      return with("≤");
    case VerdictKind::sampled:
      return with("≈");
    case VerdictKind::violated:
      return with("✗");
    case VerdictKind::inconclusive:
      return with("?");
  }
  return name_of(kind);
}

std::string banner(Tone tone, std::string_view line, std::string_view html) {
  return fmt::format("<div class=\"banner {0}\"><p class=\"verdict-line {0}\">{1}</p>\n{2}</div>\n",
                     class_of(tone), html_text(line), html);
}

std::string heading(std::string_view words, std::string_view id) {
  return fmt::format("<h2 id=\"{}\">{}</h2>\n", html_text(id), html_text(words));
}

std::string paragraph_html(std::string_view plain, std::string_view classes) {
  return fmt::format("<p{}>{}</p>\n", classes.empty() ? "" : fmt::format(" class=\"{}\"", classes),
                     html_text(plain));
}

std::string bullets(std::span<const std::string> plain) {
  if (plain.empty()) return {};
  std::string html = "<ul>\n";
  for (const std::string& item : plain) html += "<li>" + html_text(item) + "</li>\n";
  return html + "</ul>\n";
}

std::string details(std::string_view plain_summary, std::string_view html, bool open) {
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open ? " open" : "",
                     html_text(plain_summary), html);
}

std::string preformatted(std::string_view plain) { return "<pre>" + html_text(plain) + "</pre>\n"; }

std::string code(std::string_view plain) { return "<code>" + html_text(plain) + "</code>"; }

std::string to_html(const HtmlTable& table) {
  const auto align = [&](std::size_t k) { return k < table.align.size() ? table.align[k] : 'l'; };
  std::string html = fmt::format("<div class=\"scroll\" tabindex=\"0\"><table class=\"cards{}\">\n",
                                 table.stacked_on_paper ? " stacked" : "");
  if (!table.caption.empty()) html += "<caption>" + html_text(table.caption) + "</caption>\n";
  html += "<thead><tr>";
  for (std::size_t k = 0; k < table.head.size(); ++k) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", old_cell_class(align(k)),
                        html_text(table.head[k]));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const bool marked = r < table.marked.size() && table.marked[r];
    html += marked ? "<tr class=\"different\">" : "<tr>";
    for (std::size_t k = 0; k < table.rows[r].size(); ++k) {
      html += fmt::format("<td{}>{}</td>", old_cell_class(align(k)), table.rows[r][k]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string drawing_html(std::string_view svg, std::string_view caption) {
  return fmt::format(
      "<figure><figcaption>{0}</figcaption><div class=\"drawing scroll\" tabindex=\"0\" "
      "role=\"group\" aria-label=\"{0}\">\n{1}</div></figure>\n",
      html_text(caption), svg);
}

std::string unmodelled_html(const model::DdsProfile& profile, std::string_view profile_name) {
  if (profile.unmodelled.empty()) return {};
  std::string list = "<ul>\n";
  for (const auto& [setting, effect] : profile.unmodelled) {
    list += "<li>" + code(setting) + ": " + html_text(effect) + "</li>\n";
  }
  const std::string whose = profile_name.empty() ? "" : std::string{profile_name} + ": ";
  return banner(
      Tone::warn, whose + unmodelled_heading,
      "<p>No statement of this report depends on these settings:</p>\n" + list + "</ul>\n");
}

}  // namespace stormproof::report::parts
