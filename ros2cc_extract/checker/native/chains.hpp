// Exploration that stores no state with a committed location: such a chain is run through anew
// from every state that it leaves, in the order of steps. Answers reachability only.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "explore.hpp"
#include "goals.hpp"

namespace core {

// The committed states that are reached from one state, each once, nearest first.
class Chain {
 public:
  static constexpr size_t kMost = 16;

  Chain(int words, Machine& machine, Moves& moves)
      : width_(words), machine_(machine), moves_(moves), words_((kMost + 1) * words) {}

  // Calls visit(place, words) for each transition whose target is not passed over, and
  // passed(place, words, is_deadlock) for the source and each state passed over, when its
  // transitions are through; the machine then holds it. Targets beyond `most` states are
  // visited like any other. Returns the number of transitions.
  template <class Visit, class Passed>
  uint64_t run(const uint64_t* source, size_t most, Visit&& visit, Passed&& passed) {
    begin(source);
    uint64_t transitions = 0;
    for (size_t place = 0; place < links_.size(); ++place) {
      const uint64_t before = transitions;
      each_target(place, [&](const uint64_t* target, bool is_committed) {
        ++transitions;
        if (!is_committed || !pass_over(target, place, most)) visit(place, target);
      });
      passed(place, at(place), transitions == before);
    }
    return transitions;
  }

  // Adds the states after the source up to a target, on the shortest way. What the search did
  // not expand before it knew the target is not expanded here: it may be an error.
  void extend(std::vector<uint64_t>& path, const uint64_t* source, const uint64_t* target) {
    begin(source);
    bool is_found = false;
    for (size_t place = 0; !is_found && place < links_.size(); ++place) {
      each_target(place, [&](const uint64_t* words, bool is_committed) {
        is_found = is_found || std::equal(words, words + width_, target);
        if (!is_found && is_committed) pass_over(words, place, kMost);
      });
      if (is_found) add_way(path, place);
    }
    path.insert(path.end(), target, target + width_);
  }

  // States passed over in the last run.
  size_t passed() const { return links_.size() - 1; }

  // Steps from the source to a place.
  uint32_t steps(size_t place) const { return links_[place].steps; }

 private:
  struct Link {
    size_t before;
    uint32_t steps;
  };

  const uint64_t* at(size_t place) const { return &words_[place * width_]; }

  void begin(const uint64_t* source) {
    links_.assign(1, {0, 0});
    std::copy(source, source + width_, words_.begin());
  }

  template <class Visit>
  void each_target(size_t place, Visit&& visit) {
    machine_.load(at(place));
    moves_.each(at(place), [&](const Edges& edges) {
      visit(machine_.packed.data(), moves_.leads_to_committed(edges));
    });
  }

  // False when the state has to be visited, as there are too many in this chain.
  bool pass_over(const uint64_t* words, size_t before, size_t most) {
    for (size_t place = 0; place < links_.size(); ++place) {
      if (std::equal(words, words + width_, at(place))) return true;
    }
    if (links_.size() > most) return false;
    std::copy(words, words + width_, &words_[links_.size() * width_]);
    links_.push_back({before, links_[before].steps + 1});
    return true;
  }

  void add_way(std::vector<uint64_t>& path, size_t place) const {
    if (place == 0) return;
    add_way(path, links_[place].before);
    path.insert(path.end(), at(place), at(place) + width_);
  }

  size_t width_;
  Machine& machine_;
  Moves& moves_;
  std::vector<uint64_t> words_;
  std::vector<Link> links_;
};

struct ChainHit {
  uint32_t state = kNone;       // the last one that is stored
  std::vector<uint64_t> words;  // of the state itself, if it is another one
  uint64_t depth = 0;
  double seconds = 0;
  bool is_settled = false;
};

class ChainExploration {
 public:
  ChainExploration(const Model& model, const std::vector<Predicate>& goals, uint64_t max_states)
      : layout_(model),
        machine_(model, layout_),
        moves_(model, machine_),
        chain_(layout_.words(), machine_, moves_),
        states_(layout_.words()),
        goals_(layout_, goals),
        hits_(goals.size()),
        stops_early_(!goals.empty()),
        max_states_(max_states) {
    const std::vector<uint64_t> first = initial_words(model, layout_);
    add(states_.insert(first.data(), hash_of(first.data(), layout_.words())).first, 0, 0);
  }

  // Explores until all is known or `watch` says to stop; false in the second case.
  bool run(const Watch& watch) {
    const auto start = std::chrono::steady_clock::now();
    Pulse pulse;
    for (; waiting_ > 0; ++depth_) {
      settle_hits();
      if (stops_early_ && goals_.all_closed()) return true;
      std::vector<uint32_t>& level = levels_[depth_ % kLevels];
      for (size_t next = 0; next < level.size();) {
        if (pulse.is_due(expanded_ + states_.size()) && watch(states_.size(), transitions_, 0)) {
          return false;
        }
        const uint64_t transitions = transitions_;
        next = expand_some(level, next, start);
        const uint64_t growth = states_.growth(found_.size());
        if (growth != 0 && watch(states_.size(), transitions, growth)) {
          transitions_ = transitions;
          return false;
        }
        if (!insert_found()) return false;
        if (stops_early_ && goals_.all_closed()) return true;
      }
      waiting_ -= level.size();
      level.clear();
    }
    settle_hits();
    is_complete_ = true;
    return true;
  }

  uint64_t size() const { return states_.size(); }
  const Layout& layout() const { return layout_; }
  uint64_t transitions() const { return transitions_; }
  bool is_complete() const { return is_complete_; }
  bool is_full() const { return is_full_; }

