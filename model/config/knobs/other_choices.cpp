// Finds choices and delays by visiting the table of the profile, and changes one in a copy of it.
#include "model/config/knobs/other_choices.hpp"

#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {
namespace {

/// Calls `use(key, member, type)` for each knob of a DDS profile that its implementation has.
template <class Use>
class KnobVisitor {
 public:
  KnobVisitor(std::string prefix, Use& use) : prefix_{std::move(prefix)}, use_{use} {}

  template <class Member, class Type>
  void knob(std::string_view key, Member&& member, const Type& type, std::string_view,
            Presence presence = Presence::required) {
    if (presence == Presence::of_others || key == implementation_key) return;
    use_(prefix_ + std::string{key}, member, type);
  }
  void section(std::string_view key, auto& member, std::string_view, Presence presence = {},
               const auto&... context) {
    if (presence == Presence::of_others) return;
    KnobVisitor inner{prefix_ + std::string{key} + ".", use_};
    if constexpr (requires { member.has_value(); }) {  // an optional table
      if (member) visit_knobs(inner, *member, context...);
    } else {
      visit_knobs(inner, member, context...);
    }
  }
  void rule(bool, std::string_view, std::string_view) {}

 private:
  std::string prefix_;
  Use& use_;
};

void visit(auto& dds, auto use) {
  KnobVisitor visitor{std::string{dds_key} + ".", use};
  visit_knobs(visitor, dds);
}

template <class Enum>
Enum choice(std::size_t number, const ChoiceType<Enum>&) {
  return static_cast<Enum>(number);
}

/// The profile with another value of this knob.
template <class Member>
DdsProfile with(const DdsProfile& dds, const std::string& key, const Member& value) {
  DdsProfile changed = dds;
  visit(changed, [&](const std::string& candidate, auto& member, const auto&) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, Member>) {
      if (candidate == key) member = value;
    }
  });
  return changed;
}

}  // namespace

std::vector<OtherChoices> other_choices(const DdsProfile& dds) {
  std::vector<OtherChoices> list;
  visit(dds, [&](const std::string& key, const auto& member, const auto& type) {
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (requires { choice(0, type); }) {
      const auto names = type.names();
      OtherChoices knob{key, names.at(static_cast<std::size_t>(member)), {}};
      for (std::size_t k = 0; k < names.size(); ++k) {
        const Member other = choice(k, type);
        if (other != member) knob.others.push_back(with(dds, key, other));
      }
      list.push_back(std::move(knob));
    } else if constexpr (std::same_as<Member, Nanoseconds>) {
      if (!type.contains(0)) return;
      const Member other{member.count() == 0 ? 1 : 0};
      list.push_back({key, print_duration(member), {with(dds, key, other)}});
    }
  });
  return list;
}

}  // namespace stormproof::model::config
