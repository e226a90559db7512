"""Runs by chance: they refute what lies at the end of a run, and nothing that holds."""

from __future__ import annotations

from ros2cc_extract.checker.api import Limits, Model, Query, Verdict
from ros2cc_extract.checker.refutation.random_runs import dive
from tests.support.small import automaton, network

COUNTERS = 12
"""So many count to nine at once: nine to the twelfth states, and one way to end each of them."""


def counters() -> Model:
    drawing = """count done
    count -> count; guard: n < 9; do: n++, total++
    count -> done; guard: n == 9"""
    names = ', '.join(f'P{number}' for number in range(COUNTERS))
    made = ' '.join(f'P{number} = P();' for number in range(COUNTERS))
    return network(
        automaton('P', drawing, local='int[0, 9] n;'),
        declaration='int[0, 200] total;',
        system=f'{made} system {names};',
    )


def verdicts(model: Model, *formulas: str) -> list[Verdict]:
    asked = [Query(formula, '', None) for formula in formulas]
    return [answer.verdict for answer in dive(model, asked, limits=Limits()).answers]


def test_a_run_to_its_end_refutes_what_lies_far_from_the_start() -> None:
    found = dive(counters(), [Query('A[] not (deadlock and P3.done)', '', None)], limits=Limits())
    (answer,) = found.answers
    assert answer.verdict is Verdict.NOT_SATISFIED
    assert answer.path is not None
    assert len(answer.path.steps) == COUNTERS * 10


def test_what_holds_or_is_not_of_ends_stays_open() -> None:
    formulas = ('A[] not (deadlock and P3.count)', 'E<> total == 5', 'A<> total == 500')
    assert verdicts(counters(), *formulas) == [Verdict.UNDECIDED] * 3


def test_what_never_comes_after_the_last_step_is_refuted() -> None:
    formulas = ('total == 108 --> total == 0', 'total == 108 --> P1.done')
    assert verdicts(counters(), *formulas) == [Verdict.NOT_SATISFIED, Verdict.UNDECIDED]


def test_a_model_without_ends_keeps_its_limit() -> None:
    model = network(automaton('P', 'a b\na -> b\nb -> a'))
    assert verdicts(model, 'A[] not deadlock') == [Verdict.UNDECIDED]


def test_half_of_the_runs_come_to_what_is_avoided_only_where_they_must() -> None:
    """Each of many steps has a way that spoils the run: chance alone leaves none unspoilt."""
    drawing = """go done
    go -> go; guard: n < 400; do: n++
    go -> go; guard: n < 400; do: n++, spoilt = true
    go -> done; guard: n == 400"""
    declaration = 'bool spoilt; int[0, 400] n;'
    asked = [Query('A[] not (deadlock and !spoilt)', '', None)]
    model = network(automaton('P', drawing), declaration=declaration)
    alone = dive(model, asked, limits=Limits()).answers[0].verdict
    avoiding = dive(model, asked, limits=Limits(), avoided='spoilt').answers[0].verdict
    assert (alone, avoiding) == (Verdict.UNDECIDED, Verdict.NOT_SATISFIED)
