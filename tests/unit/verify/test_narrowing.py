"""What a large unit is asked, slice by slice, and what follows from the answers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import pytest

from ros2cc_extract.checker.api import CheckResult, Limits, Verdict
from ros2cc_extract.generator.build import Family, Profile, Query, render
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.search_results import SLICE_STATES, Found, Key
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.slices.narrowing import FIRST_LOOK_STATES, narrow

SATISFIED, REFUTED, OPEN = Verdict.SATISFIED, Verdict.NOT_SATISFIED, Verdict.UNDECIDED
Answers = Callable[[Key], Verdict]


@dataclass
class Asked:
    """A search that answers from a table, and remembers what it was asked."""

    answers: Answers
    is_complete: bool = True
    questions: list[tuple[tuple[str, ...], list[Key], int | None]] = field(default_factory=list)

    def __call__(self, closed: ClosedSpec, keys: Sequence[Key], limits: Limits) -> Found:
        names = tuple(callback.name for callback in closed.spec.callbacks)
        self.questions.append((names, list(keys), limits.states))
        results = {key: result(key, self.answers(key)) for key in keys}
        return Found(results, checked(complete=self.is_complete))

    def units(self) -> list[tuple[str, ...]]:
        return [names for names, _, _ in self.questions]


def result(key: Key, verdict: Verdict) -> QueryResult:
    family, callbacks, _ = key
    return QueryResult(
        family=family.value,
        formula='',
        words='',
        callbacks=callbacks,
        verdict=verdict,
        reason='limit' if verdict is OPEN else None,
        seconds=0.0,
        run=None,
    )


def checked(*, complete: bool) -> CheckResult:
    return CheckResult(
        engine='table',
        note='',
        states=10,
        transitions=20,
        seconds=0.5,
        peak_mb=30.0,
        complete=complete,
        answers=(),
    )


def all_are(verdict: Verdict) -> Answers:
    return lambda key: verdict


def subscription(name: str, group: str, *waits_for: str) -> Callback:
    return Callback(
        name=name,
        type=EntityKind.SUBSCRIPTION.published_type,
        entity=EntityKind.SUBSCRIPTION,
        group=group,
        blocking=tuple(Blocking(call='Event.wait', on=on) for on in waits_for),
    )


def unit(callbacks: Iterable[Callback], threads: int = 2) -> ClosedSpec:
    callbacks = tuple(callbacks)
    groups = dict.fromkeys(callback.group for callback in callbacks)
    return close(
        Spec(
            name='unit',
            callbacks=callbacks,
            groups=tuple(CallbackGroup(name=g, type=GroupType.EXCLUSIVE) for g in groups),
            executor=Executor(
                name='executor',
                kind='MultiThreadedExecutor',
                threads=tuple(f't{number}' for number in range(threads)),
            ),
        )
    )


def queries_of(closed: ClosedSpec, *families: Family) -> list[Query]:
    queries = render(closed, profile=Profile.RCLPY).queries
    return [query for query in queries if query.family in families]


def verdicts(found: Found) -> dict[tuple[Family, tuple[str, ...]], Verdict]:
    return {(family, names): r.verdict for (family, names, _), r in found.results.items()}


#: Nine callbacks in groups of their own: one more than are explored as a whole at once.
APART = unit(subscription(f'c{n}', f'g{n}') for n in range(9))


def test_a_small_unit_is_asked_as_a_whole() -> None:
    small = unit([subscription('a', 'g'), subscription('b', 'g')])
    search = Asked(all_are(SATISFIED))
    queries = queries_of(small, Family.NEVER_TOGETHER, Family.SERIAL)
    found = narrow(small, queries, 1, search, Limits())
    assert [(names, states) for names, _, states in search.questions] == [
        (('a', 'b'), FIRST_LOOK_STATES)
    ]
    assert (found.by_slices, found.check.complete) == (0, True)


def test_a_small_unit_with_many_states_keeps_what_the_first_look_decided() -> None:
    small = unit([subscription('a', 'g'), subscription('b', 'g'), subscription('c', 'h')])
    queries = queries_of(small, Family.NEVER_TOGETHER)
    first = {('a', 'b')}

    def answers(key: Key) -> Verdict:
        return SATISFIED if key[1] in first or len(search.questions) > 1 else OPEN

    search = Asked(answers, is_complete=False)
    found = narrow(small, queries, 1, search, Limits())
    assert search.units() == [('a', 'b', 'c'), ('a', 'c')]  # ('b', 'c') is of the same shape
    assert set(verdicts(found).values()) == {SATISFIED}
    assert (found.by_slices, found.check.complete) == (2, True)


def test_slices_of_one_shape_are_asked_once() -> None:
    search = Asked(all_are(SATISFIED))
    found = narrow(APART, queries_of(APART, Family.NEVER_TOGETHER), 1, search, Limits())
    assert [(names, len(keys), states) for names, keys, states in search.questions] == [
        (('c0', 'c1'), 14, SLICE_STATES)  # all that can be asked of it
    ]
    assert len(found.results) == found.by_slices == 36
    assert found.check == checked(complete=True)


def test_what_slices_leave_open_is_asked_of_the_whole_unit() -> None:
    def answers(key: Key) -> Verdict:
        return REFUTED if len(search.questions) > 1 else OPEN

    search = Asked(answers)
    queries = queries_of(APART, Family.SELF_OVERLAP)
    found = narrow(APART, queries, 1, search, Limits())
    names = tuple(f'c{n}' for n in range(9))
    assert search.units() == [('c0',), names]
    assert search.questions[1][1] == [(Family.SELF_OVERLAP, (name,), ()) for name in names]
    assert search.questions[1][2] is None
    assert set(verdicts(found).values()) == {REFUTED}
    assert (found.check.states, found.check.seconds) == (20, 1.0)


def test_without_time_nothing_is_asked_and_all_is_open() -> None:
    search = Asked(all_are(OPEN))
    queries = queries_of(APART, Family.SELF_OVERLAP)
    found = narrow(APART, queries, 1, search, Limits(seconds=0))
    assert search.questions == []
    assert {r.reason for r in found.results.values()} == {'the limit of 0 s was reached'}
    assert set(verdicts(found).values()) == {OPEN}
    assert len(found.results) == len(queries)
    assert not found.check.complete


def test_nothing_is_serial_where_two_run_together() -> None:
    def answers(key: Key) -> Verdict:
        return REFUTED if key[0] is Family.NEVER_TOGETHER else SATISFIED

    search = Asked(answers)
    families = (Family.NEVER_TOGETHER, Family.SELF_OVERLAP, Family.SERIAL)
    found = narrow(APART, queries_of(APART, *families), 1, search, Limits())
    assert verdicts(found)[Family.SERIAL, ()] is REFUTED
    assert search.units() == [('c0', 'c1'), ('c0',)]


def test_all_is_serial_where_no_two_run_together_and_none_overlaps_itself() -> None:
    search = Asked(all_are(SATISFIED))
    families = (Family.NEVER_TOGETHER, Family.SELF_OVERLAP, Family.SERIAL)
    found = narrow(APART, queries_of(APART, *families), 1, search, Limits())
    assert verdicts(found)[Family.SERIAL, ()] is SATISFIED
    assert max(len(names) for names in search.units()) == 2


@pytest.mark.parametrize('families', [(Family.NEVER_TOGETHER,), (Family.SELF_OVERLAP,)])
def test_what_is_serial_does_not_follow_from_half_of_it(families: tuple[Family, ...]) -> None:
    search = Asked(all_are(SATISFIED))
    narrow(APART, queries_of(APART, *families, Family.SERIAL), 1, search, Limits())
    assert search.questions[-1] == (
        tuple(f'c{n}' for n in range(9)),
        [(Family.SERIAL, (), ())],
        None,
    )


def waiting(threads: int) -> ClosedSpec:
    """Two that wait, each for somebody in a group of his own, and six bystanders."""
    return unit(
        [
            subscription('a', 'ga', 'b'),
            subscription('b', 'gb'),
            subscription('c', 'gc', 'd'),
            subscription('d', 'gd'),
            *(subscription(f'e{n}', f'ge{n}') for n in range(6)),
        ],
        threads,
    )


OF_ENDS = (Family.DEADLOCK, Family.PROGRESS)


@pytest.mark.parametrize('verdict', [SATISFIED, REFUTED])
def test_there_is_a_dead_lock_where_somebody_comes_to_no_end(verdict: Verdict) -> None:
    closed = waiting(threads=3)
    search = Asked(all_are(verdict))
    found = narrow(closed, queries_of(closed, *OF_ENDS), 1, search, Limits())
    assert search.units() == [('a', 'b')]
    assert verdicts(found) == {
        (Family.DEADLOCK, ()): verdict,
        (Family.PROGRESS, ('a',)): verdict,
        (Family.PROGRESS, ('c',)): verdict,
    }


def test_an_end_that_is_open_leaves_the_dead_lock_open() -> None:
    def answers(key: Key) -> Verdict:
        return SATISFIED if len(search.questions) > 1 else OPEN

    closed = waiting(threads=3)
    search = Asked(answers)
    found = narrow(closed, queries_of(closed, *OF_ENDS), 1, search, Limits())
    assert [len(names) for names in search.units()] == [2, 10]
    assert [family for family, *_ in search.questions[-1][1]] == [
        Family.DEADLOCK,
        Family.PROGRESS,
        Family.PROGRESS,
    ]
    assert set(verdicts(found).values()) == {SATISFIED}


@pytest.mark.parametrize(('threads', 'searches'), [(2, 2), (3, 1)])
def test_all_that_end_are_no_dead_lock_only_if_a_thread_is_free(
    threads: int, searches: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first look has decided who comes to an end."""
    monkeypatch.setattr(narrowing, 'SMALL', 10)

    def answers(key: Key) -> Verdict:
        return OPEN if key[0] is Family.DEADLOCK else SATISFIED

    closed = waiting(threads)
    search = Asked(answers, is_complete=False)
    narrow(closed, queries_of(closed, *OF_ENDS), 1, search, Limits())
    assert len(search.questions) == searches


