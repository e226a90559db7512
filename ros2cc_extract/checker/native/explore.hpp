// Breadth-first exploration of all reachable states.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "expander.hpp"
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

// How many threads explore together, and from how many states on.
struct Jobs {
  size_t threads;
  uint64_t worth;
};

struct Hit {
  uint32_t state = kNone;
  double seconds = 0;
};

class Exploration {
 public:
  Exploration(const Model& model, const std::vector<Predicate>& goals, bool stops_early,
              uint64_t max_states)
      : model_(model),
        layout_(model),
        goals_(goals),
        expander_(model, layout_, goals),
        states_(layout_.words()),
        hits_(goals.size()),
        open_(goals.size()),
        stops_early_(stops_early && !goals.empty()),
        max_states_(max_states) {
    const std::vector<uint64_t> first = initial_words(model, layout_);
    states_.insert(first.data(), hash_of(first.data(), layout_.words()));
  }

  // Explores until all is known or `watch` says to stop; false in the second case. Once there
  // are states enough, so many threads work; they find the same in the same order.
  bool run(const Watch& watch, Jobs jobs) {
    Pulse pulse;
    Batch batch;
    while (expanded_ < states_.size()) {
      if (jobs.threads > 1 && states_.size() >= jobs.worth) {
        return run_together(watch, jobs.threads);
      }
      if (pulse.is_due(expanded_ + states_.size()) &&
          watch(states_.size(), transitions_, 0)) {
        return false;
      }
      batch.begin(expanded_);
      while (batch.end < states_.size() && batch.targets.size() < kBatch && !is_done(expander_)) {
        expand(expander_, batch);
      }
      if (!take(batch, watch)) return false;
      if (is_done(*this)) return true;
    }
    is_complete_ = true;
    return true;
  }

  bool all_closed() const { return open_ == 0; }
  const Layout& layout() const { return layout_; }
  Machine& machine() { return expander_.machine(); }
  const States& states() const { return states_; }
  const Parents& parents() const { return parents_; }
  const std::vector<Hit>& hits() const { return hits_; }
  uint64_t expanded() const { return expanded_; }
  uint64_t transitions() const { return transitions_; }
  bool is_complete() const { return is_complete_; }
  bool is_full() const { return is_full_; }

 private:
  static constexpr size_t kBatch = 192, kAhead = 16;
  static constexpr uint64_t kShare = 1024;  // states that a thread takes at a time

  template <class Goals>
  bool is_done(const Goals& goals) const {
    return stops_early_ && goals.all_closed();
  }

  void expand(Expander& expander, Batch& batch) const {
    const uint32_t number = static_cast<uint32_t>(batch.end);
    expander.expand(number, states_[number], batch);
  }

  // Stores what a batch has found; false when a limit is hit. Batches come in the order of
  // their states, so that it does not matter who worked them out.
  bool take(Batch& batch, const Watch& watch) {
    note_hits(batch);
    if (batch.error) std::rethrow_exception(batch.error);
    const uint64_t growth = states_.growth(batch.targets.size());
    // Targets that were not stored must not be looked for: their sources stay unexpanded.
    if (growth != 0 && watch(states_.size(), transitions_, growth)) return false;
    const size_t width = layout_.words(), count = batch.targets.size();
    const uint64_t* words = batch.words.data();
    size_t before = 0;  // the first target of the same source
    for (size_t i = 0; i < count; ++i, words += width) {
      if (i + kAhead < count) states_.prefetch(batch.targets[i + kAhead].hash);
      const Batch::Target& target = batch.targets[i];
      if (target.source != batch.targets[before].source) before = i;
      if (states_.size() >= max_states_ && states_.find(words) == kNone) {
        expanded_ = target.source;
        transitions_ += before;
        is_full_ = true;
        return false;
      }
      if (states_.insert(words, target.hash).second) parents_.child(target.source);
    }
    expanded_ = batch.end;
    transitions_ += count;
    return true;
  }

