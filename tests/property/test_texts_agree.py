"""
The compact text of a profile gives the verdicts of its plain text: shown unit by unit.

Units are drawn by number, so that one that disagrees can be drawn again. Where the plain text
is too large to be explored in full, the queries it decided are compared.
"""

from collections.abc import Iterable
from random import Random

import pytest
from closed_specs import random_unit

from ros2cc_extract.checker.api import Limits, Verdict, check, read_model
from ros2cc_extract.generator.build import RenderedModel, Text, render


def verdicts(model: RenderedModel, states: int) -> dict[str, Verdict]:
    """Verdict by formula, from an exploration of at most so many states."""
    read = read_model(model.xml, f'{model.name}.xml')
    answers = check(read, read.queries, limits=Limits(states=states)).answers
    return {answer.query.formula: answer.verdict for answer in answers}


def disagreements(number: int, states: int) -> tuple[bool, dict[str, tuple[str, str]]]:
    """Whether unit ``number`` was decided in full, and formula to plain and compact verdict."""
    random = Random(number)
    max_cycle = random.randint(1, 3)
    unit = random_unit(random, callbacks=4, groups=3, threads=3)
    plain, compact = (
        verdicts(render(unit, text=text, max_cycle=max_cycle), states) for text in Text
    )
    decided = {f: v for f, v in plain.items() if v is not Verdict.UNDECIDED}
    return len(decided) == len(plain), {
        formula: (verdict.value, compact[formula].value)
        for formula, verdict in decided.items()
        if verdict is not compact[formula]
    }


def assert_agreement(numbers: Iterable[int], enough: int, states: int) -> None:
    """Compare units until ``enough`` of them were decided in full."""
    compared = ((number, *disagreements(number, states)) for number in numbers)
    full = 0
    for number, is_full, differing in compared:
        assert not differing, f'unit {number}: {differing}'
        full += is_full
        if full == enough:
            return
    pytest.fail(f'only {full} of {enough} units were small enough')


def test_texts_agree_on_small_units():
    assert_agreement(range(1_000), enough=40, states=8_000)


@pytest.mark.slow
def test_texts_agree_on_two_thousand_units():
    assert_agreement(range(1_000, 10_000), enough=2_000, states=5_000_000)
