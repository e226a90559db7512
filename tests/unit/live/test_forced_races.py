"""Two sides of a race meet where the source has named them, and each is given its turn."""

from __future__ import annotations

import json
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.extract.live.steering import races
from ros2cc_extract.extract.live.steering.director import Director
from ros2cc_extract.extract.live.steering.lines import Lines
from ros2cc_extract.extract.live.steering.plan import Plan
from ros2cc_extract.extract.live.steering.report import Report

# What is written over exists only where no beat has come since the last check.
PROGRAM = """\
class Monitor:
    def __init__(self):
        self.beats = 1

    def on_beat(self):
        self.beats += 1

    def check(self):
        if self.beats == 0:
            str(self.beats)
        self.beats = 0

    def check_under(self, lock):
        with lock:
            self.check()

    def on_beat_under(self, lock):
        with lock:
            self.on_beat()
"""
BEAT, CHECK = 6, 11


@pytest.fixture
def rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Run two functions again and again, each in a thread; return what is told of the race."""
    monkeypatch.setattr(races, 'TURNS_S', (0.0, 0.6, 0.6))
    monkeypatch.setattr(races, 'HELD_S', 0.2)

    def run(beat: str, check: str, *arguments: Any) -> list[dict[str, Any]]:
        file = tmp_path / 'program.py'
        file.write_text(PROGRAM, encoding='utf-8')
        names: dict[str, Any] = {}
        exec(compile(PROGRAM, str(file), 'exec'), names)
        lines = {'own': BEAT, 'others': CHECK}
        own, other = (
            {'file': str(file.resolve()), 'first': line, 'last': line} for line in lines.values()
        )
        race = {'attribute': 'beats', 'own': own, 'others': [other]}
        plan = Plan({'report': '', 'points': [own], 'race': race})
        report = Report(str(tmp_path / 'report'))
        monitor, end = names['Monitor'](), time.monotonic() + 1.3

        def repeat(act: Any, every_s: float) -> None:
            sys.settrace(threading.gettrace())
            while time.monotonic() < end:
                act(*arguments)
                time.sleep(every_s)

        before = threading.gettrace(), sys.gettrace()
        Lines(Director(plan, report), report).start()
        sys.settrace(before[1])
        sides = [
            threading.Thread(target=repeat, args=(getattr(monitor, beat), 0.005)),
            threading.Thread(target=repeat, args=(getattr(monitor, check), 0.1)),
        ]
        for each in sides:
            each.start()
        for each in sides:
            each.join()
        threading.settrace(before[0])  # type: ignore[arg-type]
        told = (tmp_path / 'report').read_text(encoding='utf-8').splitlines()
        return [row for row in map(json.loads, told) if row['what'] == 'raced']

    return run


def test_what_comes_often_is_kept_out_until_the_other_side_is_held(rows: Any) -> None:
    shown = [row for row in rows('on_beat', 'check') if row['line'] == CHECK and row['let_in']]
    assert shown, 'a check met a beat each time'
    assert [(row['read'], row['other'], row['own']) for row in shown[:1]] == [('0', '1', '0')]


def test_a_side_that_is_kept_out_does_not_come_past_a_lock(rows: Any) -> None:
    assert not rows('on_beat_under', 'check_under', threading.Lock())
