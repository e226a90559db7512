"""What is held, and what may go on; which lines are reported."""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.extract.live.steering import director as directing
from ros2cc_extract.extract.live.steering.director import Director
from ros2cc_extract.extract.live.steering.lines import Lines
from ros2cc_extract.extract.live.steering.plan import Plan
from ros2cc_extract.extract.live.steering.report import Report

PROGRAM = """\
def wait(act):
    for turn in range(2):
        act()
    return turn


def fail():
    raise RuntimeError('no loop')
"""


class Subscription:
    """As of rclpy."""

    topic_name = '/arm/part'

    def callback(self) -> None:
        """What it runs."""


@pytest.fixture
def told(tmp_path: Path) -> Callable[[], list[dict[str, Any]]]:
    def read() -> list[dict[str, Any]]:
        rows = (tmp_path / 'report').read_text(encoding='utf-8').splitlines()
        return [{k: v for k, v in json.loads(row).items() if k != 'at'} for row in rows]

    return read


def directed(tmp_path: Path, **plan: Any) -> tuple[Director, Report]:
    report = Report(str(tmp_path / 'report'))
    return Director(Plan({'report': '', **plan}), report), report


def point(**more: Any) -> dict[str, Any]:
    return {'file': 'node.py', 'first': 1, 'last': 1, **more}


def test_what_ends_a_wait_begins_when_the_wait_is_reached(tmp_path: Path) -> None:
    held = [{'kind': 'subscription', 'key': 'part'}, {'function': 'other'}]
    director, _ = directed(tmp_path, points=[point()], held=held)
    assert not director.may_begin(Subscription())
    director.arrive(0)
    assert director.may_begin(Subscription())


def test_nothing_else_is_held(tmp_path: Path) -> None:
    held = [{'kind': 'service', 'key': 'part'}, {'function': 'other'}]
    assert directed(tmp_path, points=[point()], held=held)[0].may_begin(Subscription())


def test_who_has_no_part_is_let_go_soon(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    director, _ = directed(
        tmp_path, points=[point()], held=[{'function': 'callback', 'soft': True}]
    )
    assert not director.may_begin(Subscription())
    monkeypatch.setattr(directing, '_SOFT_S', 0.0)
    assert director.may_begin(Subscription())
    assert not director.is_open


def test_nothing_of_the_program_begins_before_its_surroundings_are_there(tmp_path: Path) -> None:
    there = tmp_path / 'there'
    director, _ = directed(tmp_path, surroundings=str(there))
    assert not director.may_begin(Subscription())
    there.touch()
    assert director.may_begin(Subscription())


def test_threads_meet_at_their_points(
    tmp_path: Path, told: Callable[[], list[dict[str, Any]]]
) -> None:
    director, _ = directed(tmp_path, points=[point(holds=True), point(holds=True)])
    first = threading.Thread(target=director.arrive, args=(0,))
    first.start()
    first.join(0.1)
    assert first.is_alive() and not director.is_open
    director.arrive(1)
    first.join(10)
    assert not first.is_alive()
    assert told() == [{'what': 'open', 'given_up': False, 'missing': []}]


def test_nobody_is_held_for_ever(tmp_path: Path, told: Callable[[], list[dict[str, Any]]]) -> None:
    director, _ = directed(tmp_path, points=[point(holds=True), point(holds=True)], patience_s=0.1)
    begun = time.monotonic()
    director.arrive(1)
    assert time.monotonic() - begun < 5
    assert told() == [{'what': 'open', 'given_up': True, 'missing': [0]}]


def test_a_thread_that_passes_twice_stands_for_one(tmp_path: Path) -> None:
    director, _ = directed(tmp_path, points=[point(count=2)])
    for _ in range(2):
        director.arrive(0)
    assert not director.is_open
    other = threading.Thread(target=director.arrive, args=(0,))
    other.start()
    other.join()
    assert director.is_open


def test_what_was_held_is_taken_by_the_nested_spin_first(tmp_path: Path) -> None:
    file = tmp_path / 'program.py'
    names: dict[str, Any] = {}
    exec(compile(PROGRAM, str(file), 'exec'), names)
    at_act = point(file=str(file.resolve()), first=3, last=3)
    director, _ = directed(tmp_path, points=[at_act], held=[{'key': 'part'}], inside=True)
    director.arrive(0)
    held, seen = Subscription(), []
    assert not director.may_begin(held)
    names['wait'](lambda: seen.append(director.may_begin(held)))
    assert seen == [True, True]
    director.taken_inside()
    assert director.may_begin(held)


def lines_told(
    tmp_path: Path, told: Callable[[], list[dict[str, Any]]], run: str, **place: Any
) -> list[tuple[str, int]]:
    """Run something of the program in a thread that is traced."""
    file = tmp_path / 'program.py'
    file.write_text(PROGRAM, encoding='utf-8')
    names: dict[str, Any] = {}
    exec(compile(PROGRAM, str(file), 'exec'), names)
    director, report = directed(tmp_path, points=[point(**{**place, 'file': str(file)})])

    def traced() -> None:
        Lines(director, report).start()
        try:
            names[run](*([lambda: None] if run == 'wait' else []))
        except RuntimeError:
            return

    before = threading.gettrace()
    thread = threading.Thread(target=traced)
    thread.start()
    thread.join()
    threading.settrace(before)  # type: ignore[arg-type]
    return [(row['what'], row['point']) for row in told() if row['what'] != 'open']


def test_a_statement_is_reached_and_passed_on_each_lap(
    tmp_path: Path, told: Callable[[], list[dict[str, Any]]]
) -> None:
    laps = [('reached', 0), ('passed', 0)] * 2
    assert lines_told(tmp_path, told, 'wait', first=3, last=3) == laps


def test_a_loop_is_passed_when_it_is_left(
    tmp_path: Path, told: Callable[[], list[dict[str, Any]]]
) -> None:
    once = [('reached', 0), ('passed', 0)]
    assert lines_told(tmp_path, told, 'wait', first=2, last=3) == once


def test_an_exception_is_told(tmp_path: Path, told: Callable[[], list[dict[str, Any]]]) -> None:
    found = lines_told(tmp_path, told, 'fail', first=8, last=8)
    assert found == [('reached', 0), ('raised', 0), ('passed', 0)]
    assert [(row['type'], row['text']) for row in told() if row['what'] == 'raised'] == [
        ('RuntimeError', 'no loop')
    ]


def test_a_place_within_a_line_is_told_only_there(
    tmp_path: Path, told: Callable[[], list[dict[str, Any]]]
) -> None:
    assert lines_told(tmp_path, told, 'wait', first=3, last=3, column=9)[:1] == [('reached', 0)]
    (tmp_path / 'report').unlink()
    elsewhere = lines_told(tmp_path, told, 'wait', first=3, last=3, column=60)
    # Python 3.10 does not say where in a line an instruction stands: all of the line counts.
    assert elsewhere == (
        [] if sys.version_info >= (3, 11) else [('reached', 0), ('passed', 0)] * 2
    )
