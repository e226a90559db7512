"""
The programs of ``tests/help`` on real rclpy: the fault shows, and a help carried out mends it.

What is found in their sources is compared in ``tests/help/test_help.py``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from side_by_side import PATIENCE_S, Program, RunForked

from tests.help.cases import asking, cases

# Who has not got through by then, never does.
STUCK_S = 2.0
# Of so many programs one is run each time, and all of them where it may take long.
SAMPLED = 4
ASKS = 'asks'


def programs() -> Iterator[Program]:
    for case in cases():
        if case.is_run:
            patience_s = PATIENCE_S if case.shows else STUCK_S
            shows = case.shows or (ASKS, case.through)
            yield _program(case.name, asking(case), shows, patience_s)
        for at, mended in enumerate(case.mended, 1):
            if mended.is_run:
                text = f'print({ASKS!r}, flush=True)\n{case.mended_text(mended)}'
                shows = mended.shows or (case.through, case.through)
                yield _program(f'{case.name}_{at}', text, shows, PATIENCE_S)


def _program(name: str, text: str, shows: tuple[str, ...], patience_s: float) -> Program:
    path = str(Path(__file__).with_name(f'{name}.py'))
    return Program(name=name, path=path, text=text, patience_s=patience_s, awaited=shows)


def unlike(run: RunForked, each_of: int = 1) -> dict[str, list[str]]:
    """What was said by those that do not behave as described; one of ``each_of`` is run."""
    chosen = list(programs())[::each_of]
    told = run(chosen)
    return {each.name: told[each.name] for each in chosen if not _is_so(each, told[each.name])}


def _is_so(program: Program, lines: list[str]) -> bool:
    left = list(program.awaited)
    for line in lines:
        if left and re.fullmatch(left[0], line):
            del left[0]
    return ASKS in lines and bool(left) is (program.patience_s == STUCK_S)


def test_faults_show_and_helps_mend(run_forked: RunForked) -> None:
    assert unlike(run_forked, SAMPLED) == {}


@pytest.mark.slow
def test_faults_show_and_helps_mend_on_each_release(run_forked_everywhere: RunForked) -> None:
    assert unlike(run_forked_everywhere) == {}
