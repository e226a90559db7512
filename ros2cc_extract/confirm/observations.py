"""What the steering inside a node reports, read while the node runs."""

from __future__ import annotations

import contextlib
import json
from collections import deque
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

from ros2cc_extract.extract.live.hang_analysis.samples import Look, look_of
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, explain
from ros2cc_extract.light_dataclasses import dataclass

Row = Mapping[str, Any]
MOST_STEPS = 2000


@dataclass(frozen=True)
class Sample:
    """
    Two looks at the process, 0.2 s apart, and what they mean.

    :param at: when, in seconds of the process's clock.
    """

    at: float
    looks: tuple[Look, Look]
    explanation: Explanation


def sample_of(process: int, row: Row) -> Sample:
    """
    Read two looks and judge them.

    :raises ValueError, KeyError, TypeError, AttributeError: if they are invalid.
    """
    before, after = map(look_of, row['looks'])
    found = explain(process, (before, after))
    return Sample(float(row['at']), (before, after), found)


class Rows:
    """Reads a report that is being written, row by row."""

    def __init__(self) -> None:
        self._read = 0

    def read(self, report: Path) -> list[Row]:
        """Read the rows that are new and whole; what is no row is left out."""
        with report.open('rb') as stream:
            stream.seek(self._read)
            data = stream.read()
        whole = data[: data.rfind(b'\n') + 1]
        self._read += len(whole)
        rows: list[Row] = []
        for line in whole.splitlines():
            with contextlib.suppress(ValueError):
                row = json.loads(line)
                if isinstance(row, dict):
                    rows.append(row)
        return rows


@dataclass
class Observations:
    """
    All that was reported so far.

    :param reached, passed: threads by number of the point.
    :param reached_at: when the first point was reached first.
    :param raced: what was read, what another thread wrote then, and what was written over it.
    :param handed: functions of the program that stand-ins for missing modules were given.
    :param asleep: at each look, loops of asyncio that slept although something was ready.
    :param alone: how often no other thread wrote in time.
    :param times: how long each passing of the first point took, in seconds.
    :param given_up: points that were not reached in time, once everything was let go.
    :param steps: the last rows, as they came, but for the looks.
    """

    process: int = 0
    reached: dict[int, int] = field(default_factory=dict)
    passed: dict[int, int] = field(default_factory=dict)
    reached_at: float | None = None
    passed_at: float = 0.0
    times: list[float] = field(default_factory=list)
    _since: dict[int, float] = field(default_factory=dict)
    is_open: bool = False
    given_up: tuple[int, ...] = ()
    raised: list[Row] = field(default_factory=list)
    failed: list[Row] = field(default_factory=list)
    raced: list[Row] = field(default_factory=list)
    alone: int = 0
    handed: tuple[str, ...] = ()
    asleep: list[Row] = field(default_factory=list)
    nested: list[Row] = field(default_factory=list)
    begins: list[tuple[float, int]] = field(default_factory=list)
    samples: list[Sample] = field(default_factory=list)
    steps: deque[Row] = field(default_factory=lambda: deque(maxlen=MOST_STEPS))
    _rows: Rows = field(default_factory=Rows)

    def update(self, report: Path) -> bool:
        """Read what is new; whether there was any."""
        rows = self._rows.read(report)
        for row in rows:
            # Another process may have written there.
            with contextlib.suppress(ValueError, KeyError, TypeError, AttributeError):
                self._note(row)
                if row['what'] != 'looks':
                    self.steps.append(row)
        return bool(rows)

    def _note(self, row: Row) -> None:
        what, at = row['what'], float(row['at'])
        if what == 'started':
            self.process = int(row['process'])
        elif what == 'reached':
            self.reached[row['point']] = self.reached.get(row['point'], 0) + 1
            if row['point'] == 0:
                self.reached_at = at if self.reached_at is None else self.reached_at
                self._since[row['thread']] = at
        elif what == 'passed':
            self.passed[row['point']] = self.passed.get(row['point'], 0) + 1
            self.passed_at = at
            if row['point'] == 0 and row['thread'] in self._since:
                self.times.append(at - self._since.pop(row['thread']))
        elif what == 'open':
            self.is_open = True
            self.given_up = tuple(row['missing'])
        elif what in ('raised', 'failed', 'nested'):
            {'raised': self.raised, 'failed': self.failed, 'nested': self.nested}[what].append(row)
        elif what == 'raced':
            self.raced.append(row)
        elif what == 'asleep':
            self.asleep.append(row)
        elif what == 'handed':
            self.handed = tuple(map(str, row['functions']))
        elif what == 'alone':
            self.alone += 1
        elif what == 'begin':
            self.begins.append((at, int(row['entity'])))
        elif what == 'looks':
            self.samples.append(sample_of(self.process, row))
