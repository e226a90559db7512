// Maximal paths that stay inside a predicate: the twin of liveness.py.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "explore.hpp"

namespace core {

enum End : int32_t { NO_END = 0, DEADLOCK_END = 1, IDLE_END = 2 };

struct Lasso {
  std::vector<uint32_t> states;  // from the start; empty when there is none
  int64_t cycle_start = -1;      // index of the state that follows the last
  End end = NO_END;
};

struct Stopped {};

// One liveness question over an explored graph; edges are worked out again where needed.
class LassoSearch {
 public:
  LassoSearch(const Model& model, const Exploration& graph, const Predicate& inside,
              const Predicate* start, const Watch& watch)
      : model_(model),
        graph_(graph),
        machine_(model, graph.layout()),
        moves_(model, machine_),
        inside_(graph.layout(), inside),
        watch_(watch),
        colours_(graph.states().size(), UNKNOWN) {
    if (start != nullptr) start_.emplace_back(graph.layout(), *start);
  }

  Lasso run() {
    return for_each_start([this](uint32_t start) {
      if (colours_[start] != UNKNOWN) return Lasso{};
      const uint32_t turn = turning_point(start);
      return turn == kNone ? Lasso{} : nearest(start, turn);
    });
  }

  Lasso run_fair();

 private:
  enum Colour : uint8_t { UNKNOWN, OPEN, DONE, OUTSIDE };
  static constexpr size_t kCandidates = 64, kCycleEffort = 4096;

  template <class Try>
  Lasso for_each_start(Try&& attempt) {
    const uint64_t last = start_.empty() ? std::min<uint64_t>(1, graph_.expanded())
                                         : graph_.expanded();
    for (uint64_t i = 0; i < last; ++i) {
      const uint32_t number = static_cast<uint32_t>(i);
      look();
      if (!start_.empty() && !holds(start_[0], number)) continue;
      if (!is_inside(number)) continue;
      Lasso found = attempt(number);
      if (!found.states.empty()) return found;
    }
    return {};
  }

  void look() {
    // The clock is read every few steps only: a step may be as short as a look at a cache.
    if (++steps_ % 64 == 0 && pulse_.is_due(steps_) &&
        watch_(graph_.states().size(), graph_.transitions(), 0)) {
      throw Stopped{};
    }
  }

  bool holds(PredicateGroup& predicate, uint32_t number) {
    const uint64_t* words = graph_.states()[number];
    const bool is_deadlock = predicate.reads_deadlock() && end_of(number) == DEADLOCK_END;
    return predicate.bits(words, is_deadlock, machine_, [&] { machine_.load(words); }) != 0;
  }

  bool is_inside(uint32_t number) {
    if (number >= graph_.expanded()) return false;
    if (colours_[number] == UNKNOWN && !holds(inside_, number)) colours_[number] = OUTSIDE;
    return colours_[number] != OUTSIDE;
  }

  // Calls visit(target, edges) for each transition of a state; returns how a path may end here.
  template <class Visit>
  End each(uint32_t number, Visit&& visit) {
    look();
    const uint64_t* words = graph_.states()[number];
    machine_.load(words);
    bool any = false, urgent = moves_.stops_time();
    moves_.each(words, [&](const Edges& edges) {
      any = true;
      urgent = urgent || moves_.is_urgent(edges);
      visit(graph_.states().find(machine_.packed.data()), edges);
    });
    return !any ? DEADLOCK_END : urgent ? NO_END : IDLE_END;
  }

  std::vector<uint32_t> successors(uint32_t number) {
    std::vector<uint32_t> result;
    if (number < graph_.expanded()) {
      each(number, [&](uint32_t target, const Edges&) { result.push_back(target); });
    }
    return result;
  }

  End end_of(uint32_t number) {
    return each(number, [](uint32_t, const Edges&) {});
  }

  struct Frame {
    uint32_t state;
    size_t first, next;
  };

