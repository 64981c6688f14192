// Puts a model together: the processes of the rules, what is on its way between them, losses, and
// the claims.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "checker/engines/promela/script.hpp"

namespace stormproof::promela {

/// What a rule does: its statements, and how many packets it sends to which store at most.
struct Step {
  std::vector<std::string> lines;
  std::map<std::string, unsigned> sends;
};

class ModelText {
 public:
  ModelText(std::string composition, unsigned descriptors)
      : composition_{std::move(composition)}, descriptors_{descriptors} {}

  /// A field of a packet that is sent, if the script says that it is kept.
  void add_field(const std::string& packet, const std::string& field, bool bitmap,
                 const Script& script);
  /// A rule that happens once from outside; for a descriptor's, once for each, ascending.
  void add_occasion(const std::string& rule, const std::vector<Step>& steps);
  void add_timer(const std::string& rule, const std::string& timer, bool counted, const Step& step);
  /// A rule about a packet that arrives, or that leaves its source.
  void add_packet(const std::string& rule, const std::string& packet, bool at_source,
                  const Step& step);

  /// The model. `acknowledged` says of each descriptor that the writer takes it as acknowledged,
  /// `received` is the bitmap of what the reader has.
  [[nodiscard]] std::string text(const Script& script, const std::vector<std::string>& acknowledged,
                                 const std::string& received) const;

 private:
  struct Field {
    std::string variable;
    bool bitmap = false;
    bool carried = false;  ///< also on its way, not only at the source
    unsigned values = 0;   ///< that are said of it
  };
  struct Process {
    std::string rule;
    std::string trigger;
    std::vector<Step> steps;
    Store store{};  ///< of the packet that it is about
    bool repeats = false;
  };

  void add(Process process);
  [[nodiscard]] std::vector<Field> fields_of(const Store& store) const;
  /// How many different packets there can be.
  [[nodiscard]] unsigned contents(const Store& store) const;
  /// Whether there is a place for each of them: if they are few. Otherwise there are as many places
  /// as two steps need (one, with many descriptors), and a step that sends more waits: executions
  /// with more packets on their way are not in the model.
  [[nodiscard]] bool has_room_for_all(const Store& store) const {
    return contents(store) <= 2 * descriptors_;
  }
  [[nodiscard]] unsigned capacity(const Store& store) const;
  [[nodiscard]] std::string room_for(const Step& step) const;
  [[nodiscard]] std::string stores() const;
  [[nodiscard]] std::string operations(const Store& store) const;
  [[nodiscard]] std::string process(const Process& process) const;
  [[nodiscard]] std::string loss() const;

  std::string composition_;
  unsigned descriptors_;
  std::map<std::string, std::vector<Field>> fields_;  // by packet
  std::vector<Process> processes_;
  std::vector<Store> stores_;             // of rules about packets
  std::map<std::string, unsigned> most_;  // sent by one step, by store
};

}  // namespace stormproof::promela
