// The page in a real browser: headless Chromium opens it once, a script appended to it presses keys
// and buttons and writes down what it sees.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "checker/presentation/document/render.hpp"
#include "tests/checker/presentation/document/examples.hpp"
#include "tests/files.hpp"

namespace stormproof::report {
namespace browser_test {

namespace fs = std::filesystem;

// Each note becomes a line "name=value" of the text of #notes.
constexpr std::string_view driver = R"js(
<pre id="notes"></pre><script>
const notes = document.getElementById("notes");
const note = (name, value) => { notes.textContent += name + "=" + value + "\n"; };
const boxes = [...document.querySelectorAll(".stepper")];
const at = (k) => boxes[k].querySelector("output").value;
const press = (target, key) => target.dispatchEvent(
  new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
const marked = (k) => {
  const step = boxes[k].querySelector(".steps > .current");
  const row = document.getElementById(boxes[k].dataset.drawing).querySelector(".row.current");
  return row !== null && row.classList.contains("r" + step.dataset.row);
};
const visible = (k) => [...boxes[k].querySelectorAll(".steps > li")]
  .filter((step) => getComputedStyle(step).display !== "none").length;
for (const area of document.querySelectorAll(".drawing")) area.style.scrollBehavior = "auto";
note("steppers", boxes.length);
note("start", at(0));
note("visible", visible(0));
press(boxes[0], "ArrowRight"); note("right", at(0)); note("right marks", marked(0));
press(boxes[0], "ArrowRight"); press(boxes[0], "ArrowLeft"); note("left", at(0));
press(boxes[0], "End"); note("end", at(0)); note("end marks", marked(0));
note("end says", boxes[0].querySelector(".steps > .current .violated") !== null);
note("spoken", boxes[0].querySelector("[aria-live]").textContent.length > 20);
note("no next", boxes[0].querySelector("[data-go=next]").getAttribute("aria-disabled"));
press(boxes[0], "ArrowRight"); note("beyond", at(0));
const area = document.getElementById(boxes[0].dataset.drawing).closest(".drawing");
note("scrolled", area.scrollHeight <= area.clientHeight || area.scrollTop > 0);
press(boxes[0], "Home"); note("home", at(0));
boxes[0].querySelector("[data-go=next]").click(); note("next button", at(0));
boxes[0].querySelector("[data-go=last]").click();
boxes[0].querySelector("[data-go=previous]").click(); note("previous button", at(0));
boxes[0].querySelector("[data-go=first]").click(); note("first button", at(0));
const slider = boxes[0].querySelector("input");
slider.value = 2; slider.dispatchEvent(new Event("input")); note("slider", at(0));
note("states marked", document.querySelectorAll(".state.active").length > 0);
boxes[1].scrollIntoView({ block: "center", behavior: "instant" });
press(document.body, "ArrowRight"); note("nearest", at(1)); note("other stays", at(0));
scrollTo({ top: 0, behavior: "instant" });
note("far away", press(document.body, "ArrowRight")); note("far away stays", at(1));
const paper = getComputedStyle(document.body).backgroundColor;
const themeButton = document.getElementById("theme");
const label = themeButton.textContent;
themeButton.click();
note("theme", document.documentElement.dataset.theme);
note("theme changes", getComputedStyle(document.body).backgroundColor !== paper);
note("theme drawing", getComputedStyle(document.querySelector(".art")).getPropertyValue("--paper")
  .trim());
note("theme label", themeButton.textContent !== label);
note("scripts", document.scripts.length);
note("pwned", typeof pwned);
note("title", document.title);
note("errors", errors.join("; "));
press(boxes[0], "Home"); press(boxes[0], " ");
note("plays", boxes[0].querySelector("[data-go=play]").textContent);
setTimeout(() => { note("played", at(0)); press(boxes[0], " "); }, 2500);
setTimeout(() => { note("paused", at(0)); }, 4500);
</script></body>)js";

constexpr std::string_view catcher =
    "<head><script>const errors = []; addEventListener(\"error\", (e) => errors.push(e.message));"
    "addEventListener(\"securitypolicyviolation\", (e) => errors.push(e.violatedDirective));"
    "</script>";

std::string with(std::string page, const std::string& from, std::string_view to) {
  const std::size_t at = page.rfind(from);
  EXPECT_NE(at, std::string::npos) << from;
  return page.replace(at, from.size(), to);
}

std::string unescaped(std::string text) {
  for (const auto& [entity, character] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at) {
      text.replace(at, std::string_view{entity}.size(), character);
    }
  }
  return text;
}

std::string document_after(const fs::path& page, const fs::path& folder, int width) {
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
      "--disable-background-networking --disable-component-update --disable-sync "
      "--disable-dev-shm-usage --virtual-time-budget=8000 --window-size=" +
      std::to_string(width) + ",900 --user-data-dir='" + (folder / "profile").string() +
      "' --dump-dom 'file://" + page.string() + "' 2>'" + (folder / "messages").string() + "'";
  return files::output_of(command);
}

/// What the script noted, by name.
std::map<std::string, std::string> notes_of(const std::string& page,
                                            std::string_view script = driver, int width = 1200) {
  const files::Folder folder;
  const fs::path file = folder.path() / "page.html";
  files::write(file, with(with(page, "<head>", catcher), "</body>", script));
  const std::string document = document_after(file, folder.path(), width);
  const std::string open = "<pre id=\"notes\">";
  const std::size_t begin = document.rfind(open);
  EXPECT_NE(begin, std::string::npos) << "is the program chromium installed?";
  if (begin == std::string::npos) return {};
  const std::size_t first = begin + open.size();
  std::istringstream lines{
      unescaped(document.substr(first, document.find("</pre>", first) - first))};
  std::map<std::string, std::string> notes;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) notes[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return notes;
}

TEST(Browser, StepsThroughCounterexamplesByKeysAndButtons) {
  CheckExample example;
  auto notes = notes_of(to_html(document_of(example.report(), example.context())));
  const std::string steps = notes["start"].substr(notes["start"].find("of"));
  const auto step = [&](int k) { return "step " + std::to_string(k) + " " + steps; };
  const int last = std::atoi(steps.c_str() + 3);
  EXPECT_GE(last, 5);
  EXPECT_EQ(notes["steppers"], "2");
  EXPECT_EQ(notes["start"], step(1));
  EXPECT_EQ(notes["visible"], "1");
  EXPECT_EQ(notes["right"], step(2));
  EXPECT_EQ(notes["left"], step(2));
  EXPECT_EQ(notes["end"], step(last));
  EXPECT_EQ(notes["beyond"], step(last));
  EXPECT_EQ(notes["home"], step(1));
  EXPECT_EQ(notes["next button"], step(2));
  EXPECT_EQ(notes["previous button"], step(last - 1));
  EXPECT_EQ(notes["first button"], step(1));
  EXPECT_EQ(notes["slider"], step(3));
  for (const char* fact : {"right marks", "end marks", "end says", "spoken", "no next", "scrolled",
                           "states marked", "theme changes", "theme label"}) {
    EXPECT_EQ(notes[fact], "true") << fact;
  }
  // Keys anywhere move the stepper that is on the screen, and only then.
  EXPECT_EQ(notes["nearest"].substr(0, 6), "step 2");
  EXPECT_EQ(notes["other stays"], step(3));
  EXPECT_EQ(notes["far away"], "true");
  EXPECT_EQ(notes["far away stays"], notes["nearest"]);
  // Themes reach the drawings.
  EXPECT_EQ(notes["theme"], "dark");
  EXPECT_EQ(notes["theme drawing"], "#14181d");
  // Playing goes on by itself until it is paused.
  EXPECT_EQ(notes["plays"], "❚❚ pause");
  EXPECT_EQ(notes["played"], step(3));
  EXPECT_EQ(notes["paused"], step(3));
  // Nothing of the user's has run, and nothing was refused by the page's own policy.
  EXPECT_EQ(notes["pwned"], "undefined");
  EXPECT_EQ(notes["scripts"], "3");
  EXPECT_EQ(notes["errors"], "");
  EXPECT_NE(notes["title"].find("<script>pwned=1</script>"), std::string::npos);
}

// What leaves the window or lies on something else, as the first such thing.
constexpr std::string_view ruler = R"js(
<pre id="notes"></pre><script>
const notes = document.getElementById("notes");
const note = (name, value) => { notes.textContent += name + "=" + value + "\n"; };
for (const part of document.querySelectorAll("details")) part.open = true;
const room = document.documentElement.clientWidth;
note("window", innerWidth);
note("page", document.documentElement.scrollWidth <= room);
const boxes = (name) => [...document.querySelectorAll(name)].map((part) =>
  ({ part, box: part.getBoundingClientRect() }));
note("plots", boxes(".plots > svg").filter(({ box }) => box.right > room).length);
const button = document.getElementById("theme").getBoundingClientRect();
note("button", boxes(".banner, h1").filter(({ part, box }) => {
  const text = document.createRange();
  text.selectNodeContents(part);
  const own = part.matches("h1") ? text.getBoundingClientRect() : box;
  return own.left < button.right && button.left < own.right && own.top < button.bottom &&
         button.top < own.bottom;
}).length);
const heads = [...document.querySelectorAll("table.cards td[data-head]")].filter((cell) =>
  getComputedStyle(cell).display === "block" && cell.textContent !== "");
note("stacked", heads.length > 0);
note("without head", heads.filter((cell) =>
  !getComputedStyle(cell, "::before").content.includes(cell.dataset.head)).length);
note("captions", boxes("caption").filter(({ part, box }) =>
  box.width > 0 && box.width < Math.min(200, part.textContent.length * 6)).length);
note("errors", errors.join("; "));
</script></body>)js";

class Windows : public testing::TestWithParam<int> {};

TEST_P(Windows, HoldThePage) {
  CheckExample example;
  auto notes =
      notes_of(to_html(document_of(example.report(), example.context())), ruler, GetParam());
  EXPECT_EQ(notes["window"], std::to_string(GetParam()));
  EXPECT_EQ(notes["page"], "true");
  EXPECT_EQ(notes["plots"], "0");
  EXPECT_EQ(notes["button"], "0");
  EXPECT_EQ(notes["stacked"], GetParam() < 640 ? "true" : "false");
  EXPECT_EQ(notes["without head"], "0");
  EXPECT_EQ(notes["captions"], "0");
  EXPECT_EQ(notes["errors"], "");
}

// Headless Chromium has no window that is narrower than 500.
INSTANTIATE_TEST_SUITE_P(Browser, Windows, testing::Values(500, 800, 1280, 1600));

}  // namespace browser_test
}  // namespace stormproof::report