  // Depth-first search for an end or a state on a cycle; colours what cannot reach one.
  uint32_t turning_point(uint32_t start) {
    std::vector<uint32_t> targets;
    std::vector<Frame> stack;
    auto enter = [&](uint32_t state) {
      const size_t first = targets.size();
      const End end = each(state, [&](uint32_t t, const Edges&) { targets.push_back(t); });
      colours_[state] = OPEN;
      stack.push_back({state, first, first});
      return end != NO_END;
    };
    if (enter(start)) return start;
    while (!stack.empty()) {
      Frame& frame = stack.back();
      if (frame.next == targets.size()) {
        colours_[frame.state] = DONE;
        targets.resize(frame.first);
        stack.pop_back();
        continue;
      }
      const uint32_t target = targets[frame.next++];
      if (colours_[target] == OPEN) return target;
      if (colours_[target] == DONE || !is_inside(target)) continue;
      if (enter(target)) return target;
    }
    return kNone;
  }

  Lasso nearest(uint32_t start, uint32_t known) {
    for (const uint32_t candidate : breadth_first(start)) {
      if (end_of(candidate) != NO_END) return through(start, candidate);
      if (!path(candidate, candidate, kCycleEffort).empty()) return through(start, candidate);
    }
    return through(start, known);
  }

  std::vector<uint32_t> breadth_first(uint32_t start) {
    std::vector<uint32_t> order{start};
    std::unordered_map<uint32_t, bool> seen{{start, true}};
    for (size_t i = 0; i < order.size() && order.size() <= kCandidates; ++i) {
      for (const uint32_t target : successors(order[i])) {
        if (is_inside(target) && seen.emplace(target, true).second) order.push_back(target);
      }
    }
    if (order.size() > kCandidates) order.resize(kCandidates);
    return order;
  }

  Lasso through(uint32_t start, uint32_t turn) {
    Lasso lasso;
    lasso.states = turn == start ? std::vector<uint32_t>{start} : path(start, turn, 0);
    lasso.end = end_of(turn);
    if (lasso.end != NO_END) return lasso;
    const std::vector<uint32_t> cycle = path(turn, turn, 0);
    lasso.cycle_start = static_cast<int64_t>(lasso.states.size()) - 1;
    lasso.states.insert(lasso.states.end(), cycle.begin() + 1, cycle.end() - 1);
    return lasso;
  }

  // The shortest path inside of at least one step; empty when there is none, or none within
  // `limit` states if that is not 0.
  std::vector<uint32_t> path(uint32_t start, uint32_t goal, size_t limit) {
    std::unordered_map<uint32_t, uint32_t> before;
    std::deque<uint32_t> waiting{start};
    while (!waiting.empty()) {
      const uint32_t state = waiting.front();
      waiting.pop_front();
      for (const uint32_t target : successors(state)) {
        if (!is_member(target)) continue;
        if (target == goal) {
          std::vector<uint32_t> result{target, state};
          while (result.back() != start) result.push_back(before.at(result.back()));
          std::reverse(result.begin(), result.end());
          return result;
        }
        if (target != start && before.emplace(target, state).second) waiting.push_back(target);
      }
      if (limit != 0 && before.size() > limit) return {};
    }
    return {};
  }

  bool is_member(uint32_t state) {
    return members_.empty() ? is_inside(state) : members_.count(state) != 0;
  }

  // -- weak fairness ---------------------------------------------------------------------

  using Bits = std::vector<uint64_t>;
  struct Goal {
    uint32_t state, successor;  // kNone: a process is disabled in `state`
  };

  Bits movers(const Edges& edges) const {
    Bits bits((model_.locations.size() + 63) / 64, 0);
    for (const int32_t edge : edges) {
      const int32_t process = model_.edges[edge].process;
      bits[process >> 6] |= uint64_t{1} << (process & 63);
    }
    return bits;
  }

  Lasso fair_in(uint32_t start, std::vector<uint32_t>& component);
  std::vector<Goal> fair_goals(const std::vector<uint32_t>& component);
  void tour(Lasso& lasso, const std::vector<Goal>& goals);

