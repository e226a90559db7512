// Works out the transitions of a run of states, and what they fulfil; stores nothing.
#pragma once

#include <cstdint>
#include <exception>
#include <vector>

#include "goals.hpp"
#include "moves.hpp"

namespace core {

// What was found in the states from `first` on, in their order.
struct Batch {
  struct Target {
    uint32_t source;
    uint64_t hash;
  };
  struct Reached {
    uint32_t state;
    int32_t goal;
  };

  uint64_t first = 0, end = 0;
  std::vector<Target> targets;
  std::vector<uint64_t> words;  // of the targets
  std::vector<Reached> reached;
  std::exception_ptr error;  // ended the work at a state after all those of `targets`

  void begin(uint64_t from) {
    first = end = from;
    targets.clear();
    words.clear();
    reached.clear();
    error = nullptr;
  }
};

class Expander {
 public:
  Expander(const Model& model, const Layout& layout, const std::vector<Predicate>& goals)
      : machine_(model, layout), moves_(model, machine_), goals_(layout, goals) {}

  Machine& machine() { return machine_; }
  bool all_closed() const { return goals_.all_closed(); }

  // Adds one state and its transitions to a batch.
  void expand(uint32_t number, const uint64_t* words, Batch& batch) {
    machine_.load(words);
    const size_t before = batch.targets.size();
    moves_.each(words, [&](const Edges&) {
      const auto& packed = machine_.packed;
      const uint64_t hash = hash_of(packed.data(), static_cast<int>(packed.size()));
      batch.targets.push_back({number, hash});
      batch.words.insert(batch.words.end(), packed.begin(), packed.end());
    });
    goals_.look(words, batch.targets.size() == before, machine_, [&](int32_t goal) {
      batch.reached.push_back({number, goal});
      goals_.close(goal);
    });
    batch.end = number + 1;
  }

 private:
  Machine machine_;
  Moves moves_;
  Goals goals_;
};

}  // namespace core
