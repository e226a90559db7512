"""Decides for one unit and one executor of a trace whether it did what the model can do."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import field, replace
from operator import attrgetter

from ros2cc_extract.checker.api import read_model
from ros2cc_extract.conform.arrivals import Arrival, with_arrivals
from ros2cc_extract.conform.entity_matching import match, with_copies
from ros2cc_extract.conform.observable_model import ObservedModel
from ros2cc_extract.conform.observations import (
    TASKS,
    Act,
    Observation,
    observe,
    with_groups,
    with_unreported_tasks,
)
from ros2cc_extract.conform.search import PASSED, STATES, Answer, conform
from ros2cc_extract.conform.trace import Trace
from ros2cc_extract.conform.unobserved_facts import Gap, gaps
from ros2cc_extract.generator.build import Freedom, Profile, render
from ros2cc_extract.generator.waits import waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec, Policy, close
from ros2cc_extract.spec.confidence import DEFAULT_COUNT
from ros2cc_extract.spec.model import Spec

#: More than a trace shows, because what it shows may be a little out of order.
SPARE = 2
_RUNS = ('collect', 'begin', 'run')
_QUEUES = {Act.COLLECT: 1, Act.ARRIVE: 1, Act.BEGIN: -1, Act.REFUSED: -1}
_RUNS_OPEN = {Act.BEGIN: 1, Act.RESUME: 1, Act.END: -1, Act.SUSPEND: -1, Act.PAUSE: -1}
_SUSPENDS = {Act.SUSPEND: 1, Act.RESUME: -1}
_MADE = {Act.ARRIVE: 1, Act.BEGIN: -1}


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """
    What came of one unit.

    :param unit: with those of rclpy's own entities that ran.
    :param lacking: names of what the executor ran and the specification lacks.
    :param gaps: what else the specification lacks, as far as the trace shows.
    """

    unit: ClosedSpec
    observations: tuple[Observation, ...] = field(repr=False)
    lacking: tuple[str, ...]
    gaps: tuple[Gap, ...]
    answer: Answer
    model: ObservedModel = field(repr=False)

    @property
    def is_gap(self) -> bool:
        """Whether the specification does not say enough."""
        return bool(self.lacking or self.gaps)


def pair_units(
    traces: Sequence[Trace], units: Sequence[Spec]
) -> Iterator[tuple[Trace, int, Spec]]:
    """Find the unit of each executor that served nodes: that with most of its callbacks."""
    for trace in traces:
        for executor in trace.executors():
            best = max(units, key=lambda spec: len(match(trace, executor.number, spec)))
            if match(trace, executor.number, best):
                yield trace, executor.number, best


def compare(
    trace: Trace,
    executor: int,
    spec: Spec,
    *,
    until_ns: int | None = None,
    edit: Callable[[str], str] = str,
    states: int = STATES,
    arrivals: Sequence[Arrival] = (),
) -> Comparison:
    """
    Decide whether what ``executor`` did is a path of the model of ``spec``.

    :param until_ns: leave out what happened later.
    :param edit: changes the text of the model before it is read.
    :param arrivals: all that arrived for some of the callbacks of an events executor, which
        a trace does not show: it serves them in this order.
    """
    ran = {event.subject for event in trace.events if event.name in _RUNS}
    whole, several = with_copies(trace, executor, spec)
    unit = _with_what_ran(trace, executor, whole, ran)
    places = match(trace, executor, unit.spec)
    seen = with_groups(observe(trace, executor, places), unit.spec)
    if arrivals:
        seen = with_arrivals(seen, arrivals, unit.spec)
    if until_ns is not None:
        seen = tuple(each for each in seen if _is_before(each, until_ns))
    else:
        seen = with_unreported_tasks(seen, unit.spec)
    text = edit(text_of(unit, seen))
    model = ObservedModel(
        read_model(text, f'{unit.spec.name}.xml'),
        len(unit.spec.callbacks),
        _tasks(unit),
    )
    own = [s for s in trace.subjects.values() if s.executor == executor and s.number in ran]
    return Comparison(
        unit=unit,
        observations=seen,
        lacking=tuple(s.name for s in own if s.number not in places),
        gaps=gaps(trace, places, seen, unit.spec, several),
        answer=conform(model, seen, states=states),
        model=model,
    )


def _is_before(observation: Observation, until_ns: int) -> bool:
    """Whether it was made by then: that is reported afterwards, so it may have run already."""
    is_made = observation.act is Act.ARRIVE
    return (observation.earliest_ns if is_made else observation.clock_ns) < until_ns


def _with_what_ran(trace: Trace, executor: int, spec: Spec, ran: Container[int]) -> ClosedSpec:
    """Close a unit; what rclpy made by itself is only in it if it ran."""
    places = match(trace, executor, spec)
    running = {place for number, place in places.items() if number in ran}
    kept = tuple(c for p, c in enumerate(spec.callbacks) if not c.builtin or p in running)
    threads = trace.subjects[executor].threads if _is_by_cpus(spec) else None
    policy = Policy(builtin=True, rclpy=trace.rclpy, threads=threads)
    return close(replace(spec, callbacks=kept), policy)


def _is_by_cpus(spec: Spec) -> bool:
    """Whether it has as many threads as there are CPUs, wherever it runs."""
    return spec.executor.threads_source == DEFAULT_COUNT


def text_of(unit: ClosedSpec, seen: Sequence[Observation]) -> str:
    """Render the plain text with room for all that the trace can need at a time."""
    begins = Counter(each.callback for each in seen if _is_an_arrival(each))
    return render(
        unit,
        profile=Profile.RCLPY,
        max_cycle=max(begins.values(), default=0) + SPARE,
        freedom=Freedom(
            queued=_most_at_a_time(seen, _QUEUES) + SPARE,
            suspended=_most_suspended(unit.spec, seen) + SPARE,
            made=_most_made(seen) + SPARE,
            nested=_most_on_a_thread(seen),
            observed=True,
        ),
    ).xml


def _is_an_arrival(seen: Observation) -> bool:
    """What arrived is seen by itself, or by what it began."""
    return seen.act is Act.ARRIVE or (seen.act is Act.BEGIN and not seen.has_arrived)


def _most_at_a_time(seen: Sequence[Observation], steps: Mapping[Act, int]) -> int:
    """How many runs of one callback were between two acts at the same time."""
    now: Counter[int | None] = Counter()
    most = 0
    for each in seen:
        now[each.callback] += steps.get(each.act, 0)
        most = max(most, now[each.callback])
    return most


def _most_suspended(spec: Spec, seen: Sequence[Observation]) -> int:
    """How many runs of one callback may be suspended; of tasks no trace says when they are."""
    awaiting = {
        place
        for place, callback in enumerate(spec.callbacks)
        if any(wait.frees_thread for wait in waits_of(callback, spec))
    }
    made = Counter(each.callback for each in seen if each.is_task and each.act is Act.ARRIVE)
    tasks = (number for place, number in made.items() if place in awaiting)
    return max((_most_at_a_time(seen, _SUSPENDS), *tasks))


def _most_made(seen: Sequence[Observation]) -> int:
    """How many runs of one task were made and had not begun, each made as soon as it can be."""
    tasks = sorted((each for each in seen if each.is_task), key=attrgetter('earliest_ns'))
    return PASSED + _most_at_a_time(tasks, _MADE)


def _most_on_a_thread(seen: Sequence[Observation]) -> int:
    """How many runs were open at a time on one thread, one inside the other."""
    now: Counter[int] = Counter()
    most = 1
    for each in seen:
        now[each.thread] += _RUNS_OPEN.get(each.act, 0)
        most = max(most, now[each.thread])
    return most


def _tasks(unit: ClosedSpec) -> frozenset[int]:
    """No trace says reliably when they were handed over: it may be before they were reported."""
    return frozenset(p for p, c in enumerate(unit.spec.callbacks) if c.entity in TASKS)
