// Parsing with tinyxml2, and the geometry of boxes.
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

#include <algorithm>

#include <tinyxml2.h>

#include "checker/presentation/diagrams/svg.hpp"

namespace stormproof::draw {

namespace {

bool has_class(const std::string& classes, const std::string& wanted) {
  return (" " + classes + " ").find(" " + wanted + " ") != std::string::npos;
}

PlacedText placed(const tinyxml2::XMLElement& element) {
  PlacedText text;
  text.text = element.GetText() == nullptr ? "" : element.GetText();
  const char* classes = element.Attribute("class");
  text.classes = classes == nullptr ? "" : classes;
  const int size = has_class(text.classes, "title")   ? 16
                   : has_class(text.classes, "small") ? 11
                                                      : 12;
  const int width = text_width(text.text, size);
  const int x = element.IntAttribute("x");
  const std::string anchor =
      element.Attribute("text-anchor") == nullptr ? "" : element.Attribute("text-anchor");
  text.left = anchor == "end" ? x - width : anchor == "middle" ? x - width / 2 : x;
  text.right = text.left + width;
  text.bottom = element.IntAttribute("y") + size / 4;
  text.top = text.bottom - size;
  return text;
}

/// Texts, groups and links, in whatever groups and links they stand.
void collect(const tinyxml2::XMLElement& parent, SvgTexts& svg) {
  for (const auto* child = parent.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string name = child->Name();
    if (name == "text") svg.texts.push_back(placed(*child));
    if (name == "g" && child->Attribute("id") != nullptr) {
      svg.groups.emplace_back(child->Attribute("id"));
    }
    if (name == "a" && child->Attribute("href") != nullptr) {
      svg.links.emplace_back(child->Attribute("href"));
    }
    if (name == "g" || name == "a") collect(*child, svg);
  }
}

bool overlap(const PlacedText& a, const PlacedText& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

}  // namespace

bool SvgTexts::says(const std::string& text) const {
  return std::ranges::any_of(
      texts, [&](const PlacedText& t) { return t.text.find(text) != std::string::npos; });
}

std::size_t SvgTexts::count(const std::string& text) const {
  return static_cast<std::size_t>(std::ranges::count(texts, text, &PlacedText::text));
}

std::string SvgTexts::joined(const std::string& text_class) const {
  std::string all;
  for (const PlacedText& text : texts) {
    if (!has_class(text.classes, text_class)) continue;
    const std::size_t begin = text.text.find_first_not_of(' ');
    if (begin != std::string::npos) all += (all.empty() ? "" : " ") + text.text.substr(begin);
  }
  return all;
}

std::string SvgTexts::fault() const {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const PlacedText& a = texts[i];
    if (a.left < 0 || a.right > width || a.top < 0 || a.bottom > height) {
      return "'" + a.text + "' leaves the drawing";
    }
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      if (overlap(a, texts[j])) return "'" + a.text + "' and '" + texts[j].text + "' overlap";
    }
  }
  return "";
}

std::optional<SvgTexts> read_svg(const std::string& document) {
  tinyxml2::XMLDocument xml;
  if (xml.Parse(document.c_str(), document.size()) != tinyxml2::XML_SUCCESS) return std::nullopt;
  const tinyxml2::XMLElement* root = xml.RootElement();
  if (root == nullptr || std::string{root->Name()} != "svg") return std::nullopt;
  SvgTexts svg;
  svg.width = root->IntAttribute("width");
  svg.height = root->IntAttribute("height");
  collect(*root, svg);
  return svg;
}

}  // namespace stormproof::draw
