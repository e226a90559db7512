"""
The compact text of a profile gives the verdicts of its plain text: shown unit by unit.

Units are drawn by number, so that one that disagrees can be drawn again. Where the plain text
is too large to be explored in full, the queries it decided are compared.
"""

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

import pytest
from closed_specs import random_rclpy_unit, random_unit

from ros2cc_extract.checker.api import Fairness, Limits, Verdict, check, read_model
from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.spec.close import ClosedSpec


@dataclass(frozen=True)
class Case:
    """A drawn unit; without a bound on arrivals only fair runs count."""

    unit: ClosedSpec
    profile: Profile
    max_cycle: int | None


def paper_case(number: int) -> Case:
    random = Random(number)
    max_cycle = random.choice((1, 2, 3, None))
    unit = random_unit(random, callbacks=4, groups=3, threads=3)
    return Case(unit, Profile.PAPER, max_cycle)


def rclpy_case(number: int) -> Case:
    random = Random(number)
    max_cycle = random.choice((1, 1, 2, None))
    unit = random_rclpy_unit(random, callbacks=4, groups=3, threads=3)
    return Case(unit, Profile.RCLPY, max_cycle)


def verdicts(case: Case, text: Text, states: int) -> dict[str, Verdict]:
    """Verdict by formula, from an exploration of at most so many states."""
    model = render(case.unit, profile=case.profile, text=text, max_cycle=case.max_cycle)
    read = read_model(model.xml, f'{model.name}.xml')
    fairness = Fairness.WEAK if case.max_cycle is None else Fairness.NONE
    limits = Limits(states=states)
    result = check(read, read.queries, limits=limits, fairness=fairness, reduction=False)
    return {answer.query.formula: answer.verdict for answer in result.answers}


def disagreements(case: Case, states: int) -> tuple[bool, dict[str, tuple[str, str]]]:
    """Whether the unit was decided in full, and formula to plain and compact verdict."""
    plain, compact = (verdicts(case, text, states) for text in Text)
    decided = {f: v for f, v in plain.items() if v is not Verdict.UNDECIDED}
    return len(decided) == len(plain), {
        formula: (verdict.value, compact[formula].value)
        for formula, verdict in decided.items()
        if verdict is not compact[formula]
    }


def assert_agreement(
    draw: Callable[[int], Case], numbers: range, enough: int, states: int
) -> None:
    """Compare units until ``enough`` of them were decided in full."""
    full = 0
    for number in numbers:
        is_full, differing = disagreements(draw(number), states)
        assert not differing, f'unit {number}: {differing}'
        full += is_full
        if full == enough:
            return
    pytest.fail(f'only {full} of {enough} units were small enough')


@pytest.mark.parametrize('draw', [paper_case, rclpy_case])
def test_texts_agree_on_small_units(draw: Callable[[int], Case]):
    assert_agreement(draw, range(1_000), enough=40, states=8_000)


@pytest.mark.slow
@pytest.mark.parametrize('draw', [paper_case, rclpy_case])
def test_texts_agree_on_two_thousand_units(draw: Callable[[int], Case]):
    assert_agreement(draw, range(1_000, 10_000), enough=2_000, states=400_000)
