// A document as one page: the answer in a frame, headings, tables that become cards on narrow
// screens, drawings, charts to step through.
#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "checker/presentation/document/drawings.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::report {

namespace {

const char* tone_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::warn:
      return "warn";
    case Tone::bad:
      return "bad";
    case Tone::info:
    case Tone::plain:
      break;
  }
  return "info";
}

std::string with_sign(std::string_view sign, std::string_view words) {
  return sign.empty() ? std::string{words} : std::string{sign} + " " + std::string{words};
}

std::string span_html(const Span& span) {
  const std::string text = html_text(span.text);
  switch (span.kind) {
    case Span::Kind::code:
      return "<code>" + text + "</code>";
    case Span::Kind::strong:
      return "<strong>" + text + "</strong>";
    case Span::Kind::badge: {
      const std::string_view sign = span.sign.empty() ? sign_of(span.tone) : span.sign;
      return fmt::format("<span class=\"badge {}\">{}</span>", tone_class(span.tone),
                         html_text(with_sign(sign, span.text)));
    }
    case Span::Kind::link:
      return fmt::format("<a href=\"#{}\">{}</a>", html_text(span.target), text);
    case Span::Kind::plain:
      break;
  }
  return text;
}

std::string html(const Text& text) {
  std::string result;
  for (const Span& span : text.spans()) result += span_html(span);
  return result;
}

std::string id_attribute(const std::string& id) {
  return id.empty() ? "" : " id=\"" + html_text(id) + "\"";
}

bool page_sees(Audience audience) {
  return audience != Audience::terminal && audience != Audience::explained &&
         audience != Audience::comment;
}

bool page_shown(const Block& block) {
  if (!page_sees(block.audience)) return false;
  const auto* section = std::get_if<Section>(&block.content);
  return section == nullptr || std::ranges::any_of(section->blocks, page_shown);
}

bool is_loose_drawing(const Block& block) {
  const auto* drawing = std::get_if<Drawing>(&block.content);
  return drawing != nullptr && drawing->caption.empty();
}

std::string details(std::string_view summary, const std::string& inner) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", html_text(summary), inner);
}

std::string preformatted(std::string_view text) { return "<pre>" + html_text(text) + "</pre>\n"; }

std::string framed(Tone tone, const std::string& line, const std::string& inner) {
  return fmt::format("<div class=\"banner {0}\"><p class=\"verdict-line {0}\">{1}</p>\n{2}</div>\n",
                     tone_class(tone), line, inner);
}

std::string bullets(const std::vector<Text>& items) {
  std::string list = "<ul>\n";
  for (const Text& item : items) list += "<li>" + html(item) + "</li>\n";
  return list + "</ul>\n";
}

/// The drawing with its caption, in a frame that scrolls.
std::string figure(const std::string& svg, std::string_view caption) {
  return fmt::format(
      "<figure><figcaption>{0}</figcaption><div class=\"drawing scroll\" tabindex=\"0\" "
      "role=\"group\" aria-label=\"{0}\">\n{1}</div></figure>\n",
      html_text(caption), svg);
}

/// What a narrow screen, which has no room for the head of the table, writes before a cell.
std::string head_attribute(const Column& column) {
  return column.head.empty() ? "" : " data-head=\"" + html_text(column.head) + "\"";
}

const char* cell_class(const Column& column) {
  if (column.align == Column::Align::right) return " class=\"number\"";
  return column.wraps ? "" : " class=\"tight\"";
}

class Page {
 public:
  std::string run(const Document& document) {
    std::string body = "<h1>" + html_text(document.title) + "</h1>\n";
    std::string more;
    if (!document.elaboration.empty()) more = "<p>" + html(document.elaboration) + "</p>\n";
    if (!document.answer.empty()) {
      const std::string sign = html_text(sign_of(document.tone));
      more = framed(document.tone, with_sign(sign, html(document.answer)), more);
    }
    if (!document.subject.empty()) more += "<p>" + html(document.subject) + "</p>\n";
    body += more + blocks(document.blocks, 2);
    if (!document.assumptions.empty()) {
      body += add(Section{"Assumptions", "assumptions", {Bullets{document.assumptions}}}, 2);
    }
    if (!document.command.empty()) {
      body += add(Section{"Repeat it", "repeat", {Command{document.command}}}, 2);
    }
    body += next_steps(document);
    return html_page(document.title, body, drawings_);
  }

 private:
  std::string next_steps(const Document& document) {
    if (document.next.empty()) return "";
    Section section{"Next", "next"};
    for (const NextStep& step : document.next) {
      section.blocks.emplace_back(Paragraph{step.why});
      section.blocks.emplace_back(Command{step.command});
    }
    return add(section, 2);
  }

  std::string blocks(const Blocks& all, std::size_t level) {
    std::string text;
    bool drawings = false;  // side by side
    for (const Block& block : all) {
      if (!page_shown(block)) continue;
      const bool loose = is_loose_drawing(block);
      if (loose != drawings) text += loose ? "<div class=\"plots\">\n" : "</div>\n";
      drawings = loose;
      text += add(block, level);
    }
    return text + (drawings ? "</div>\n" : "");
  }

