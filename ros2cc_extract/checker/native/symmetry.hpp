// Orders the members of families, and judges picks among them: see symmetry.py.
#pragma once

#include <cstdint>
#include <vector>

#include "machine.hpp"

namespace core {

// The edges that move together, sender first.
using Edges = std::vector<int32_t>;

class Symmetry : public PickJudge {
 public:
  // `moving` holds the edges of the step under way; the sender alone until it has receivers.
  Symmetry(const Model& model, Machine& machine, const Edges& moving)
      : model_(model), machine_(machine), moving_(moving) {
    machine.judge = this;
  }

  // Notes which pointers are dead in the state that was loaded.
  void note_source() {
    if (model_.picks.empty()) return;
    dead_.clear();
    for (const Family& family : model_.families) {
      for (const Pointer& pointer : family.pointers) {
        if (machine_.is_dead(pointer)) dead_.push_back(pointer.slot);
      }
    }
  }

  void begin_step() {
    is_uneven_ = false;
    last_ = {};
  }

  bool is_uneven() const { return is_uneven_; }

  // What was picked before the receivers were known; picks in updates are judged after it.
  struct Last {
    int32_t family = -1;
    uint64_t names = 0;
  };
  Last last() const { return last_; }
  void back_to(const Last& last) { last_ = last; }

  // A pick takes the lowest name. That does not distinguish members if there is but one to take,
  // if the choice is that of the pick before, or if all are alike and none takes part in the
  // step: then an exchange that changes nothing else makes any of them the lowest.
  void picked(const Pick& pick, uint64_t names) override {
    const Family& family = model_.families[pick.family];
    if (names == 0) {
      is_uneven_ = is_uneven_ || member(family, pick.fallback) >= 0;
      return;
    }
    const bool is_repeated = last_.family == pick.family && last_.names == names;
    last_ = {pick.family, names};
    if (is_repeated || (names & (names - 1)) == 0) return;
    int32_t first = -1;
    for (uint64_t left = names; left != 0; left &= left - 1) {
      const int32_t other = member(family, __builtin_ctzll(left));
      if (other < 0 || moves(family.processes[other]) || is_pointed_to(family, other) ||
          (first >= 0 && !alike(family, first, other))) {
        is_uneven_ = true;
        return;
      }
      if (first < 0) first = other;
    }
  }

  // Puts the members of every family in order.
  void order() {
    for (const Family& family : model_.families) order(family);
  }

 private:
  static int32_t member(const Family& family, int64_t name) {
    for (size_t i = 0; i < family.names.size(); ++i) {
      if (family.names[i] == name) return static_cast<int32_t>(i);
    }
    return -1;
  }

  bool moves(int32_t process) const {
    for (const int32_t edge : moving_) {
      if (model_.edges[edge].process == process) return true;
    }
    return false;
  }

  bool is_pointed_to(const Family& family, int32_t member) const {
    for (const Pointer& pointer : family.pointers) {
      if (machine_.value[pointer.slot] != family.names[member]) continue;
      bool was_dead = false;
      for (const int32_t slot : dead_) was_dead = was_dead || slot == pointer.slot;
      if (!was_dead || machine_.is_written(pointer.slot)) return true;
    }
    return false;
  }

  bool alike(const Family& family, int32_t a, int32_t b) const {
    if (machine_.at[family.processes[a]] != machine_.at[family.processes[b]]) return false;
    for (size_t i = 0; i < family.parts[a].size(); ++i) {
      if (machine_.value[family.parts[a][i]] != machine_.value[family.parts[b][i]]) return false;
    }
    return true;
  }

  bool less(const Family& family, int32_t a, int32_t b) const {
    const int32_t at_a = machine_.at[family.processes[a]], at_b = machine_.at[family.processes[b]];
    if (at_a != at_b) return at_a < at_b;
    for (size_t i = 0; i < family.parts[a].size(); ++i) {
      const int32_t value_a = machine_.value[family.parts[a][i]];
      const int32_t value_b = machine_.value[family.parts[b][i]];
      if (value_a != value_b) return value_a < value_b;
    }
    for (const int32_t named : pointed_) {
      if ((named == a) != (named == b)) return named == b;
    }
    return false;
  }

  void order(const Family& family) {
    pointed_.clear();  // the member that each pointer names; -1: none, or the pointer is dead
    for (const Pointer& pointer : family.pointers) {
      const bool is_dead = machine_.is_dead(pointer);
      pointed_.push_back(is_dead ? -1 : member(family, machine_.value[pointer.slot]));
      if (is_dead && machine_.value[pointer.slot] != pointer.initial) {
        machine_.set(pointer.slot, pointer.initial);
      }
    }
    const int32_t count = static_cast<int32_t>(family.processes.size());
    order_.resize(count);
    bool is_ordered = true;
    for (int32_t i = 0; i < count; ++i) {
      int32_t place = i;
      for (; place > 0 && less(family, i, order_[place - 1]); --place) {
        order_[place] = order_[place - 1];
        is_ordered = false;
      }
      order_[place] = i;
    }
    if (!is_ordered) rearrange(family);
  }

  void rearrange(const Family& family) {
    const size_t width = family.parts[0].size();
    old_.clear();
    for (size_t m = 0; m < order_.size(); ++m) {
      old_.push_back(machine_.at[family.processes[m]]);
      for (const int32_t slot : family.parts[m]) old_.push_back(machine_.value[slot]);
    }
    for (size_t to = 0; to < order_.size(); ++to) {
      const int32_t of = order_[to];
      if (static_cast<size_t>(of) == to) continue;
      const int32_t* values = &old_[of * (width + 1)];
      if (machine_.at[family.processes[to]] != *values) {
        machine_.move(family.processes[to], *values);
      }
      for (size_t i = 0; i < width; ++i) {
        const int32_t slot = family.parts[to][i];
        if (machine_.value[slot] != values[i + 1]) machine_.set(slot, values[i + 1]);
      }
      for (size_t p = 0; p < pointed_.size(); ++p) {
        if (pointed_[p] == of) machine_.set(family.pointers[p].slot, family.names[to]);
      }
    }
  }

  const Model& model_;
  Machine& machine_;
  const Edges& moving_;
  std::vector<int32_t> dead_, pointed_, order_, old_;
  Last last_;
  bool is_uneven_ = false;
};

}  // namespace core
