// The statements of a model as they are written, and what has been found out about it. Rules are
// written again until nothing new is found: a rule whose trigger never happens is no process, and a
// flag, a timer or a field of a packet that nothing ever raises is the constant false.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checker/engines/promela/expression.hpp"

namespace stormproof::promela {

/// The packets of a kind that are on their way, or those that are still at their source: a sorted
/// channel without repetitions, which is a set.
struct Store {
  std::string packet;
  bool at_source = false;

  [[nodiscard]] std::string name() const { return packet + (at_source ? "_leaving" : ""); }
};

/// What the last packet said, that was sent or looked at.
[[nodiscard]] inline std::string variable_of(const std::string& packet, const std::string& field) {
  return packet + "_" + field;
}

class Script {
 public:
  explicit Script(unsigned descriptors) : descriptors_{descriptors} {}

  [[nodiscard]] unsigned descriptors() const { return descriptors_; }

  // What is found out; it only grows.
  void find(const std::string& what) { found_.insert(what); }
  [[nodiscard]] bool is_found(const std::string& what) const { return found_.contains(what); }
  [[nodiscard]] std::size_t found() const { return found_.size(); }
  /// A packet says this of a field, which is named by its variable.
  void find_said(const std::string& field, const Number& value);
  /// Whether some packet says more than that it is false.
  [[nodiscard]] bool is_said(const std::string& field) const { return is_found("said " + field); }
  /// How many different values are said of it.
  [[nodiscard]] unsigned values_of(const std::string& field, bool bitmap) const;
  /// Whether packets on their way need the field, because somebody reads it; or those that are
  /// still at their source.
  [[nodiscard]] bool is_carried(const std::string& field) const {
    return is_said(field) && is_found("read " + field);
  }
  [[nodiscard]] bool is_kept(const std::string& field) const {
    return is_carried(field) || is_found("read at source " + field);
  }

  // Variables.
  [[nodiscard]] Truth truth(const std::string& variable) const;
  [[nodiscard]] Truth bit(const std::string& variable, int bit) const;
  [[nodiscard]] Number number(const std::string& variable) const;
  /// `variable == value`.
  [[nodiscard]] Truth equals(const std::string& variable, const std::string& value) const;
  /// The text of an expression, which must be known and still be what it was when it was read; it
  /// is a mistake of the program if a rule decides by a time, or by what it has changed since.
  [[nodiscard]] const std::string& say(const Expression& expression);

  // Statements of the rule that is being written.
  /// A rule, about a packet at its source or not.
  void begin(bool at_source) { reader_ = at_source ? "read at source " : "read "; }
  void write(const std::string& statement) { lines_.push_back(indent_ + statement + ";"); }
  void changed(const std::string& variable) { ++writes_[variable]; }
  void assign(const std::string& variable, const Expression& value);
  void when(const Truth& condition, const std::function<void()>& body);
  /// A packet that says what its variables say.
  void send(const std::string& store);
  /// What has been written, which is then forgotten; and how many packets it sends to which store.
  [[nodiscard]] std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }
  [[nodiscard]] std::map<std::string, unsigned> take_sends() { return std::exchange(sends_, {}); }

  // What stands before the processes, each once, in order of appearance.
  void define(const std::string& text) { add(definitions_, text); }
  void declare(const std::string& text) { add(declarations_, text); }
  [[nodiscard]] std::string preamble() const { return definitions_ + "\n" + declarations_; }

 private:
  [[nodiscard]] Expression reading(const std::string& variable, std::string text) const;
  static void add(std::string& to, const std::string& text) {
    if (to.find(text) == std::string::npos) to += text;
  }

  unsigned descriptors_;
  std::set<std::string> found_;
  std::map<std::string, unsigned> writes_;
  std::vector<std::string> lines_;
  std::string indent_;
  std::string reader_;
  std::map<std::string, unsigned> sends_;
  std::string definitions_;
  std::string declarations_;
};

}  // namespace stormproof::promela
