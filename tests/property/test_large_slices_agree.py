"""What decides claims whose slice is too large says what the whole unit says, on random units."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import pytest
from closed_specs import random_waking_unit

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Profile, Query, queries_of
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.effects import Blocking, Waker
from ros2cc_extract.spec.model import GroupType
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search import model_search
from ros2cc_extract.verify.search.known_answers import Shelf
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.search.search_results import Key, key_of
from ros2cc_extract.verify.slices.guided_runs import refute_by_hunts
from ros2cc_extract.verify.slices.relaxed_units import is_loose, loosened
from ros2cc_extract.verify.slices.separate_waits import prove_apart
from ros2cc_extract.verify.slices.slice_queries import Slicing
from ros2cc_extract.verify.slices.slicer import Slicer

LIMITS = Limits(states=30_000)
OPTIONS = Options(profile=Profile.RCLPY, reduction=False, limits=LIMITS)
search = partial(model_search.search, options=OPTIONS, progress=None)
refute = partial(model_search.refute_over_waypoints, options=OPTIONS)
Said = dict[Key, QueryResult]
Way = Callable[[ClosedSpec, list[Query]], Iterator[Said]]


def by_loosening(unit: ClosedSpec, queries: list[Query]) -> Iterator[Said]:
    if Slicer(unit, 1).spins:
        return
    for loose in loosened(unit):
        slicing = Slicing(Slicer(loose.closed, 1), search, Limits(), Shelf())
        found = slicing.decide(query for query in queries if is_loose(query, unit, 1))
        if found is not None:
            yield loose.decided(found.results)


def by_hunts(unit: ClosedSpec, queries: list[Query]) -> Iterator[Said]:
    found = refute_by_hunts(Slicer(unit, 1), queries, refute, LIMITS)
    if found is not None:
        yield found.results


def apart(unit: ClosedSpec, queries: list[Query]) -> Iterator[Said]:
    found = prove_apart(Slicer(unit, 1), queries, search, LIMITS)
    if found is not None:
        yield found.results


def compared(units: Iterator[tuple[int, ClosedSpec]], way: Way) -> int:
    """Compare what one way decides with the whole unit."""
    decided: Counter[str] = Counter()
    for number, unit in units:
        queries = list(queries_of(unit, profile=Profile.RCLPY))
        whole = search(unit, [key_of(query) for query in queries], LIMITS).results
        for said in way(unit, queries):
            for key, result in said.items():
                verdicts = {result.verdict, whole[key].verdict} - {Verdict.UNDECIDED}
                assert len(verdicts) <= 1, (number, key, result.verdict, whole[key].verdict)
                decided[key[0].value] += len(verdicts)
    print(dict(decided))
    return decided.total()


def waking(numbers: range, callbacks: int = 4) -> Iterator[tuple[int, ClosedSpec]]:
    for number in numbers:
        drawn = random.Random(number)
        yield number, random_waking_unit(drawn, callbacks=callbacks, groups=3, threads=3)


def alone(numbers: range) -> Iterator[tuple[int, ClosedSpec]]:
    """Units in which one callback waits, for one after the other; some have services."""
    for number, unit in waking(numbers, callbacks=5):
        drawn = random.Random(-number)
        spec = unit.spec
        waiter = drawn.choice(spec.callbacks).name
        names = [callback.name for callback in spec.callbacks]
        served = tuple(
            replace(c, locks=(), blocking=_waits(names, drawn) if c.name == waiter else ())
            for c in spec.callbacks
        )
        groups = tuple(
            replace(g, type=drawn.choice((GroupType.EXCLUSIVE, g.type))) for g in spec.groups
        )
        executor = replace(spec.executor, kind='MultiThreadedExecutor', threads=('t0', 't1', 't2'))
        yield (
            number,
            replace(
                unit,
                spec=replace(
                    spec, callbacks=served, activities=(), groups=groups, executor=executor
                ),
            ),
        )


def _waits(names: list[str], drawn: random.Random) -> tuple[Blocking, ...]:
    return tuple(
        drawn.choice((_call, _signalled))(names, drawn) for _ in range(drawn.choice((2, 2, 3)))
    )


def _call(names: list[str], drawn: random.Random) -> Blocking:
    is_skipped = drawn.random() < 0.5
    return Blocking(call='client.call', on=drawn.choice(names), conditional=is_skipped)


def _signalled(names: list[str], drawn: random.Random) -> Blocking:
    return Blocking(
        call='Event.wait',
        resource=drawn.choice(('done', 'other')),
        wakers=tuple(Waker(by=drawn.choice(names)) for _ in range(drawn.choice((1, 2)))),
        forgets=drawn.random() < 0.2,
        conditional=drawn.random() < 0.5,
    )


WAYS = pytest.mark.parametrize(
    'way', (by_loosening, by_hunts, apart), ids=lambda way: way.__name__
)


def test_whom_two_ask_may_overlap_itself() -> None:
    """Unasked it would run once."""
    compared(alone(range(154, 155)), by_loosening)


@WAYS
def test_where_one_waits(way: Way) -> None:
    assert compared(alone(range(12)), way)


@pytest.mark.slow
@WAYS
def test_where_one_waits_on_many(way: Way) -> None:
    assert compared(alone(range(1_000, 3_000)), way)


@pytest.mark.parametrize('way', (by_loosening, by_hunts), ids=lambda way: way.__name__)
def test_where_many_wait(way: Way) -> None:
    assert compared(waking(range(12)), way)


@pytest.mark.slow
@WAYS
def test_where_many_wait_on_many(way: Way) -> None:
    compared(waking(range(1_000, 3_000)), way)
