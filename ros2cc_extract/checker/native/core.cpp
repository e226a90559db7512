#include "core.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "chains.hpp"
#include "explore.hpp"
#include "lasso.hpp"

namespace core {
namespace {

using State = std::vector<int64_t>;

State unpacked(Machine& machine, const uint64_t* words) {
  machine.load(words);
  State state(machine.at.begin(), machine.at.end());
  state.insert(state.end(), machine.value.begin(), machine.value.end());
  return state;
}

std::vector<State> unpacked(Exploration& graph, const std::vector<uint32_t>& numbers) {
  std::vector<State> result;
  for (const uint32_t number : numbers) {
    result.push_back(unpacked(graph.machine(), graph.states()[number]));
  }
  return result;
}

// States from which several liveness questions are worth a thread each.
constexpr uint64_t kWorthThreads = 100000;
constexpr std::chrono::milliseconds kPatience{20};

class Search {
 public:
  Search(const Model& model, const std::vector<Predicate>& goals,
         const std::vector<LassoQuestion>& lassos, bool is_fair, uint64_t max_states,
         Jobs jobs, const Ask& ask)
      : model_(model),
        lassos_(lassos),
        is_fair_(is_fair),
        jobs_(jobs),
        ask_(ask),
        graph_(model, goals, lassos.empty(), max_states) {}

  Result run() {
    graph_.run([this](uint64_t states, uint64_t transitions, uint64_t bytes) {
      return ask_(states, transitions, bytes, true);
    }, jobs_);
    Result result;
    result.states = graph_.states().size();
    result.transitions = graph_.transitions();
    result.is_complete = graph_.is_complete();
    result.is_full = graph_.is_full();
    for (const Hit& hit : graph_.hits()) {
      Answer answer;
      answer.seconds = hit.seconds;
      if (hit.state != kNone) {
        answer.path = unpacked(graph_, graph_.parents().path_to(hit.state));
      }
      result.goals.push_back(std::move(answer));
    }
    for (const Lasso& found : find_lassos()) {
      result.lassos.emplace_back();
      if (!found.states.empty()) with_prefix(found, result.lassos.back());
    }
    return result;
  }

 private:
  bool ask() { return ask_(graph_.states().size(), graph_.transitions(), 0, false); }

  // What one question finds does not depend on the others, so many threads answer as one.
  std::vector<Lasso> find_lassos() {
    std::vector<Lasso> found(lassos_.size());
    size_t threads = std::min<size_t>(lassos_.size(), std::thread::hardware_concurrency());
    if (graph_.states().size() < kWorthThreads) threads = 1;
    if (threads < 2) {
      const Watch watch = [this](uint64_t, uint64_t, uint64_t) { return ask(); };
      for (size_t i = 0; i < found.size() && !ask(); ++i) found[i] = lasso(i, watch);
      return found;
    }
    std::vector<std::exception_ptr> errors(found.size());
    std::atomic<size_t> next{0}, running{threads};
    std::atomic<bool> is_over{false};
    std::mutex mutex;
    std::condition_variable ended;
    const Watch watch = [&](uint64_t, uint64_t, uint64_t) { return is_over.load(); };
    const auto work = [&] {
      for (size_t i = next++; i < found.size() && !is_over; i = next++) {
        try {
          found[i] = lasso(i, watch);
        } catch (...) {
          errors[i] = std::current_exception();
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      if (--running == 0) ended.notify_one();
    };
    std::exception_ptr interruption;
    std::vector<std::thread> pool;
    for (size_t i = 0; i < threads; ++i) pool.emplace_back(work);
    std::unique_lock<std::mutex> lock(mutex);
    while (!ended.wait_for(lock, kPatience, [&] { return running == 0; })) {
      lock.unlock();
      try {
        // Only this thread calls back: a Ctrl-C arrives in no other.
        if (!is_over && ask()) is_over = true;
      } catch (...) {
        interruption = std::current_exception();
        is_over = true;
      }
      lock.lock();
    }
    lock.unlock();
    for (std::thread& thread : pool) thread.join();
    errors.push_back(interruption);
    for (const std::exception_ptr& error : errors) {
      if (error) std::rethrow_exception(error);
    }
    return found;
  }

  Lasso lasso(size_t i, const Watch& watch) const {
    const auto& [inside, start] = lassos_[i];
    try {
      LassoSearch search(model_, graph_, inside, start ? &*start : nullptr, watch);
      return is_fair_ ? search.run_fair() : search.run();
    } catch (const Stopped&) {
      return {};  // the caller knows why it said so
    }
  }

  void with_prefix(const Lasso& lasso, Answer& answer) {
    std::vector<uint32_t> numbers = graph_.parents().path_to(lasso.states[0]);
    const int64_t shift = static_cast<int64_t>(numbers.size()) - 1;
    numbers.insert(numbers.end(), lasso.states.begin() + 1, lasso.states.end());
    answer.path = unpacked(graph_, numbers);
    if (lasso.cycle_start >= 0) answer.cycle_start = lasso.cycle_start + shift;
    answer.end = lasso.end;
  }

  const Model& model_;
  const std::vector<LassoQuestion>& lassos_;
  bool is_fair_;
  Jobs jobs_;
  const Ask& ask_;
  Exploration graph_;
};

}  // namespace

Result search(const Model& model, const std::vector<Predicate>& goals,
              const std::vector<LassoQuestion>& lassos, bool is_fair, uint64_t max_states,
              Jobs jobs, const Ask& ask) {
  return Search(model, goals, lassos, is_fair, max_states, jobs, ask).run();
}

Result search_chains(const Model& model, const std::vector<Predicate>& goals,
                     uint64_t max_states, const Ask& ask) {
  ChainExploration graph(model, goals, max_states);
  graph.run([&](uint64_t states, uint64_t transitions, uint64_t bytes) {
    return ask(states, transitions, bytes, true);
  });
  Result result;
  result.states = graph.size();
  result.transitions = graph.transitions();
  result.is_complete = graph.is_complete();
  result.is_full = graph.is_full();
  for (size_t goal = 0; goal < goals.size(); ++goal) {
    Answer answer;
    if (const ChainHit* hit = graph.hit(goal)) {
      answer.seconds = hit->seconds;
      const std::vector<uint64_t> path = graph.path_of(*hit);
      for (size_t i = 0; i < path.size(); i += graph.layout().words()) {
        answer.path.push_back(unpacked(graph.machine(), &path[i]));
      }
    }
    result.goals.push_back(std::move(answer));
  }
  return result;
}

}  // namespace core