  const Model& model_;
  const Exploration& graph_;
  Machine machine_;
  Moves moves_;
  PredicateGroup inside_;
  std::vector<PredicateGroup> start_;  // none: the initial state
  const Watch& watch_;
  std::vector<uint8_t> colours_;
  // While a fair cycle is built: the component that paths must not leave.
  std::unordered_map<uint32_t, bool> members_;
  Pulse pulse_;
  uint64_t steps_ = 0;
};

// Tarjan's components without recursion; the first fair one from the first start counts.
inline Lasso LassoSearch::run_fair() {
  std::vector<uint32_t> numbers(graph_.states().size(), kNone), low(numbers.size());
  uint32_t counter = 0;
  struct Visit {
    uint32_t state;
    std::vector<uint32_t> targets;
    size_t next;
  };
  return for_each_start([&](uint32_t start) {
    if (numbers[start] != kNone) return Lasso{};
    std::vector<Visit> stack;
    std::vector<uint32_t> trail;
    auto enter = [&](uint32_t state) {
      numbers[state] = low[state] = counter++;
      trail.push_back(state);
      stack.push_back({state, successors(state), 0});
    };
    enter(start);
    while (!stack.empty()) {
      Visit& top = stack.back();
      const uint32_t state = top.state;
      if (top.next < top.targets.size()) {
        const uint32_t target = top.targets[top.next++];
        if (!is_inside(target) || colours_[target] == DONE) continue;
        if (numbers[target] == kNone) {
          enter(target);
        } else {
          low[state] = std::min(low[state], numbers[target]);
        }
        continue;
      }
      stack.pop_back();
      if (!stack.empty()) {
        low[stack.back().state] = std::min(low[stack.back().state], low[state]);
      }
      if (low[state] != numbers[state]) continue;
      std::vector<uint32_t> component;
      do {
        component.push_back(trail.back());
        colours_[trail.back()] = DONE;
        trail.pop_back();
      } while (component.back() != state);
      Lasso lasso = fair_in(start, component);
      if (!lasso.states.empty()) return lasso;
    }
    return Lasso{};
  });
}

inline Lasso LassoSearch::fair_in(uint32_t start, std::vector<uint32_t>& component) {
  std::sort(component.begin(), component.end());
  const uint32_t turn = component[0];
  Lasso lasso;
  if (component.size() == 1) {
    bool loops = false;
    const End end = each(turn, [&](uint32_t t, const Edges&) { loops = loops || t == turn; });
    if (end == DEADLOCK_END) {
      lasso.states = turn == start ? std::vector<uint32_t>{start} : path(start, turn, 0);
      lasso.end = DEADLOCK_END;
      return lasso;
    }
    if (!loops) return lasso;
  }
  for (const uint32_t state : component) members_[state] = true;
  const std::vector<Goal> goals = fair_goals(component);
  if (!goals.empty()) {
    members_.clear();
    lasso.states = turn == start ? std::vector<uint32_t>{start} : path(start, turn, 0);
    lasso.cycle_start = static_cast<int64_t>(lasso.states.size()) - 1;
    for (const uint32_t state : component) members_[state] = true;
    tour(lasso, goals);
  }
  members_.clear();
  return lasso;
}

// For each process a state where it is disabled or a step in which it moves; empty if one has none.
inline std::vector<LassoSearch::Goal> LassoSearch::fair_goals(
    const std::vector<uint32_t>& component) {
  const size_t count = model_.locations.size();
  std::vector<Goal> goals;
  std::vector<bool> served(count, false);
  size_t missing = count;
  auto note = [&](const Bits& bits, bool wanted, Goal goal) {
    bool is_used = false;
    for (size_t p = 0; p < count; ++p) {
      if (served[p] || ((bits[p >> 6] >> (p & 63) & 1) != 0) != wanted) continue;
      served[p] = is_used = true;
      --missing;
    }
    if (is_used) goals.push_back(goal);
  };
  for (const uint32_t state : component) {
    Bits enabled((count + 63) / 64, 0);
    each(state, [&](uint32_t target, const Edges& edges) {
      const Bits bits = movers(edges);
      for (size_t i = 0; i < bits.size(); ++i) enabled[i] |= bits[i];
      if (members_.count(target)) note(bits, true, {state, target});
    });
    note(enabled, false, {state, kNone});
    if (missing == 0) return goals;
  }
  return {};
}

inline void LassoSearch::tour(Lasso& lasso, const std::vector<Goal>& goals) {
  const uint32_t turn = lasso.states.back();
  auto walk_to = [&](uint32_t goal) {
    const std::vector<uint32_t> way = path(lasso.states.back(), goal, 0);
    lasso.states.insert(lasso.states.end(), way.begin() + 1, way.end());
  };
  const size_t first = lasso.states.size();
  for (const Goal& goal : goals) {
    if (lasso.states.back() != goal.state) walk_to(goal.state);
    if (goal.successor != kNone) lasso.states.push_back(goal.successor);
  }
  if (lasso.states.back() != turn || lasso.states.size() == first) walk_to(turn);
  lasso.states.pop_back();
}

}  // namespace core
