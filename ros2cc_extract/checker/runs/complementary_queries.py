"""
Queries that deny each other: ``A[] not (p)`` rules out ``E<> (p)``: one search answers both.

A unit asks both of every two callbacks, which are most of its queries.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.checker.engines.terms import Verdict
from ros2cc_extract.checker.runs.answers import Answer
from ros2cc_extract.checker.uppaal.files.query_file import Query

POSSIBLE, NEVER = 'E<> (', 'A[] not ('
_DENIED = {
    Verdict.SATISFIED: Verdict.NOT_SATISFIED,
    Verdict.NOT_SATISFIED: Verdict.SATISFIED,
    Verdict.UNDECIDED: Verdict.UNDECIDED,
}


def twins_of(formulas: Sequence[str]) -> dict[int, int]:
    """
    Name for a query the earlier one that says the opposite of it, by their numbers.

    By the text alone; what is written otherwise is asked on its own.
    """
    first: dict[tuple[str, str], int] = {}
    twins = {}
    for number, formula in enumerate(formulas):
        start = next((s for s in (POSSIBLE, NEVER) if formula.startswith(s)), None)
        if start is None or not _is_one_bracket(formula[len(start) :]):
            continue
        other = NEVER if start is POSSIBLE else POSSIBLE
        inside = formula[len(start) :]
        if (other, inside) in first:
            twins[number] = first[other, inside]
        else:
            first.setdefault((start, inside), number)
    return twins


def _is_one_bracket(rest: str) -> bool:
    """Return whether the bracket open before ``rest`` is closed by its end and no sooner."""
    if not rest.endswith(')') or '/*' in rest or '//' in rest:
        return False
    depth = 1
    for position, sign in enumerate(rest):
        depth += (sign == '(') - (sign == ')')
        if depth == 0:
            return position == len(rest) - 1
    return False


def with_twins(
    queries: Sequence[Query], reported: Sequence[Answer], twins: dict[int, int]
) -> tuple[Answer, ...]:
    """Put the answers of queries that were not searched for between those that were."""
    rest = iter(reported)
    answers: list[Answer] = []
    for number, query in enumerate(queries):
        if number not in twins:
            answers.append(next(rest))
            continue
        first = answers[twins[number]]
        replay = first.shown if first.replay else None
        answers.append(replace(first, query=query, verdict=_DENIED[first.verdict], replay=replay))
    return tuple(answers)
