// What a command answers, before anybody renders it: an answer in one line, sections of paragraphs,
// facts, tables and charts, findings that CI systems count, and the command that gives it again.
// Every command makes one such document; text, Markdown, HTML, JUnit and SARIF are renderings of it
// (render.hpp). Strings are plain UTF-8 throughout: each renderer escapes in its own way.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "checker/presentation/sequence/chart.hpp"
#include "model/config/tree/tree.hpp"

namespace stormproof::report {

/// How a verdict or judgment looks: a colour, and a sign beside the word where colours are missing.
enum class Tone : std::uint8_t { plain, good, info, warn, bad };

/// A piece of running text.
struct Span {
  enum class Kind : std::uint8_t { plain, code, strong, badge, link };
  Kind kind = Kind::plain;
  std::string text;
  std::string target = {};  ///< of a link: id of a section or drawing of the document
  Tone tone = Tone::plain;  ///< of a badge: its sign and colour
  std::string sign = {};    ///< of a badge: in place of the one of its tone
};

/// Running text on one line; renderers break it.
class Text {
 public:
  Text() = default;
  Text(std::string plain);       // NOLINT(google-explicit-constructor): a string is a text
  Text(std::string_view plain);  // NOLINT(google-explicit-constructor)
  Text(const char* plain);       // NOLINT(google-explicit-constructor)
  explicit Text(Span span);

  Text& operator+=(Text more);
  friend Text operator+(Text first, Text second) { return first += std::move(second); }

  [[nodiscard]] bool empty() const { return spans_.empty(); }
  [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }
  /// Without marks; a badge without its sign.
  [[nodiscard]] std::string plain() const;

 private:
  std::vector<Span> spans_;
};

/// A key, a command, a file: set apart where the format can.
[[nodiscard]] Text code(std::string_view text);
[[nodiscard]] Text strong(std::string_view text);
/// "✗ violated": a word with the sign and colour of its tone, or with another sign.
[[nodiscard]] Text badge(Tone tone, std::string_view word, std::string_view sign = {});
[[nodiscard]] Text link(std::string_view text, std::string_view target);

/// "✓", "≈", "?", "✗"; nothing for `plain`.
[[nodiscard]] std::string_view sign_of(Tone tone);

// ---- blocks -------------------------------------------------------------------------------------

/// Who gets to see a block. Not a matter of taste: a terminal has no room for what a page folds
/// away, and a page draws what a terminal cannot.
enum class Audience : std::uint8_t {
  everybody,
  verbose,  ///< at a terminal only with -v or --explain; folded in Markdown and on pages
  terminal,
  explained,  ///< at a terminal with -v or --explain, and nowhere else
  documents,  ///< Markdown and pages
  comment,    ///< Markdown in a comment on a pull request
  page
};

struct Block;

/// Blocks may contain blocks, so what needs to know what a block is comes after it.
struct Blocks : std::vector<Block> {
  Blocks();
  Blocks(std::initializer_list<Block> blocks);
  Blocks(const Blocks& other);
  Blocks(Blocks&& other) noexcept;
  Blocks& operator=(const Blocks& other);
  Blocks& operator=(Blocks&& other) noexcept;
  ~Blocks();
};

struct Paragraph {
  Text text;
  Tone tone = Tone::plain;  ///< framed on pages unless plain
};

/// Items of equal rank.
struct Bullets {
  std::vector<Text> items;
};

/// Labels with what they stand for, one below the other: "scenario  2 participants …".
struct Facts {
  std::vector<std::pair<std::string, Text>> rows;
};

struct Column {
  enum class Align : std::uint8_t { left, right };
  std::string head;
  Align align = Align::left;
  bool wraps = false;  ///< long sentences; other columns are as wide as their longest cell
  Audience audience = Audience::everybody;  ///< `verbose` is for pages and for a terminal with -v
  bool stays = false;  ///< a narrow terminal leaves others out, the last first; never this one
};

struct Table {
  struct Row {
    std::vector<Text> cells;   ///< as many as there are columns
    bool marked = false;       ///< shaded: another background
    Blocks details = {};       ///< belong to the row: below it, folded where the format can
    std::string summary = {};  ///< of folded details: "2 assumptions, 1 finding"
  };
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::string caption = {};  ///< may be empty
  bool wide = false;         ///< many numbers: at a terminal up to 140 columns rather than broken
};

/// A text with its own line breaks: a file, a story, the output of another program.
struct Listing {
  std::string text;
  std::string language = "text";  ///< for highlighting: "yaml", "xml", "mermaid"
};

/// A command that the reader can run, one or several lines of a shell.
struct Command {
  std::string line;
};

/// A chart or drawing that only pages show. `svg` is a self-contained SVG document. Drawings
/// without a caption that follow each other stand side by side.
struct Drawing {
  std::string svg;
  std::string caption;
  std::string id = {};       ///< unique in the document; may be empty
  std::string machine = {};  ///< a state machine: its states are marked as steps are walked through
};

/// A text with its own line breaks, of at most so many columns where words allow it.
using Story = std::function<std::string(std::size_t columns)>;

/// A sequence chart: drawn on pages, Mermaid in Markdown, rows of text at a terminal.
struct Sequence {
  sequence::Chart chart;
  std::string id;  ///< unique in the document
  std::string caption;
  Story story = {};  ///< the same in words, if there is one; then a terminal shows it
  /// HTML that goes with the drawing on a page: steps to walk through. It is trusted as it is.
  std::string steps_html = {};
};

/// Blocks under a heading.
struct Section {
  std::string title;
  std::string id = {};  ///< for links; unique in the document; may be empty
  Blocks blocks = {};
  bool folded = false;  ///< details: folded on pages and in Markdown; at a terminal after the rest
  bool folded_in_comments = false;  ///< in Markdown only, where a comment has to be short
};

/// Blocks that only those pay for who see them: the renderers of other formats never call `make`.
/// It owns what it needs, because it is called when the command is done.
struct Later {
  std::function<Blocks()> make;
};

template <class T, class... Kinds>
concept OneOf = (std::same_as<T, Kinds> || ...);

struct Block {
  std::variant<Paragraph, Bullets, Facts, Table, Listing, Command, Drawing, Sequence, Section,
               Later>
      content;
  Audience audience = Audience::everybody;