def test_where_all_threads_may_be_held_there_is_no_slice_for_ends() -> None:
    closed = waiting(threads=2)
    search = Asked(all_are(SATISFIED))
    narrow(closed, queries_of(closed, *OF_ENDS), 1, search, Limits())
    assert [len(names) for names in search.units()] == [10]


def test_a_run_of_another_slice_of_its_shape_is_searched_when_it_is_asked_for() -> None:
    """A callback that is asked second gets a run of its own slice, with its own names."""

    def search(closed: ClosedSpec, keys: Sequence[Key], limits: Limits) -> Found:
        found = asked(closed, keys, limits)
        names = tuple(callback.name for callback in closed.spec.callbacks)
        return Found(
            {key: with_run(each, names) for key, each in found.results.items()}, found.check
        )

    asked = Asked(all_are(REFUTED))
    found = narrow(APART, queries_of(APART, Family.SELF_OVERLAP), 1, search, Limits())
    told = [str(each.evidence) for each in found.results.values()]
    assert told == [str((f'c{n}',)) for n in range(9)]
    assert asked.units() == [(f'c{n}',) for n in range(9)]


def with_run(found: QueryResult, names: tuple[str, ...]) -> QueryResult:
    """A result whose run is known by the callbacks of the unit that was searched."""
    values = {each: getattr(found, each) for each in QueryResult.__dataclass_fields__}
    return QueryResult(**{**values, 'run': lambda: names})


def test_the_first_look_is_for_units_that_are_small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 9)
    search = Asked(all_are(SATISFIED))
    narrow(APART, queries_of(APART, Family.SELF_OVERLAP), 1, search, Limits())
    assert [(len(names), states) for names, _, states in search.questions] == [
        (9, FIRST_LOOK_STATES)
    ]
