// Rules about includes look up files by path; what is no file of the tree is somebody else's
// header.
#include "tests/structure/rules.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include <fmt/core.h>

namespace stormproof::structure {
namespace {

/// An entry of the layers, with its layer.
struct Entry {
  std::size_t layer = 0;
  std::string name;
};

std::string folder_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? std::string{} : file.substr(0, slash);
}

class FolderRule {
 public:
  FolderRule(const Includes& includes, const Layers& layers) : includes_{includes} {
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      for (const std::string& name : layers[layer]) {
        if (!entries_.emplace(name, Entry{layer, name}).second) {
          complain(fmt::format("{} stands in the list twice", name));
        }
      }
    }
  }

  std::vector<std::string> check() {
    std::set<std::string> used;
    for (const auto& [file, names] : includes_) {
      const std::optional<Entry> own = entry_of(file);
      if (!own) {
        complain(fmt::format("{} is in no folder of the list", file));
        continue;
      }
      used.insert(own->name);
      for (const std::string& name : names) check_arrow(file, *own, name);
    }
    for (const auto& [name, entry] : entries_) {
      if (!used.contains(name)) complain(fmt::format("{} has no file", name));
    }
    return std::move(complaints_);
  }

 private:
  void check_arrow(const std::string& file, const Entry& own, const std::string& included) {
    if (!includes_.contains(included)) return;
    const std::optional<Entry> other = entry_of(included);
    if (!other || other->name == own.name || other->layer < own.layer) return;
    complain(fmt::format("{} includes {}: {} is {} {}", file, included, other->name,
                         other->layer == own.layer ? "beside" : "above", own.name));
  }

  std::optional<Entry> entry_of(const std::string& file) const {
    for (const std::string& name : {file.substr(0, file.rfind('.')), folder_of(file)}) {
      const auto found = entries_.find(name);
      if (found != entries_.end()) return found->second;
    }
    return std::nullopt;
  }

  void complain(std::string words) { complaints_.push_back(std::move(words)); }

  const Includes& includes_;
  std::map<std::string, Entry> entries_;
  std::vector<std::string> complaints_;
};

/// A chain of includes from `file` to a header of `library`, the shortest; empty if there is none.
std::vector<std::string> way_to(const std::string& library, const std::string& file,
                                const Includes& includes) {
  std::map<std::string, std::string> reached_from{{file, ""}};
  std::vector<std::string> queue{file};
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const std::string here = queue[k];
    if (here.starts_with(library)) {
      std::vector<std::string> way;
      for (std::string step = here; !step.empty(); step = reached_from[step]) way.push_back(step);
      std::ranges::reverse(way);
      return way;
    }
    const auto found = includes.find(here);
    if (found == includes.end()) continue;
    for (const std::string& name : found->second) {
      if (reached_from.emplace(name, here).second) queue.push_back(name);
    }
  }
  return {};
}

std::string joined(const std::vector<std::string>& way) {
  std::string text;
  for (const std::string& step : way) text += (text.empty() ? "" : " → ") + step;
  return text;
}

}  // namespace

std::vector<std::string> check_folders(const Includes& includes, const Layers& layers) {
  return FolderRule{includes, layers}.check();
}

std::vector<std::string> check_heavy_headers(const Includes& includes, const HeavyHeaders& rule) {
  std::vector<std::string> complaints;
  std::set<std::string> used;
  for (const auto& [file, names] : includes) {
    if (!file.ends_with(".hpp")) continue;
    const std::vector<std::string> way = way_to(rule.library, file, includes);
    if (way.empty()) continue;
    const auto allowed =
        std::ranges::find_if(rule.allowed, [&file = file](const std::string& entry) {
          return entry == file || (entry.ends_with('/') && file.starts_with(entry));
        });
    if (allowed != rule.allowed.end()) {
      used.insert(*allowed);
    } else {
      complaints.push_back(
          fmt::format("{} is not to reach {}: {}", file, rule.library, joined(way)));
    }
  }
  for (const std::string& entry : rule.allowed) {
    if (!used.contains(entry)) {
      complaints.push_back(
          fmt::format("{} does not reach {}, and need not be allowed to", entry, rule.library));
    }
  }
  return complaints;
}

std::vector<std::string> check_word(const Texts& texts, const ReservedWord& rule) {
  std::vector<std::string> complaints;
  std::set<std::string> unused{rule.allowed.begin(), rule.allowed.end()};
  for (const auto& [file, text] : texts) {
    std::string dense = text;
    std::erase_if(dense, [](unsigned char one) { return std::isspace(one) != 0; });
    if (dense.find(rule.word) == std::string::npos) continue;
    const bool is_allowed = std::ranges::find(rule.allowed, file) != rule.allowed.end();
    if (!is_allowed) complaints.push_back(fmt::format("{} is not to say {}", file, rule.word));
    unused.erase(file);
  }
  for (const std::string& file : unused) {
    complaints.push_back(
        fmt::format("{} does not say {}, and need not be allowed to", file, rule.word));
  }
  return complaints;
}

}  // namespace stormproof::structure
