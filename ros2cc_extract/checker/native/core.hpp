// The core's door: a search over one model, from integer tables to states.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "explore.hpp"
#include "model.hpp"

namespace core {

// Called with states, transitions, bytes about to be allocated, and whether states are still
// being explored; true stops the search.
using Ask = std::function<bool(uint64_t, uint64_t, uint64_t, bool)>;

struct Answer {
  std::vector<std::vector<int64_t>> path;  // locations, then values; empty: none was found
  int64_t cycle_start = -1;
  int32_t end = 0;  // 1 deadlock, 2 time passes for ever
  double seconds = 0;
};

struct Result {
  uint64_t states = 0, transitions = 0;
  bool is_complete = false;
  bool is_full = false;  // whether there are more states than were allowed
  std::vector<Answer> goals, lassos;
};

// What all states of a lasso fulfil, and what its first does; without that it starts initially.
using LassoQuestion = std::pair<Predicate, std::optional<Predicate>>;

// Answers goals and lassos by one exploration that stores every state.
Result search(const Model& model, const std::vector<Predicate>& goals,
              const std::vector<LassoQuestion>& lassos, bool is_fair, uint64_t max_states,
              Jobs jobs, const Ask& ask);

// Answers goals by an exploration that stores no state with a committed location.
Result search_chains(const Model& model, const std::vector<Predicate>& goals,
                     uint64_t max_states, const Ask& ask);

}  // namespace core
