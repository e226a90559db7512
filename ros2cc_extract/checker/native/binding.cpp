// The extension module: lists of integers in, state numbers and states out.

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "explore.hpp"
#include "lasso.hpp"

namespace py = pybind11;
using namespace core;

namespace {

using Ints = std::vector<int32_t>;
using RawPredicate = std::tuple<int32_t, bool, Ints, Ints>;
using RawState = std::vector<int64_t>;
using PyWatch = std::function<bool(uint64_t, uint64_t, uint64_t, bool)>;

struct Answer {
  std::vector<RawState> path;  // empty: none was found
  int64_t cycle_start = -1;
  int32_t end = NO_END;
  double seconds = 0;
  bool is_stopped = false;
};

struct Result {
  uint64_t states = 0, transitions = 0;
  bool is_complete = false;
  std::vector<Answer> goals, lassos;
};

std::vector<Range> ranges_from(const Ints& flat) {
  std::vector<Range> ranges(flat.size() / 2);
  for (size_t i = 0; i < ranges.size(); ++i) ranges[i] = {flat[2 * i], flat[2 * i + 1]};
  return ranges;
}

Model model_from(const Ints& nodes, Ints lists, const Ints& ranges, const Ints& functions,
                 const Ints& edges, Ints channels, const Ints& variables, Ints initial,
                 std::vector<Ints> locations) {
  Model model;
  for (size_t i = 0; i < nodes.size(); i += 4) {
    model.nodes.push_back({static_cast<Op>(nodes[i]), nodes[i + 1], nodes[i + 2], nodes[i + 3]});
  }
  for (size_t i = 0; i < functions.size(); i += 2) {
    model.functions.push_back({functions[i], functions[i + 1]});
  }
  for (size_t i = 0; i < edges.size(); i += 9) {
    const int32_t* e = &edges[i];
    model.edges.push_back({e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8]});
  }
  model.lists = std::move(lists);
  model.ranges = ranges_from(ranges);
  model.variables = ranges_from(variables);
  model.channels = std::move(channels);
  model.initial = std::move(initial);
  model.locations = std::move(locations);
  return model;
}

Predicate predicate_from(const RawPredicate& raw) {
  return {std::get<0>(raw), std::get<1>(raw), std::get<2>(raw), std::get<3>(raw)};
}

std::vector<RawState> unpacked(Exploration& graph, const std::vector<uint32_t>& numbers) {
  std::vector<RawState> result;
  for (const uint32_t number : numbers) {
    Machine& machine = graph.machine();
    machine.load(graph.states()[number]);
    RawState state(machine.at.begin(), machine.at.end());
    state.insert(state.end(), machine.value.begin(), machine.value.end());
    result.push_back(std::move(state));
  }
  return result;
}

class Search {
 public:
  Search(const Model& model, const std::vector<RawPredicate>& goals,
         const std::vector<std::pair<RawPredicate, std::optional<RawPredicate>>>& lassos,
         bool is_fair, const PyWatch& watch)
      : model_(model), lassos_(lassos), is_fair_(is_fair), watch_(watch),
        graph_(model, all(goals), lassos.empty()) {}

  Result run() {
    graph_.run([this](uint64_t states, uint64_t transitions, uint64_t bytes) {
      return ask(states, transitions, bytes, true);
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
  static std::vector<Predicate> all(const std::vector<RawPredicate>& raw) {
    std::vector<Predicate> result;
    for (const RawPredicate& predicate : raw) result.push_back(predicate_from(predicate));
    return result;
  }

  bool ask(uint64_t states, uint64_t transitions, uint64_t bytes, bool is_exploring) {
    py::gil_scoped_acquire gil;
    return watch_(states, transitions, bytes, is_exploring);
  }

  Answer lasso(const RawPredicate& inside, const std::optional<RawPredicate>& start) {
    const Watch watch = [this](uint64_t states, uint64_t transitions, uint64_t bytes) {
      return ask(states, transitions, bytes, false);
    };
    Answer answer;
    if (watch(graph_.states().size(), graph_.transitions(), 0)) {
      answer.is_stopped = true;
      return answer;
    }
    std::optional<Predicate> from;
    if (start) from = predicate_from(*start);
    LassoSearch search(graph_, predicate_from(inside), from ? &*from : nullptr, watch);
    try {
      const Lasso found = is_fair_ ? search.run_fair(model_) : search.run();
      if (!found.states.empty()) with_prefix(found, answer);
    } catch (const Stopped&) {
      answer.is_stopped = true;
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
  const std::vector<std::pair<RawPredicate, std::optional<RawPredicate>>>& lassos_;
  bool is_fair_;
  const PyWatch& watch_;
  Exploration graph_;
};

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Explores networks of integer tables; see native.py for its use.";

  std::vector<std::string> operations;
#define CORE_NAME(name) operations.push_back(#name);
  CORE_OPERATIONS(CORE_NAME)
#undef CORE_NAME
  module.attr("OPERATIONS") = py::cast(operations);

  static py::exception<CheckFailed> check_failed(module, "CheckFailed");
  static py::exception<Endless> endless(module, "Endless");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const CheckFailed& error) {
      PyErr_SetObject(check_failed.ptr(), py::make_tuple(error.site, error.value).ptr());
    } catch (const Endless& error) {
      PyErr_SetObject(endless.ptr(), py::make_tuple(error.function).ptr());
    }
  });

  py::class_<Answer>(module, "Answer")
      .def_readonly("path", &Answer::path)
      .def_readonly("cycle_start", &Answer::cycle_start)
      .def_readonly("end", &Answer::end)
      .def_readonly("seconds", &Answer::seconds)
      .def_readonly("is_stopped", &Answer::is_stopped);
  py::class_<Result>(module, "Result")
      .def_readonly("states", &Result::states)
      .def_readonly("transitions", &Result::transitions)
      .def_readonly("is_complete", &Result::is_complete)
      .def_readonly("goals", &Result::goals)
      .def_readonly("lassos", &Result::lassos);

  module.def(
      "search",
      [](const Ints& nodes, Ints lists, const Ints& ranges, const Ints& functions,
         const Ints& edges, Ints channels, const Ints& variables, Ints initial,
         std::vector<Ints> locations, const std::vector<RawPredicate>& goals,
         const std::vector<std::pair<RawPredicate, std::optional<RawPredicate>>>& lassos,
         bool is_fair, const PyWatch& watch) {
        py::gil_scoped_release release;
        const Model model =
            model_from(nodes, std::move(lists), ranges, functions, edges, std::move(channels),
                       variables, std::move(initial), std::move(locations));
        return Search(model, goals, lassos, is_fair, watch).run();
      },
      py::kw_only(), py::arg("nodes"), py::arg("lists"), py::arg("ranges"),
      py::arg("functions"), py::arg("edges"), py::arg("channels"), py::arg("variables"),
      py::arg("initial"), py::arg("locations"), py::arg("goals"), py::arg("lassos"),
      py::arg("is_fair"), py::arg("watch"));
}