  // Notes the first state that fulfils each goal; what lies behind the last goal is dropped.
  void note_hits(Batch& batch) {
    for (const Batch::Reached& reached : batch.reached) {
      Hit& hit = hits_[reached.goal];
      if (hit.state != kNone) continue;
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
      hit = {reached.state, passed.count()};
      if (--open_ > 0 || !stops_early_) continue;
      while (!batch.targets.empty() && batch.targets.back().source > reached.state) {
        batch.targets.pop_back();
      }
      batch.end = uint64_t{reached.state} + 1;
      batch.error = nullptr;
      return;
    }
  }

  // -- several threads -------------------------------------------------------------------

  // What the threads share. Who holds the mutex stores his batch, if it is its turn, and takes
  // the next share of states; expanding needs only states that are stored.
  struct Crew {
    std::mutex mutex;
    std::condition_variable changed;
    uint64_t next;          // the first state that nobody has taken
    uint64_t turn, last;    // batches stored, batches begun
    bool is_over = false, is_stopped = false;
    std::exception_ptr error;
  };

  bool run_together(const Watch& watch, size_t threads) {
    Crew crew;
    crew.next = expanded_;
    crew.turn = crew.last = 0;
    std::deque<Expander> expanders;
    std::vector<std::thread> others;
    for (size_t i = 1; i < threads; ++i) {
      Expander& expander = expanders.emplace_back(model_, layout_, goals_);
      try {
        others.emplace_back([&] { work(crew, expander, watch, false); });
      } catch (const std::system_error&) {
        break;  // the system has no more threads: fewer find the same
      }
    }
    work(crew, expander_, watch, true);
    for (std::thread& other : others) other.join();
    if (crew.error) std::rethrow_exception(crew.error);
    if (crew.is_stopped) return false;
    is_complete_ = expanded_ == states_.size() && !is_done(*this);
    return true;
  }

  void work(Crew& crew, Expander& expander, const Watch& watch, bool is_main) {
    Batch batch;
    Pulse pulse;
    std::unique_lock<std::mutex> lock(crew.mutex);
    while (true) {
      // While others still work there may be more states soon.
      crew.changed.wait(lock, [&] {
        return crew.is_over || crew.next < states_.size() || crew.turn == crew.last;
      });
      if (crew.is_over || crew.next == states_.size()) break;
      const uint64_t number = crew.last++;
      batch.begin(crew.next);
      const uint64_t share = std::min(kShare, (states_.size() - crew.next + 1) / 2);
      crew.next += share;
      lock.unlock();
      expand_share(expander, batch, share);
      lock.lock();
      crew.changed.wait(lock, [&] { return crew.is_over || crew.turn == number; });
      if (crew.is_over) break;
      store(crew, batch, watch, is_main && pulse.is_due(expanded_ + states_.size()));
      ++crew.turn;
      crew.changed.notify_all();
    }
    crew.is_over = true;
    crew.changed.notify_all();
  }

  void expand_share(Expander& expander, Batch& batch, uint64_t share) const {
    try {
      for (; share > 0 && !is_done(expander); --share) expand(expander, batch);
    } catch (...) {
      batch.error = std::current_exception();
    }
  }

  void store(Crew& crew, Batch& batch, const Watch& watch, bool looks) {
    try {
      crew.is_stopped = (looks && watch(states_.size(), transitions_, 0)) || !take(batch, watch);
      crew.is_over = crew.is_stopped || is_done(*this);
    } catch (...) {
      crew.error = std::current_exception();
      crew.is_over = true;
    }
  }

  const Model& model_;
  Layout layout_;
  const std::vector<Predicate>& goals_;
  Expander expander_;
  States states_;
  Parents parents_;
  std::vector<Hit> hits_;
  size_t open_;
  bool stops_early_;
  uint64_t max_states_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  uint64_t expanded_ = 0, transitions_ = 0;
  bool is_complete_ = false, is_full_ = false;
};

}  // namespace core
