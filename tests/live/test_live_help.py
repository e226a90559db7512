"""
The programs of ``tests/help`` on real rclpy: the fault shows, and a help carried out mends it.

What is found in their sources is compared in ``tests/help/test_help.py``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from side_by_side import PATIENCE_S, Program, RunForked

from tests.help.cases import THROUGH, cases
from tests.help.cases import asking as asking_text

SHORT_S, LONG_S = 2.0, 8.0
Awaited = Mapping[str, tuple[str, ...]]


def programs(bad_for_s: float) -> Iterator[Program]:
    for case in cases():
        if case.is_run:
            yield _program(case.name, asking_text(case), case.shows, bad_for_s)
        for at, mended in enumerate(case.mended, 1):
            if mended.is_run:
                name = f'{case.name}_{at}'
                text = f'print("asks", flush=True)\n{case.mended_text(mended)}'
                yield _program(name, text, mended.shows, PATIENCE_S)


def _program(name: str, text: str, shows: tuple[str, ...], patience_s: float) -> Program:
    is_stuck = not shows
    return Program(
        name=name,
        path=str(Path(__file__).with_name(f'{name}.py')),
        text=text,
        patience_s=patience_s if is_stuck else PATIENCE_S,
        awaited=('asks', THROUGH) if is_stuck else shows,
    )


def unlike(run: RunForked, bad_for_s: float) -> dict[str, list[str]]:
    """What was said by those that do not do what is told of them."""
    all_of_them = list(programs(bad_for_s))
    told = run(all_of_them)
    return {
        each.name: told[each.name]
        for each in all_of_them
        if _has_come(each.awaited, told[each.name]) is (each.patience_s < PATIENCE_S)
    }


def _has_come(awaited: tuple[str, ...], lines: list[str]) -> bool:
    left = list(awaited)
    for line in lines:
        if left and re.fullmatch(left[0], line):
            del left[0]
    return not left


def test_faults_show_and_helps_mend(run_forked: RunForked) -> None:
    assert unlike(run_forked, SHORT_S) == {}


@pytest.mark.slow
def test_faults_stay_and_helps_mend_on_each_release(run_forked_everywhere: RunForked) -> None:
    assert unlike(run_forked_everywhere, LONG_S) == {}
