"""
Units with nested spins, absent services, foreign futures, locks: every text, every way of asking.

The compact text gives the verdicts of the plain one, slices those of the whole unit.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest
from closed_specs import random_locking_unit, random_spinning_unit

from ros2cc_extract.checker.api import Limits, Verdict, check, read_model
from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.unit import verify_unit

#: A larger one is passed over: it would take seconds.
STATES = 20_000
SLICED = Options(profile=Profile.RCLPY, structural=False)
WHOLE = replace(SLICED, limits=Limits(states=10**6))
Verdicts = dict[str, Verdict]
Ways = Callable[[ClosedSpec], tuple[Verdicts, Verdicts]]


def spinning_units(numbers: range, callbacks: int = 4) -> Iterator[tuple[int, ClosedSpec]]:
    """Those of the units drawn in which somebody spins, or waits for what no callback gives."""
    for number in numbers:
        unit = random_spinning_unit(
            random.Random(number), callbacks=callbacks, groups=3, threads=2
        )
        numbered = number_unit(unit, 1)
        if numbered.has_spins or numbered.has_absent or numbered.has_foreign:
            yield number, unit


def locking_units(numbers: range, callbacks: int = 4) -> Iterator[tuple[int, ClosedSpec]]:
    """Those of the units drawn in which somebody holds a lock over a wait that others take."""
    for number in numbers:
        unit = random_locking_unit(random.Random(number), callbacks=callbacks, groups=3, threads=3)
        if number_unit(unit, 1).has_locks:
            yield number, unit


def verdicts(unit: ClosedSpec, text: Text, max_cycle: int) -> Verdicts:
    rendered = render(unit, profile=Profile.RCLPY, text=text, max_cycle=max_cycle)
    model = read_model(rendered.xml, 'unit.xml')
    result = check(model, model.queries, limits=Limits(states=STATES), reduction=False)
    return {answer.query.formula: answer.verdict for answer in result.answers}


def by_texts(unit: ClosedSpec) -> tuple[Verdicts, Verdicts]:
    max_cycle = 1 + len(unit.spec.callbacks) % 2
    return verdicts(unit, Text.PLAIN, max_cycle), verdicts(unit, Text.COMPACT, max_cycle)


def by_slices(unit: ClosedSpec) -> tuple[Verdicts, Verdicts]:
    sliced, whole = verify_unit(unit, SLICED), verify_unit(unit, WHOLE)
    return (
        {result.words: result.verdict for result in sliced.results},
        {result.words: result.verdict for result in whole.results},
    )


def differences(units: Iterator[tuple[int, ClosedSpec]], ways: Ways) -> list[object]:
    """What was decided both ways, and not alike."""
    found = []
    for number, unit in units:
        one, other = ways(unit)
        assert one.keys() == other.keys()
        found += [
            (number, asked, one[asked].value, other[asked].value)
            for asked in one
            if Verdict.UNDECIDED not in (one[asked], other[asked]) and one[asked] != other[asked]
        ]
    return found


#: Numbers of units for which a smaller text, or slice, has once given other verdicts.
ONCE_OTHER_TEXTS, ONCE_OTHER_SLICES = (1021, 1329), (2007, 2143)
ONCE_OTHER_SLICES_WITH_LOCKS = range(2418, 2419)


def each_of(numbers: tuple[int, ...], callbacks: int) -> Iterator[tuple[int, ClosedSpec]]:
    for number in numbers:
        yield from spinning_units(range(number, number + 1), callbacks)


def test_units_that_have_once_differed() -> None:
    assert differences(each_of(ONCE_OTHER_TEXTS, 4), by_texts) == []


@pytest.mark.slow
def test_slices_that_have_once_differed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    assert differences(each_of(ONCE_OTHER_SLICES, 5), by_slices) == []


def test_slices_with_locks_that_have_once_differed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    units = locking_units(ONCE_OTHER_SLICES_WITH_LOCKS, callbacks=5)
    assert differences(units, by_slices) == []


def test_texts_agree() -> None:
    assert differences(spinning_units(range(15)), by_texts) == []


@pytest.mark.slow
def test_texts_agree_on_many() -> None:
    assert differences(spinning_units(range(1_000, 2_000)), by_texts) == []


def test_slices_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    assert differences(spinning_units(range(10)), by_slices) == []


@pytest.mark.slow
def test_slices_agree_on_many(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    assert differences(spinning_units(range(2_000, 2_300), callbacks=5), by_slices) == []


def test_texts_with_locks_agree() -> None:
    assert differences(locking_units(range(30)), by_texts) == []


@pytest.mark.slow
def test_texts_with_locks_agree_on_many() -> None:
    assert differences(locking_units(range(1_000, 2_500)), by_texts) == []


def test_slices_with_locks_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    assert differences(locking_units(range(30)), by_slices) == []


@pytest.mark.slow
def test_slices_with_locks_agree_on_many(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    assert differences(locking_units(range(2_000, 3_000), callbacks=5), by_slices) == []
