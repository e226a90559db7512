"""Units in which callbacks signal what others wait for: every text, every way of asking."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest
from closed_specs import random_waking_unit

from ros2cc_extract.checker.api import Limits, Verdict, check, read_model
from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.arrivals import filled_threads
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.unit import verify_unit

#: A larger one is passed over: it would take seconds.
STATES = 30_000
SLICED = Options(profile=Profile.RCLPY, structural=False)
MOST_STATES = 300_000
#: Eight units that are asked in two seconds; the three before them take fifteen.
QUICK = range(3, 12)
WHOLE = replace(SLICED, limits=Limits(states=MOST_STATES))
LIMIT = 'limit'
Said = dict[str, str]
Ways = Callable[[ClosedSpec], tuple[Said, Said]]


def units(numbers: range, callbacks: int = 4) -> Iterator[tuple[int, ClosedSpec]]:
    for number in numbers:
        unit = random_waking_unit(random.Random(number), callbacks=callbacks, groups=3, threads=3)
        if number_unit(unit, 1).has_resources:
            yield number, unit


def said_by(unit: ClosedSpec, text: Text) -> Said:
    max_cycle = 1 + len(unit.spec.callbacks) % 2
    rendered = render(unit, profile=Profile.RCLPY, text=text, max_cycle=max_cycle)
    model = read_model(rendered.xml, 'unit.xml')
    result = check(model, model.queries, limits=Limits(states=STATES), reduction=False)
    return {
        answer.query.formula: LIMIT if answer.reason else answer.verdict.value
        for answer in result.answers
    }


def by_texts(unit: ClosedSpec) -> tuple[Said, Said]:
    return said_by(unit, Text.PLAIN), said_by(unit, Text.COMPACT)


def verified(unit: ClosedSpec, options: Options) -> Said:
    return {
        r.words: LIMIT if r.reason and not r.in_doubt else r.verdict.value
        for r in verify_unit(unit, options).results
    }


def by_slices(unit: ClosedSpec) -> tuple[Said, Said]:
    return verified(unit, SLICED), verified(unit, WHOLE)


_REFUTED = {Verdict.UNDECIDED.value, Verdict.NOT_SATISFIED.value}
"""One way shows a run that rests on what is not known, the other one that does not."""


def differences(drawn: Iterator[tuple[int, ClosedSpec]], ways: Ways) -> list[object]:
    """What was said both ways, and not alike; what is in doubt was refuted as well."""
    found: list[object] = []
    compared = 0
    for number, unit in drawn:
        one, other = ways(unit)
        assert one.keys() == other.keys()
        both = [asked for asked in one if LIMIT not in (one[asked], other[asked])]
        compared += bool(both)
        found += [
            (number, asked, one[asked], other[asked])
            for asked in both
            if one[asked] != other[asked] and {one[asked], other[asked]} != _REFUTED
        ]
    print(f'{compared} units compared')
    assert compared
    return found


def test_texts_agree() -> None:
    assert differences(units(range(8)), by_texts) == []


@pytest.mark.slow
def test_texts_agree_on_many() -> None:
    assert differences(units(range(1_000, 2_000)), by_texts) == []


def one_bound_for_both(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    monkeypatch.setattr(filled_threads, 'MOST_STATES', MOST_STATES)


def test_slices_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    one_bound_for_both(monkeypatch)
    assert differences(units(QUICK), by_slices) == []


@pytest.mark.slow
def test_slices_agree_on_many(monkeypatch: pytest.MonkeyPatch) -> None:
    one_bound_for_both(monkeypatch)
    assert differences(units(range(2_000, 2_500), callbacks=5), by_slices) == []
