// One integer for each ACKNACK that is asked for, in nanoseconds after the first; those that nobody
// needs may be lost, so they do not occur.
#include "checker/evidence/conform/requests_exact.hpp"

#include <chrono>
#include <map>
#include <string>

#include "checker/engines/smt/deadline.hpp"

namespace stormproof::conform {

namespace {

/// With the plain solver: those with tactics have timers of their own
/// (checker/engines/smt/deadline.hpp).
class Question {
 public:
  Question(const Relation& relation, const Requests& requests)
      : solver_{context_, z3::solver::simple()} {
    for (std::size_t k = 0; k < relation.answers.size(); ++k) {
      const std::string name = std::to_string(k);
      arrives_.push_back(context_.int_const(("arrives_" + name).c_str()));
      is_received_.push_back(context_.bool_const(("received_" + name).c_str()));
    }
    origin_ns_ = relation.answers.empty() ? 0 : relation.answers.front().time_ns;
    for (std::size_t k = 0; k < arrives_.size(); ++k) {
      const Arrival& window = requests.arrivals()[k];
      within(is_received_[k], k, window.from_ns, window.to_ns);
    }
    order();
  }

  /// The next demand. An ACKNACK causes one transmission of what it asks for, so the demands of a
  /// descriptor are served by ever later ones.
  void demand(const Relation& relation, const Demand& one) {
    const z3::expr by = context_.int_const(("by_" + std::to_string(by_.size())).c_str());
    z3::expr_vector ways{context_};
    for (std::size_t k = 0; k < relation.answers.size(); ++k) {
      if (!relation.answers[k].asks_for(one.descriptor)) continue;
      ways.push_back(by == context_.int_val(std::uint64_t{k}) && is_received_[k] &&
                     arrives_[k] >= number(one.from_ns) && arrives_[k] <= number(one.to_ns));
    }
    solver_.add(z3::mk_or(ways));
    const auto [before, is_first] = last_of_.try_emplace(one.descriptor, by_.size());
    if (!is_first) solver_.add(by > by_[before->second]);
    before->second = by_.size();
    by_.push_back(by);
  }

  /// The answer that serves the n-th demand in the solution.
  std::size_t served_by(std::size_t n) {
    return static_cast<std::size_t>(solution().eval(by_[n], true).get_numeral_uint64());
  }

  z3::check_result solve(const SearchLimits& limits) {
    // Where Z3 counts no steps, the watch ends the work.
    constexpr std::chrono::minutes long_enough{10};
    z3::params parameters{context_};
    parameters.set("rlimit", limits.steps);
    solver_.set(parameters);
    try {
      const smt::Deadline deadline{context_, long_enough, limits.interrupted};
      return solver_.check();
    } catch (const z3::exception&) {
      return z3::unknown;  // out of steps
    } catch (const smt::Interrupted&) {
      return z3::unknown;
    }
  }

  /// When answer `k` arrives in the solution; nothing if it is lost.
  std::optional<std::int64_t> arrival(std::size_t k) {
    if (!solution().eval(is_received_[k], true).is_true()) return std::nullopt;
    return origin_ns_ + solution().eval(arrives_[k], true).get_numeral_int64();
  }

 private:
  const z3::model& solution() {
    if (!model_) model_ = solver_.get_model();
    return *model_;
  }
  z3::expr number(std::int64_t time_ns) { return context_.int_val(time_ns - origin_ns_); }

  void within(const z3::expr& condition, std::size_t k, std::int64_t from_ns, std::int64_t to_ns) {
    solver_.add(
        z3::implies(condition, arrives_[k] >= number(from_ns) && arrives_[k] <= number(to_ns)));
  }

  /// `arrived_by_k` is the latest arrival among the first k: datagrams do not overtake each other.
  void order() {
    std::optional<z3::expr> latest;
    for (std::size_t k = 0; k < arrives_.size(); ++k) {
      const z3::expr so_far = context_.int_const(("arrived_by_" + std::to_string(k)).c_str());
      if (latest) {
        solver_.add(so_far >= *latest);
        solver_.add(z3::implies(is_received_[k], arrives_[k] >= *latest));
      }
      solver_.add(z3::implies(is_received_[k], so_far >= arrives_[k]));
      latest = so_far;
    }
  }

  z3::context context_;
  z3::solver solver_;
  std::vector<z3::expr> arrives_;
  std::vector<z3::expr> is_received_;
  std::vector<z3::expr> by_;                      ///< by demand: the answer that serves it
  std::map<std::uint32_t, std::size_t> last_of_;  ///< by descriptor: its last demand so far
  std::optional<z3::model> model_;
  std::int64_t origin_ns_ = 0;
};

}  // namespace

ExactAnswer decide(const Relation& relation, const Requests& requests,
                   const std::vector<Demand>& demands, const SearchLimits& limits) {
  ExactAnswer answer;
  Question question{relation, requests};
  for (const Demand& one : demands) question.demand(relation, one);
  switch (question.solve(limits)) {
    case z3::unsat:
      answer.kind = ExactAnswer::Kind::impossible;
      return answer;
    case z3::unknown:
      return answer;
    case z3::sat:
      break;
  }
  answer.kind = ExactAnswer::Kind::possible;
  answer.arrivals = requests.arrivals();
  for (std::size_t n = 0; n < demands.size(); ++n) {
    const std::size_t k = question.served_by(n);
    const std::int64_t at = question.arrival(k).value_or(demands[n].to_ns);
    answer.arrivals[k] = {at, at, true};
    answer.request.push_back(k);
  }
  return answer;
}

}  // namespace stormproof::conform
