"""Lets verifyta answer in place of the embedded checker; its runs are replayed by ours."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ros2cc_extract.checker.api import Answer, CheckResult, Fairness, Model, Query, Run, Verdict
from ros2cc_extract.checker.runs.printed_runs import replay_named
from ros2cc_extract.errors import CoreMismatchError, InputError
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.uppaal.verifyta import VerifytaAnswer, run_verifyta
from ros2cc_extract.verify.uppaal.verifyta_processes import Runs


def check_by_verifyta(
    model: Model | None,
    xml: bytes,
    queries: Sequence[Query],
    *,
    program: Path,
    runs: Runs,
    fairness: Fairness,
    seconds: float | None,
) -> CheckResult:
    """
    Answer all queries.

    :param model: what ``xml`` holds, where our checker can read it; without it no run is kept.
    :raises LicenceError: when the program asks for a licence.
    """
    formulas = [query.formula for query in queries]
    printed = run_verifyta(program, xml, formulas, runs=runs, seconds=seconds)
    notes = []
    if fairness is not Fairness.NONE:
        notes.append('verifyta knows no fairness: all infinite runs count')
    answers = []
    for number, (query, answer) in enumerate(zip(queries, printed, strict=True), start=1):
        replay, trouble = _replayed(model, query, number, answer) if model else (None, [])
        notes += trouble
        answers.append(
            Answer(
                query=query,
                verdict=answer.verdict,
                reason=answer.reason,
                seconds=answer.seconds,
                replay=replay,
            )
        )
    taken = [answer.seconds for answer in printed]
    return CheckResult(
        engine='verifyta',
        note='; '.join(notes),
        states=max(answer.states for answer in printed),
        transitions=0,
        seconds=max(taken) if runs is Runs.TOGETHER else sum(taken),
        peak_mb=max(answer.peak_mb for answer in printed),
        complete=all(answer.verdict is not Verdict.UNDECIDED for answer in printed),
        answers=tuple(answers),
    )


def _replayed(
    model: Model, query: Query, number: int, answer: VerifytaAnswer
) -> tuple[Callable[[], Run] | None, list[str]]:
    """The run that was printed, if it can be replayed; otherwise why it is not shown."""
    if not answer.printed:
        return None, []
    source = Place(f'run of query {number} as verifyta printed it')
    try:
        run = replay_named(model, query, answer.printed, source)
    except (InputError, CoreMismatchError) as error:
        return None, [f'{error}; not shown']
    return lambda: run, []
