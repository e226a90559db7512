// What is looked for in every state, in groups of predicates that read the same part of it.
#pragma once

#include <cstdint>
#include <vector>

#include "predicates.hpp"

namespace core {

class Goals {
 public:
  Goals(const Layout& layout, const std::vector<Predicate>& goals) : open_(goals.size()) {
    for (size_t i = 0; i < goals.size(); ++i) group(layout, goals[i], static_cast<int32_t>(i));
  }

  bool all_closed() const { return open_ == 0; }

  // Calls found(goal) for each open goal that the state fulfils; the machine holds the state.
  template <class Found>
  void look(const uint64_t* words, bool is_deadlock, Machine& machine, Found&& found) {
    for (Group& group : groups_) {
      if (group.open == 0) continue;
      const bool tells = is_deadlock && group.predicates.reads_deadlock();
      uint64_t hit = group.open & group.predicates.bits(words, tells, machine, [] {});
      for (; hit != 0; hit &= hit - 1) found(group.goals[__builtin_ctzll(hit)]);
    }
  }

  // Nobody looks for this goal any longer.
  void close(int32_t goal) {
    for (Group& group : groups_) {
      for (size_t i = 0; i < group.goals.size(); ++i) {
        if (group.goals[i] == goal) group.open &= ~(uint64_t{1} << i);
      }
    }
    --open_;
  }

 private:
  struct Group {
    PredicateGroup predicates;
    std::vector<int32_t> goals;
    uint64_t open;
  };

  void group(const Layout& layout, const Predicate& goal, int32_t number) {
    for (Group& group : groups_) {
      if (group.predicates.add(layout, goal)) {
        group.open |= uint64_t{1} << group.goals.size();
        group.goals.push_back(number);
        return;
      }
    }
    groups_.push_back({PredicateGroup(layout, goal), {number}, 1});
  }

  std::vector<Group> groups_;
  size_t open_;
};

}  // namespace core
