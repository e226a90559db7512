// Predicates over states, remembered by the part of the state that they read.
#pragma once

#include <cstdint>
#include <vector>

#include "machine.hpp"
#include "store.hpp"

namespace core {

// Up to 64 predicates that read the same part of the state.
class PredicateGroup {
 public:
  PredicateGroup(const Layout& layout, const Predicate& first)
      : reads_deadlock_(first.reads_deadlock),
        mask_(layout.words(), 0),
        key_(layout.words()),
        log_(layout.words() <= 4 ? 13 : 9),
        entries_((size_t{1} << log_) * (layout.words() + 1)),
        known_(size_t{1} << log_, 0) {
    for (const int32_t slot : first.variables) cover(layout.variables()[slot]);
    for (const int32_t process : first.processes) cover(layout.locations()[process]);
    nodes_.push_back(first.node);
  }

  // Takes another predicate if it reads the same part.
  bool add(const Layout& layout, const Predicate& other) {
    if (nodes_.size() == 64) return false;
    const PredicateGroup alike(layout, other, 0);
    if (alike.mask_ != mask_ || alike.reads_deadlock_ != reads_deadlock_) return false;
    nodes_.push_back(other.node);
    return true;
  }

  bool reads_deadlock() const { return reads_deadlock_; }

  // One bit for each predicate; `load` brings the state into the machine when it is needed.
  template <class Load>
  uint64_t bits(const uint64_t* words, bool is_deadlock, Machine& machine, Load&& load) {
    const size_t width = mask_.size();
    for (size_t i = 0; i < width; ++i) key_[i] = words[i] & mask_[i];
    const uint64_t at = hash_of(key_.data(), static_cast<int>(width)) & ((uint64_t{1} << log_) - 1);
    uint64_t* entry = &entries_[at * (width + 1)];
    const uint8_t mark = 1 + is_deadlock;
    bool same = known_[at] == mark;
    for (size_t i = 0; same && i < width; ++i) same = entry[i] == key_[i];
    if (same) return entry[width];
    load();
    machine.is_deadlock = is_deadlock;
    uint64_t result = 0;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      if (machine.evaluate(nodes_[i]) != 0) result |= uint64_t{1} << i;
    }
    for (size_t i = 0; i < width; ++i) entry[i] = key_[i];
    entry[width] = result;
    known_[at] = mark;
    return result;
  }

 private:
  // Only to compare masks: no cache.
  PredicateGroup(const Layout& layout, const Predicate& first, int)
      : reads_deadlock_(first.reads_deadlock), mask_(layout.words(), 0) {
    for (const int32_t slot : first.variables) cover(layout.variables()[slot]);
    for (const int32_t process : first.processes) cover(layout.locations()[process]);
  }

  void cover(const Field& field) { mask_[field.word] |= field.ones << field.shift; }

  bool reads_deadlock_;
  std::vector<uint64_t> mask_, key_;
  int log_ = 0;  // of the number of states that are remembered
  std::vector<uint64_t> entries_;
  std::vector<uint8_t> known_;
  std::vector<int32_t> nodes_;
};

}  // namespace core