  std::string add(const Block& block, std::size_t level) {
    if (block.audience == Audience::verbose) {
      if (const auto* section = std::get_if<Section>(&block.content)) {
        Section folded = *section;
        folded.folded = true;
        if (folded.title.empty()) folded.title = "Details";
        return add(folded, level);
      }
    }
    std::string text =
        std::visit([&](const auto& content) { return add(content, level); }, block.content);
    const bool folded = block.audience == Audience::verbose && !in_details_;
    return folded ? details("Details", text) : text;
  }

  std::string add(const Paragraph& block, std::size_t /*level*/) {
    if (block.tone == Tone::plain) return "<p>" + html(block.text) + "</p>\n";
    return fmt::format("<p class=\"note {}\">{}</p>\n", tone_class(block.tone),
                       with_sign(html_text(sign_of(block.tone)), html(block.text)));
  }

  std::string add(const Bullets& block, std::size_t /*level*/) { return bullets(block.items); }

  std::string add(const Facts& block, std::size_t /*level*/) {
    std::string text = "<dl class=\"facts\">\n";
    for (const auto& [label, value] : block.rows) {
      text += "<dt>" + html_text(label) + "</dt><dd>" + html(value) + "</dd>\n";
    }
    return text + "</dl>\n";
  }

  std::string row(const Table& table, const Table::Row& one, std::size_t level) {
    std::string text = one.marked ? "<tr class=\"different\">" : "<tr>";
    const bool outer = std::exchange(in_details_, true);
    std::string more = blocks(one.details, level);
    in_details_ = outer;
    if (!more.empty()) more = details(one.summary.empty() ? "Details" : one.summary, more);
    std::size_t last = 0;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (page_sees(table.columns[k].audience)) last = k;
    }
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (!page_sees(table.columns[k].audience)) continue;
      text += fmt::format("<td{}{}>{}{}</td>", cell_class(table.columns[k]),
                          head_attribute(table.columns[k]),
                          k < one.cells.size() ? html(one.cells[k]) : "", k == last ? more : "");
    }
    return text + "</tr>\n";
  }

  std::string add(const Table& block, std::size_t level) {
    const bool stacked =
        std::ranges::any_of(block.rows, [](const Table::Row& one) { return !one.details.empty(); });
    constexpr std::ptrdiff_t many_columns = 10;
    const auto columns = std::ranges::count_if(
        block.columns, [](const Column& one) { return page_sees(one.audience); });
    std::string text =
        fmt::format("<div class=\"scroll\" tabindex=\"0\"><table class=\"cards{}{}\">\n",
                    stacked ? " stacked" : "", columns >= many_columns ? " dense" : "");
    if (!block.caption.empty()) text += "<caption>" + html_text(block.caption) + "</caption>\n";
    text += "<thead><tr>";
    for (const Column& column : block.columns) {
      if (!page_sees(column.audience)) continue;
      text +=
          fmt::format("<th scope=\"col\"{}>{}</th>", cell_class(column), html_text(column.head));
    }
    text += "</tr></thead>\n<tbody>\n";
    for (const Table::Row& one : block.rows) text += row(block, one, level);
    return text + "</tbody></table></div>\n";
  }

  std::string add(const Listing& block, std::size_t /*level*/) { return preformatted(block.text); }

  std::string add(const Command& block, std::size_t /*level*/) { return preformatted(block.line); }

  std::string add(const Drawing& block, std::size_t /*level*/) {
    const std::string svg = drawings_.add(block.svg, block.id);
    if (block.caption.empty()) return svg;
    if (block.machine.empty()) return figure(svg, block.caption);
    return fmt::format("<div data-machine=\"{}\">{}</div>\n", html_text(block.machine),
                       figure(svg, block.caption));
  }

  std::string add(const Sequence& block, std::size_t /*level*/) {
    std::string text;
    if (!block.chart.rows.empty()) {
      text = figure(drawings_.add(sequence::svg_chart(block.chart), block.id), block.caption);
    }
    if (!block.steps_html.empty()) {
      text = "<div class=\"walk\">\n" + text + block.steps_html + "</div>\n";
    }
    if (!block.story) return text;
    return text + details("The same as a story", preformatted(block.story(report_width)));
  }

  std::string add(const Later& block, std::size_t level) { return blocks(block.make(), level); }

  std::string add(const Section& block, std::size_t level) {
    if (block.title.empty()) return blocks(block.blocks, level);
    const std::string inner = blocks(block.blocks, level + 1);
    const std::string title = html_text(block.title);
    if (block.folded) {
      return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", id_attribute(block.id),
                         title, inner);
    }
    return fmt::format("<section>\n<h{0}{1}>{2}</h{0}>\n{3}</section>\n",
                       std::min<std::size_t>(level, 6), id_attribute(block.id), title, inner);
  }

  Drawings drawings_;
  bool in_details_ = false;  ///< of a row, which are folded as a whole
};

}  // namespace

std::string to_html(const Document& document) { return Page{}.run(document); }

}  // namespace stormproof::report
