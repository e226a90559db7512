"""Slices of a unit give the verdicts of the whole unit, on random units."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import pytest
from closed_specs import random_entity_unit, random_rclpy_unit

from ros2cc_extract.checker.api import (
    EngineKind,
    Fairness,
    Limits,
    Query,
    Verdict,
    check,
    read_model,
)
from ros2cc_extract.generator.build import Family, Profile, Text, render
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.arrivals.structural_starvation import structural_verdicts
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.unit import verify_unit

Drawn = Iterator[tuple[int, ClosedSpec]]
SLICED = Options(profile=Profile.RCLPY, structural=False)
WHOLE_STATES = 300_000
#: A limit on states asks for the whole unit.
WHOLE = replace(SLICED, limits=Limits(states=WHOLE_STATES))


def draw(numbers: range, *, callbacks: int) -> Drawn:
    for seed in numbers:
        yield (
            seed,
            random_rclpy_unit(random.Random(seed), callbacks=callbacks, groups=3, threads=4),
        )


def draw_entities(numbers: range, *, callbacks: int) -> Drawn:
    for seed in numbers:
        yield (
            seed,
            random_entity_unit(random.Random(seed), callbacks=callbacks, groups=3, threads=3),
        )


@contextmanager
def no_unit_is_small() -> Iterator[None]:
    """
    Slices are for large units; here all count as such.

    What they leave open is asked of the whole unit with the limit that it is compared with: more
    would be compared with nothing, and takes a dozen GB of some units.
    """
    small, most = narrowing.SMALL, narrowing.WHOLE_STATES
    narrowing.SMALL, narrowing.WHOLE_STATES = 0, WHOLE_STATES
    try:
        yield
    finally:
        narrowing.SMALL, narrowing.WHOLE_STATES = small, most


def differences(unit: ClosedSpec) -> tuple[Verification, list[str]]:
    with no_unit_is_small():
        sliced = verify_unit(unit, SLICED)
    whole = verify_unit(unit, WHOLE)
    pairs = zip(sliced.results, whole.results, strict=True)
    return sliced, [
        f'{one.words}: {one.verdict.value}, whole: {other.verdict.value}'
        for one, other in pairs
        if one.verdict is not other.verdict
        and Verdict.UNDECIDED not in (one.verdict, other.verdict)
    ]


def compare(units: Drawn) -> None:
    by_slices = 0
    for seed, unit in units:
        sliced, different = differences(unit)
        assert not different, (seed, different)
        by_slices += any('slices' in note for note in sliced.notes)
    print(f'verdicts by slices in {by_slices} units')
    assert by_slices


def test_verdicts_of_slices_are_those_of_the_unit() -> None:
    compare(draw(range(20), callbacks=4))


@pytest.mark.slow
def test_verdicts_of_slices_are_those_of_the_unit_on_many() -> None:
    compare(draw(range(1000, 1400), callbacks=6))


def test_slices_with_every_kind_of_entity_agree() -> None:
    compare(draw_entities(range(20), callbacks=4))


@pytest.mark.slow
def test_slices_with_every_kind_of_entity_agree_on_many() -> None:
    compare(draw_entities(range(10_000, 12_000), callbacks=5))


def test_a_run_of_a_slice_names_the_callbacks_that_were_asked_for() -> None:
    """Slices of one shape are asked once; each run is described for its own slice."""
    for _, unit in draw(range(3), callbacks=5):
        with no_unit_is_small():
            found = verify_unit(unit, SLICED)
            for result in found.results:
                if result.run is None or not result.callbacks:
                    continue
                assert result.evidence is not None
                said = [s.text for m in result.evidence.moments for s in m.sentences]
                assert any(name in text for text in said for name in result.callbacks), result


def starving_in_the_whole(unit: ClosedSpec) -> dict[str, Verdict]:
    model = render(unit, profile=Profile.RCLPY, text=Text.COMPACT, max_cycle=None)
    asked = [query for query in model.queries if query.family is Family.STARVATION]
    result = check(
        read_model(model.xml, 'unit.xml'),
        [Query(query.formula, '', None) for query in asked],
        fairness=Fairness.WEAK,
        limits=Limits(states=200_000),
    )
    pairs = zip(asked, result.answers, strict=True)
    return {query.callbacks[0]: answer.verdict for query, answer in pairs}


def compare_starvation(units: Drawn) -> None:
    """Without waits, as structural starvation leaves them out."""
    decided = 0
    for seed, unit in units:
        callbacks = tuple(replace(c, blocking=()) for c in unit.spec.callbacks)
        unit = replace(unit, spec=replace(unit.spec, callbacks=callbacks))
        whole = starving_in_the_whole(unit)
        for found in structural_verdicts(unit, EngineKind.AUTO, Limits()):
            (name,) = found.query.callbacks
            if whole[name] is not Verdict.UNDECIDED:
                assert (seed, name, found.verdict) == (seed, name, whole[name])
                decided += 1
    print(f'{decided} verdicts on starvation compared')
    assert decided


def test_structural_starvation_of_slices_is_that_of_the_unit() -> None:
    compare_starvation(draw(range(15), callbacks=3))


@pytest.mark.slow
def test_structural_starvation_of_slices_is_that_of_the_unit_on_many() -> None:
    compare_starvation(draw(range(2000, 2300), callbacks=4))
