// Breadth-first exploration of all reachable states.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "moves.hpp"
#include "predicates.hpp"
#include "store.hpp"

namespace core {

// Called now and then with states, transitions and the bytes about to be allocated; true stops.
using Watch = std::function<bool(uint64_t, uint64_t, uint64_t)>;

// Says now and then that it is time to look at limits: by work done, and by the clock, as one
// state of a model with long loops may take as long as thousands of another.
class Pulse {
 public:
  bool is_due(uint64_t work) {
    if (work < next_ && std::chrono::steady_clock::now() < late_) return false;
    next_ = work + kWork;
    late_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
    return true;
  }
  static constexpr uint64_t kWork = 16384;

 private:
  uint64_t next_ = 0;
  std::chrono::steady_clock::time_point late_{};
};

struct Hit {
  uint32_t state = kNone;
  double seconds = 0;
};

class Exploration {
 public:
  Exploration(const Model& model, const std::vector<Predicate>& goals, bool stops_early)
      : layout_(model),
        machine_(model, layout_),
        moves_(model, machine_),
        states_(layout_.words()),
        hits_(goals.size()),
        open_(goals.size()),
        stops_early_(stops_early && !goals.empty()) {
    for (size_t i = 0; i < goals.size(); ++i) group(goals[i], static_cast<int32_t>(i));
    std::vector<uint64_t> first(layout_.words(), 0);
    pack_initial(model, first);
    states_.insert(first.data(), hash_of(first.data(), layout_.words()));
  }

  // Explores until all is known or `watch` says to stop; false in the second case.
  bool run(const Watch& watch) {
    const auto start = std::chrono::steady_clock::now();
    Pulse pulse;
    while (expanded_ < states_.size()) {
      if (pulse.is_due(expanded_ + states_.size()) &&
          watch(states_.size(), transitions_, 0)) {
        return false;
      }
      const uint64_t expanded = expanded_, transitions = transitions_;
      const bool is_done = expand_some(start);
      const uint64_t growth = states_.growth(found_.size());
      if (growth != 0 && watch(states_.size(), transitions, growth)) {
        // Targets that were not stored must not be looked for: their sources stay unexpanded.
        expanded_ = expanded;
        transitions_ = transitions;
        return false;
      }
      insert_found();
      if (is_done) return true;
    }
    is_complete_ = true;
    return true;
  }

  const Layout& layout() const { return layout_; }
  Machine& machine() { return machine_; }
  Moves& moves() { return moves_; }
  const States& states() const { return states_; }
  const Parents& parents() const { return parents_; }
  const std::vector<Hit>& hits() const { return hits_; }
  uint64_t expanded() const { return expanded_; }
  uint64_t transitions() const { return transitions_; }
  bool is_complete() const { return is_complete_; }

 private:
  struct Group {
    PredicateGroup predicates;
    std::vector<int32_t> goals;
    uint64_t open;
  };
  struct Found {
    uint32_t parent;
    uint64_t hash;
  };
  static constexpr size_t kBatch = 192;

  void group(const Predicate& goal, int32_t number) {
    for (Group& group : groups_) {
      if (group.predicates.add(layout_, goal)) {
        group.open |= uint64_t{1} << group.goals.size();
        group.goals.push_back(number);
        return;
      }
    }
    groups_.push_back({PredicateGroup(layout_, goal), {number}, 1});
  }

  void pack_initial(const Model& model, std::vector<uint64_t>& words) {
    size_t i = 0;
    for (const Field& field : layout_.locations()) {
      words[field.word] |= static_cast<uint64_t>(model.initial[i++]) << field.shift;
    }
    for (const Field& field : layout_.variables()) {
      words[field.word] |= static_cast<uint64_t>(model.initial[i++] - field.low) << field.shift;
    }
  }

  // Expands states until the batch is full; true when every goal is reached and that suffices.
  bool expand_some(std::chrono::steady_clock::time_point start) {
    while (expanded_ < states_.size() && found_.size() < kBatch) {
      const uint32_t number = static_cast<uint32_t>(expanded_++);
      const uint64_t* words = states_[number];
      machine_.load(words);
      const uint64_t before = transitions_;
      moves_.each(words, [&](const Edges&) {
        ++transitions_;
        const auto& packed = machine_.packed;
        const uint64_t hash = hash_of(packed.data(), static_cast<int>(packed.size()));
        states_.prefetch(hash);
        found_.push_back({number, hash});
        found_words_.insert(found_words_.end(), packed.begin(), packed.end());
      });
      look_for_goals(number, transitions_ == before, start);
      if (open_ == 0 && stops_early_) return true;
    }
    return false;
  }

  void look_for_goals(uint32_t number, bool is_deadlock,
                      std::chrono::steady_clock::time_point start) {
    for (Group& group : groups_) {
      if (group.open == 0) continue;
      const bool tells = is_deadlock && group.predicates.reads_deadlock();
      uint64_t hit =
          group.open & group.predicates.bits(states_[number], tells, machine_, [] {});
      group.open &= ~hit;
      for (; hit != 0; hit &= hit - 1) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        hits_[group.goals[__builtin_ctzll(hit)]] = {number, passed.count()};
        --open_;
      }
    }
  }

  void insert_found() {
    const size_t width = layout_.words();
    const uint64_t* words = found_words_.data();
    for (const Found& found : found_) {
      if (states_.insert(words, found.hash).second) parents_.child(found.parent);
      words += width;
    }
    found_.clear();
    found_words_.clear();
  }

  Layout layout_;
  Machine machine_;
  Moves moves_;
  States states_;
  Parents parents_;
  std::vector<Group> groups_;
  std::vector<Hit> hits_;
  size_t open_;
  bool stops_early_;
  std::vector<Found> found_;
  std::vector<uint64_t> found_words_;
  uint64_t expanded_ = 0, transitions_ = 0;
  bool is_complete_ = false;
};

}  // namespace core