  template <
      OneOf<Paragraph, Bullets, Facts, Table, Listing, Command, Drawing, Sequence, Section, Later>
          T>
  Block(T made, Audience who = Audience::everybody)  // NOLINT(google-explicit-constructor)
      : content{std::move(made)}, audience{who} {}
};

// ---- findings -----------------------------------------------------------------------------------

/// A place in a file. Line and column count from 1; 0: the file as a whole.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;  ///< in bytes, as `model::config::Place` counts
  std::string message;

  Location() = default;
  /// An override on the command line has no file; then `file` stays empty.
  explicit Location(const model::config::Place& place, std::string text = {});
};

/// One thing that was looked at, and what came of it: a test case in JUnit, a rule with its result
/// in SARIF.
struct Finding {
  enum class Outcome : std::uint8_t {
    passed,
    failed,    ///< it does not hold
    unknown,   ///< nobody knows: inconclusive, interrupted
    disputed,  ///< answers contradict each other
    note  ///< none of these: an assumption, a remark. Not a test case, but among a suite's notes
  };
  /// What CI systems count and what they show beside the code may differ.
  enum class Shown : std::uint8_t { everywhere, tests, code };

  std::string id;           ///< of the rule: "storm.single-copy", "limit.completion"
  std::string statement;    ///< of the rule, one sentence
  std::string description;  ///< more about the rule; may be empty
  Outcome outcome = Outcome::passed;
  bool warning = false;  ///< failed, but no more than a warning in SARIF
  std::string word;      ///< what the command calls the outcome: "violated", "regression"
  std::string message;   ///< one sentence: why
  std::string details;   ///< lines; may be empty
  double seconds = 0;
  std::vector<Location> locations{};  ///< one, or none
  std::vector<Location> related{};
  /// What makes it the same finding tomorrow, without numbers that change with every run.
  std::vector<std::string> identity{};
  std::string group{};    ///< class of the test case: "stormproof.diff.cost"; empty: the title's
  std::string name{};     ///< of the test case; empty: `id`
  std::string command{};  ///< shows it: "stormproof replay FILE"; may be empty
  Shown shown = Shown::everywhere;
};

// ---- the document -------------------------------------------------------------------------------

/// A command to run after this one, and what it tells.
struct NextStep {
  std::string command;
  std::string why;
};

struct Document {
  std::string title;        ///< "stormproof check wifi-5x20"
  Tone tone = Tone::plain;  ///< of the answer; its sign stands before the answer
  Text subject{};           ///< what was looked at, on one line; may be empty
  Text answer;              ///< the first line: what the reader asked
  Text elaboration;         ///< one or two sentences below it; may be empty
  Blocks blocks{};
  std::vector<Finding> findings{};
  std::vector<Text> assumptions{};  ///< what the answer takes for granted; listed near the end
  std::string command{};            ///< gives the same answer again; empty: nothing to repeat
  std::vector<NextStep> next{};     ///< where to go from here
  int exit_code = 0;                ///< of the program that shows the document
  bool complete = true;             ///< false: interrupted; what is there holds
  double seconds = 0;               ///< that the work behind it took, by the clock
};

}  // namespace stormproof::report