  Machine& machine() { return machine_; }

  // How a goal is reached in the fewest steps of those explored; null where it is not.
  const ChainHit* hit(size_t goal) const {
    return hits_[goal].state == kNone ? nullptr : &hits_[goal];
  }

  // The states up to one that fulfils a goal, one after the other.
  std::vector<uint64_t> path_of(const ChainHit& hit) {
    std::vector<uint32_t> stored{hit.state};
    while (stored.back() != 0) stored.push_back(*parents_[stored.back()]);
    std::vector<uint64_t> path(states_[0], states_[0] + layout_.words());
    for (size_t i = stored.size() - 1; i > 0; --i) {
      chain_.extend(path, states_[stored[i]], states_[stored[i - 1]]);
    }
    if (!hit.words.empty()) chain_.extend(path, states_[hit.state], hit.words.data());
    return path;
  }

 private:
  struct Found {
    uint32_t parent;
    uint32_t steps;
    uint64_t hash, transitions;
  };
  static constexpr size_t kBatch = 192;
  // Levels that wait at a time: a chain leads so many steps ahead, and one more.
  static constexpr uint64_t kLevels = 32;
  static_assert(Chain::kMost + 1 < kLevels);
  // Where each stored state runs through more than this many others, to store them is cheaper.
  static constexpr uint64_t kWorth = 4;
  static constexpr uint8_t kSettled = 0xff;

  // A state waits at a level, or will be expanded earlier than it was to be.
  void add(uint32_t number, uint32_t parent, uint64_t depth) {
    if (number == parents_.size()) {
      parents_.append();
      levels_of_.append();
    }
    *parents_[number] = parent;
    *levels_of_[number] = static_cast<uint8_t>(depth % kLevels);
    levels_[depth % kLevels].push_back(number);
    ++waiting_;
  }

  size_t expand_some(const std::vector<uint32_t>& level, size_t next,
                     std::chrono::steady_clock::time_point start) {
    while (next < level.size() && found_.size() < kBatch) {
      const uint32_t number = level[next++];
      if (*levels_of_[number] != depth_ % kLevels) continue;  // it was reached in fewer steps
      *levels_of_[number] = kSettled;
      ++expanded_;
      expand(number, start);
    }
    return next;
  }

  void expand(uint32_t number, std::chrono::steady_clock::time_point start) {
    const uint64_t before = transitions_;
    const size_t width = layout_.words();
    const bool is_worth = passed_ < kWorth * expanded_;
    transitions_ += chain_.run(
        states_[number], is_worth ? Chain::kMost : 0,
        [&](size_t place, const uint64_t* words) {
          const uint64_t hash = hash_of(words, static_cast<int>(width));
          states_.prefetch(hash);
          found_.push_back({number, chain_.steps(place) + 1, hash, before});
          found_words_.insert(found_words_.end(), words, words + width);
        },
        [&](size_t place, const uint64_t* words, bool is_deadlock) {
          goals_.look(words, is_deadlock, machine_, [&](int32_t goal) {
            ChainHit& hit = hits_[goal];
            const uint64_t depth = depth_ + chain_.steps(place);
            if (hit.state != kNone && hit.depth <= depth) return;
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            hit = {number, {}, depth, passed.count()};
            if (place > 0) hit.words.assign(words, words + width);
            if (depth == depth_) close(hit, goal);
          });
        });
    passed_ += chain_.passed();
  }

  // What was found within so many steps as are done cannot be found in fewer.
  void settle_hits() {
    for (size_t goal = 0; goal < hits_.size(); ++goal) {
      ChainHit& hit = hits_[goal];
      if (hit.state != kNone && hit.depth <= depth_) close(hit, static_cast<int32_t>(goal));
    }
  }

  void close(ChainHit& hit, int32_t goal) {
    if (hit.is_settled) return;
    hit.is_settled = true;
    goals_.close(goal);
  }

  // Stores the targets; false when there is no room for one.
  bool insert_found() {
    const size_t width = layout_.words();
    const uint64_t* words = found_words_.data();
    for (const Found& found : found_) {
      if (states_.size() >= max_states_ && states_.find(words) == kNone) {
        transitions_ = found.transitions;
        is_full_ = true;
        return false;
      }
      const auto [number, is_new] = states_.insert(words, found.hash);
      const uint64_t depth = depth_ + found.steps;
      if (is_new || is_later(number, found.steps)) add(number, found.parent, depth);
      words += width;
    }
    found_.clear();
    found_words_.clear();
    return true;
  }

  // Whether a state waits for a later level than that so many steps ahead.
  bool is_later(uint32_t number, uint64_t steps) const {
    const uint8_t level = *levels_of_[number];
    return level != kSettled && (level + kLevels - depth_ % kLevels) % kLevels > steps;
  }

  Layout layout_;
  Machine machine_;
  Moves moves_;
  Chain chain_;
  States states_;
  Pieces<uint32_t> parents_;
  Pieces<uint8_t> levels_of_;
  std::vector<uint32_t> levels_[kLevels];
  Goals goals_;
  std::vector<ChainHit> hits_;
  bool stops_early_;
  uint64_t max_states_;
  bool is_full_ = false;
  std::vector<Found> found_;
  std::vector<uint64_t> found_words_;
  uint64_t depth_ = 0, waiting_ = 0, expanded_ = 0, passed_ = 0, transitions_ = 0;
  bool is_complete_ = false;
};

}  // namespace core
