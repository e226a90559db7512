"""
Asks a checker for the verdicts of a unit, and ties the answers to words.

Knows neither syntax trees nor output formats; every run it hands on was replayed by the checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

from ros2cc_extract.checker.api import Fairness, Limits, Verdict
from ros2cc_extract.generator import build
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.arrivals.exhausted_permits import refute_by_using_up
from ros2cc_extract.verify.arrivals.filled_threads import ask_again
from ros2cc_extract.verify.arrivals.needed_arrivals import TWO_ARRIVALS, needs_two_arrivals
from ros2cc_extract.verify.arrivals.structural_starvation import structural_verdicts
from ros2cc_extract.verify.results.caveats import caveats_of, left_out_of_deadlocks
from ros2cc_extract.verify.results.load import demands_of, load_of
from ros2cc_extract.verify.results.results import QueryResult, Verification, verification_of
from ros2cc_extract.verify.search.known_answers import Shelf
from ros2cc_extract.verify.search.model_search import (
    refute_by_chance,
    refute_over_waypoints,
    search,
)
from ros2cc_extract.verify.search.options import DEFAULTS, Checker, OnProgress, Options
from ros2cc_extract.verify.search.search_results import Found, key_of
from ros2cc_extract.verify.slices.narrowing import Refuters, joined, narrow


def verify_unit(
    closed: ClosedSpec,
    options: Options = DEFAULTS,
    progress: OnProgress | None = None,
    shelf: Shelf | None = None,
) -> Verification:
    """
    Render, check and report one unit.

    :param shelf: answers that hold for parts of other units too; used and added to.
    """
    options = replace(options, limits=options.limits.begun())
    shelf = Shelf() if shelf is None else shelf
    queries = build.queries_of(closed, profile=options.profile, max_cycle=options.max_cycle)
    if options.families is not None:
        queries = tuple(query for query in queries if query.family in options.families)
    if options.text is build.Text.COMPACT:
        # It resets its variables itself: looking for dead ones costs time and finds no state less.
        options = replace(options, reduction=False)
    of_two = [q for q in queries if needs_two_arrivals(q, closed.spec, options.profile)]
    if options.max_cycle != 1:
        of_two = []
    twice_asked = set(map(key_of, of_two))
    once_asked = [query for query in queries if key_of(query) not in twice_asked]
    found = _ask(once_asked, closed, options, progress, shelf)
    if of_two:
        twice = replace(options, max_cycle=TWO_ARRIVALS)
        found = joined(found, _ask(of_two, closed, twice, progress, shelf))
    if options.max_cycle == 1 and options.profile is build.Profile.RCLPY:
        if options.fills_threads:
            found = ask_again(
                found,
                queries,
                closed,
                lambda left, more, limits: _ask(left, more, options, progress, shelf, limits),
                options.limits,
            )
        if _may_be_sliced(options):
            by_chance = partial(refute_by_chance, options=options)
            found = refute_by_using_up(found, queries, closed, by_chance, options.limits)
    left_out = left_out_of_deadlocks(closed.spec, options.profile)
    results = tuple(
        _as_far_as_modelled(_as_asked(found.results[key_of(query)], query, left_out), query)
        for query in queries
    )
    structural = tuple(_structural(closed, options, shelf))
    is_open = any(result.verdict is Verdict.UNDECIDED for result in structural)
    return verification_of(
        closed.spec.name,
        replace(found.check, complete=found.check.complete and not is_open),
        _with_loads((*results, *structural), closed),
        profile=options.profile.value,
        text=options.text.value,
        assumptions=closed.assumptions,
        notes=_caveats(closed, options, found),
    )


def _ask(
    queries: Sequence[build.Query],
    closed: ClosedSpec,
    options: Options,
    progress: OnProgress | None,
    shelf: Shelf,
    limits: Limits | None = None,
) -> Found:
    """Ask slices where they may decide, else the whole unit."""
    limits = limits or options.limits
    asking = partial(search, options=options, progress=progress)
    if options.max_cycle is not None and _may_be_sliced(options):
        refuters = Refuters(
            partial(refute_over_waypoints, options=options),
            partial(refute_by_chance, options=options),
        )
        return narrow(closed, queries, options.max_cycle, asking, limits, shelf, refuters)
    return asking(closed, [key_of(query) for query in queries], limits)


def _as_asked(result: QueryResult, query: build.Query, left_out: str) -> QueryResult:
    """A slice has numbers and names of its own; ``left_out`` is said of deadlocks."""
    words = f'{left_out}{query.words}' if query.family is build.Family.DEADLOCK else query.words
    if (result.formula, result.words, result.callbacks) == (query.formula, words, query.callbacks):
        return result
    return replace(result, formula=query.formula, words=words, callbacks=query.callbacks)


def _may_be_sliced(options: Options) -> bool:
    """Whether a unit may be sliced: not with other texts or a limit of states."""
    return (
        options.profile is build.Profile.RCLPY
        and options.text is build.Text.COMPACT
        and options.checker is Checker.EMBEDDED
        and options.fairness is Fairness.NONE
        and options.limits.states is None
    )


def _structural(closed: ClosedSpec, options: Options, shelf: Shelf) -> Iterator[QueryResult]:
    """Ask for unlimited arrivals too; the model of the unit itself bounds them."""
    is_rclpy = options.profile is build.Profile.RCLPY
    if not (is_rclpy and options.structural and options.max_cycle):
        return
    for found in structural_verdicts(closed, options.engine, options.limits, shelf):
        yield QueryResult(
            family=found.query.family.value,
            formula=found.query.formula,
            words=found.query.words,
            callbacks=found.query.callbacks,
            verdict=found.verdict,
            reason=found.reason,
            seconds=found.seconds,
            run=found.run,
        )


def _with_loads(results: tuple[QueryResult, ...], closed: ClosedSpec) -> tuple[QueryResult, ...]:
    """Beside what overload might do, say what the rates at hand do."""
    callbacks = {callback.name: callback for callback in closed.spec.callbacks}
    demands = demands_of(closed.spec)
    return tuple(
        replace(result, load=load_of(closed.spec, callbacks[result.callbacks[0]], demands))
        if result.family == build.Family.STRUCTURAL_STARVATION.value
        else result
        for result in results
    )


def _as_far_as_modelled(result: QueryResult, query: build.Query) -> QueryResult:
    """A claim that no run refutes is not proven where the model leaves out what might."""
    unrefuted = Verdict.NOT_SATISFIED if query.formula.startswith('E<>') else Verdict.SATISFIED
    if not query.left_out or result.verdict is not unrefuted:
        return result
    reason = f'the model leaves out {", ".join(query.left_out)}'
    return replace(result, verdict=Verdict.UNDECIDED, reason=reason, run=None)


def _caveats(closed: ClosedSpec, options: Options, found: Found) -> tuple[str, ...]:
    notes = []
    if found.by_slices:
        notes.append(f'{found.by_slices} verdicts are from slices of the unit')
    if options.max_cycle is None:
        notes.append(f'arrivals without bound; fairness of a run: {options.fairness.value}')
    notes.extend(caveats_of(closed.spec, options.profile))
    return tuple(notes)
