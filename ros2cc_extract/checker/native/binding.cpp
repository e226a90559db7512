// The extension module: lists of integers in, answers out.

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core.hpp"

namespace py = pybind11;
using namespace core;

namespace {

using Ints = std::vector<int32_t>;
using RawPredicate = std::tuple<int32_t, bool, Ints, Ints>;
using RawLasso = std::pair<RawPredicate, std::optional<RawPredicate>>;

std::vector<Range> ranges_from(const Ints& flat) {
  std::vector<Range> ranges(flat.size() / 2);
  for (size_t i = 0; i < ranges.size(); ++i) ranges[i] = {flat[2 * i], flat[2 * i + 1]};
  return ranges;
}

// Slots, lows and strides of the controls, the stride of the location, the lists of resets.
using RawForgetting = std::tuple<Ints, int32_t, Ints>;

std::vector<Forgetting> forgettings_from(const std::vector<RawForgetting>& raw) {
  std::vector<Forgetting> forgettings;
  for (const auto& [controls, stride, resets] : raw) {
    Forgetting forgetting;
    for (size_t i = 0; i < controls.size(); i += 3) {
      forgetting.controls.push_back({controls[i], controls[i + 1], controls[i + 2]});
    }
    forgetting.stride = stride;
    forgetting.resets = resets;
    forgettings.push_back(std::move(forgetting));
  }
  return forgettings;
}

// Processes, names, parts, and of each pointer its slot, initial value and owners.
using RawPointer = std::tuple<int32_t, int32_t, Ints>;
using RawFamily = std::tuple<Ints, Ints, std::vector<Ints>, std::vector<RawPointer>>;

std::vector<Family> families_from(const std::vector<RawFamily>& raw) {
  std::vector<Family> families;
  for (const auto& [processes, names, parts, pointers] : raw) {
    Family family{processes, names, parts, {}};
    for (const auto& [slot, initial, owners] : pointers) {
      family.pointers.push_back({slot, initial, owners});
    }
    families.push_back(std::move(family));
  }
  return families;
}

Model model_from(const Ints& nodes, Ints lists, const Ints& ranges, const Ints& functions,
                 const Ints& edges, Ints channels, const Ints& variables, Ints initial,
                 std::vector<Ints> locations, const std::vector<RawForgetting>& forgettings,
                 const std::vector<RawFamily>& families, const Ints& picks) {
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
  model.forgettings = forgettings_from(forgettings);
  model.families = families_from(families);
  for (size_t i = 0; i < picks.size(); i += 6) {
    const int32_t* p = &picks[i];
    model.picks.push_back({p[0], p[1], p[2], p[3], p[4], p[5]});
  }
  return model;
}

Predicate predicate_from(const RawPredicate& raw) {
  return {std::get<0>(raw), std::get<1>(raw), std::get<2>(raw), std::get<3>(raw)};
}

std::vector<LassoQuestion> lassos_from(const std::vector<RawLasso>& raw) {
  std::vector<LassoQuestion> lassos;
  for (const auto& [inside, start] : raw) {
    std::optional<Predicate> first;
    if (start) first = predicate_from(*start);
    lassos.emplace_back(predicate_from(inside), first);
  }
  return lassos;
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Explores networks of integer tables; see native.py for its use.";

  std::vector<std::string> operations;
#define CORE_NAME(name) operations.push_back(#name);
  CORE_OPERATIONS(CORE_NAME)
#undef CORE_NAME
  module.attr("OPERATIONS") = py::cast(operations);

  static py::exception<CheckFailed> check_failed(module, "CheckError");
  static py::exception<Endless> endless(module, "EndlessError");
  static py::exception<Uneven> uneven(module, "UnevenError");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const CheckFailed& error) {
      PyErr_SetObject(check_failed.ptr(), py::make_tuple(error.site, error.value).ptr());
    } catch (const Endless& error) {
      PyErr_SetObject(endless.ptr(), py::make_tuple(error.function).ptr());
    } catch (const Uneven&) {
      PyErr_SetNone(uneven.ptr());
    }
  });

  py::class_<Answer>(module, "Answer")
      .def_readonly("path", &Answer::path)
      .def_readonly("cycle_start", &Answer::cycle_start)
      .def_readonly("end", &Answer::end)
      .def_readonly("seconds", &Answer::seconds);
  py::class_<Result>(module, "Result")
      .def_readonly("states", &Result::states)
      .def_readonly("transitions", &Result::transitions)
      .def_readonly("is_complete", &Result::is_complete)
      .def_readonly("is_full", &Result::is_full)
      .def_readonly("goals", &Result::goals)
      .def_readonly("lassos", &Result::lassos);

  module.def(
      "search",
      [](const Ints& nodes, Ints lists, const Ints& ranges, const Ints& functions,
         const Ints& edges, Ints channels, const Ints& variables, Ints initial,
         std::vector<Ints> locations, const std::vector<RawForgetting>& forgettings,
         const std::vector<RawFamily>& families, const Ints& picks,
         const std::vector<RawPredicate>& goals, const std::vector<RawLasso>& lassos,
         bool is_fair, bool runs_chains, uint64_t max_states,
         std::pair<size_t, uint64_t> jobs, const Ask& watch) {
        // pybind11 takes the lock again around each call of `watch`.
        py::gil_scoped_release release;
        const Model model =
            model_from(nodes, std::move(lists), ranges, functions, edges, std::move(channels),
                       variables, std::move(initial), std::move(locations), forgettings,
                       families, picks);
        std::vector<Predicate> predicates;
        for (const RawPredicate& goal : goals) predicates.push_back(predicate_from(goal));
        if (runs_chains) return search_chains(model, predicates, max_states, watch);
        return search(model, predicates, lassos_from(lassos), is_fair, max_states,
                      {jobs.first, jobs.second}, watch);
      },
      py::kw_only(), py::arg("nodes"), py::arg("lists"), py::arg("ranges"),
      py::arg("functions"), py::arg("edges"), py::arg("channels"), py::arg("variables"),
      py::arg("initial"), py::arg("locations"), py::arg("forgettings"), py::arg("families"),
      py::arg("picks"), py::arg("goals"), py::arg("lassos"), py::arg("is_fair"), py::arg("runs_chains"),
      py::arg("max_states"), py::arg("jobs"), py::arg("watch"));
}
