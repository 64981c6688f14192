// The product's order and the mistaken ones.
#include "checker/engines/tables/event_order_rules.hpp"

#include "model/event_order.hpp"

namespace stormproof::tables {

using checker::OrderRule;
using smt::SymbolicBool;
using smt::SymbolicInt;

namespace {

SymbolicBool has(const SymbolicEvent& event, Role role) {
  return event.role == static_cast<int>(role);
}

/// "Receptions come before decisions, the channel starts last, everything else goes by insertion",
/// read for each pair of events on its own.
SymbolicBool pairwise(const SymbolicEvent& a, const SymbolicEvent& b) {
  const SymbolicBool first = (has(a, Role::reception) && has(b, Role::decision)) ||
                             (has(b, Role::service_start) && !has(a, Role::service_start));
  const SymbolicBool second = (has(b, Role::reception) && has(a, Role::decision)) ||
                              (has(a, Role::service_start) && !has(b, Role::service_start));
  return first || (!second && a.insertion < b.insertion);
}

}  // namespace

const char* name_of(Role role) {
  switch (role) {
    case Role::reception:
      return "reception";
    case Role::decision:
      return "decision";
    case Role::other:
      return "other event";
    case Role::service_start:
      return "start of service";
  }
  return "";
}

SymbolicEvent SymbolicEvent::named(const std::string& name) {
  return {SymbolicInt::named(name + ".time"), SymbolicInt::named(name + ".class"),
          SymbolicInt::named(name + ".insertion"), SymbolicInt::named(name + ".role")};
}

Expr SymbolicEvent::valid() const {
  const SymbolicBool in_range = event_class >= 0 && event_class <= 2 && insertion >= 0 &&
                                insertion < (std::int64_t{1} << 62) && role >= 0 && role <= 3;
  return in_range.expr();
}

Expr before(OrderRule rule, const SymbolicEvent& a, const SymbolicEvent& b) {
  const auto order = [](const SymbolicEvent& event) {
    return model::packed_order(event.event_class, event.insertion);
  };
  switch (rule) {
    case OrderRule::time_class_insertion:
      return model::is_before(a.time, order(a), b.time, order(b)).expr();
    case OrderRule::pairwise_prose:
      return (a.time < b.time || (a.time == b.time && pairwise(a, b))).expr();
    case OrderRule::without_insertion:
      return model::is_before(a.time, a.event_class, b.time, b.event_class).expr();
    case OrderRule::without_class:
      return model::is_before(a.time, a.insertion, b.time, b.insertion).expr();
  }
  return smt::SymbolicContext::current().bool_val(false);
}

OrderRule order_rule(const checker::CheckRequest& request) {
  return request.mutant != nullptr ? request.mutant->order : OrderRule::time_class_insertion;
}

}  // namespace stormproof::tables
