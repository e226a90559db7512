#include "core.hpp"

#include "explore.hpp"
#include "lasso.hpp"

namespace core {
namespace {

using State = std::vector<int64_t>;

std::vector<State> unpacked(Exploration& graph, const std::vector<uint32_t>& numbers) {
  std::vector<State> result;
  for (const uint32_t number : numbers) {
    Machine& machine = graph.machine();
    machine.load(graph.states()[number]);
    State state(machine.at.begin(), machine.at.end());
    state.insert(state.end(), machine.value.begin(), machine.value.end());
    result.push_back(std::move(state));
  }
  return result;
}

class Search {
 public:
  Search(const Model& model, const std::vector<Predicate>& goals,
         const std::vector<LassoQuestion>& lassos, bool is_fair, const Ask& ask)
      : model_(model),
        lassos_(lassos),
        is_fair_(is_fair),
        ask_(ask),
        graph_(model, goals, lassos.empty()) {}

  Result run() {
    graph_.run([this](uint64_t states, uint64_t transitions, uint64_t bytes) {
      return ask_(states, transitions, bytes, true);
    });
    Result result;
    result.states = graph_.states().size();
    result.transitions = graph_.transitions();
    result.is_complete = graph_.is_complete();
    for (const Hit& hit : graph_.hits()) {
      Answer answer;
      answer.seconds = hit.seconds;
      if (hit.state != kNone) {
        answer.path = unpacked(graph_, graph_.parents().path_to(hit.state));
      }
      result.goals.push_back(std::move(answer));
    }
    for (const auto& [inside, start] : lassos_) result.lassos.push_back(lasso(inside, start));
    return result;
  }

 private:
  Answer lasso(const Predicate& inside, const std::optional<Predicate>& start) {
    const Watch watch = [this](uint64_t states, uint64_t transitions, uint64_t bytes) {
      return ask_(states, transitions, bytes, false);
    };
    Answer answer;
    if (watch(graph_.states().size(), graph_.transitions(), 0)) return answer;
    LassoSearch search(graph_, inside, start ? &*start : nullptr, watch);
    try {
      const Lasso found = is_fair_ ? search.run_fair(model_) : search.run();
      if (!found.states.empty()) with_prefix(found, answer);
    } catch (const Stopped&) {
      // The caller knows why it said so; the answer stays empty.
    }
    return answer;
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
  const Ask& ask_;
  Exploration graph_;
};

}  // namespace

Result search(const Model& model, const std::vector<Predicate>& goals,
              const std::vector<LassoQuestion>& lassos, bool is_fair, const Ask& ask) {
  return Search(model, goals, lassos, is_fair, ask).run();
}

}  // namespace core
