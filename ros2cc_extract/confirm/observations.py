"""What the steering inside a node reports, read while the node runs."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ros2cc_extract.extract.live.hang_analysis.samples import Look, look_of
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, explain

Row = Mapping[str, Any]


@dataclass(frozen=True)
class Sample:
    """
    Two looks at the process, 0.2 s apart, and what they mean.

    :param at: when, in seconds of the process's clock.
    """

    at: float
    looks: tuple[Look, Look]
    explanation: Explanation


@dataclass
class Observations:
    """
    All that was reported so far.

    :param reached, passed: threads by number of the point.
    :param raced: what was read, what another thread wrote then, and what was written over it.
    :param alone: how often nobody else wrote in time.
    :param times: how long each passing of the first point took, in seconds.
    :param given_up: points that were not reached in time, once everything was let go.
    """

    process: int = 0
    reached: dict[int, int] = field(default_factory=dict)
    passed: dict[int, int] = field(default_factory=dict)
    passed_at: float = 0.0
    times: list[float] = field(default_factory=list)
    _since: dict[int, float] = field(default_factory=dict)
    is_open: bool = False
    given_up: tuple[int, ...] = ()
    raised: list[Row] = field(default_factory=list)
    failed: list[Row] = field(default_factory=list)
    raced: list[Row] = field(default_factory=list)
    alone: int = 0
    nested: list[Row] = field(default_factory=list)
    begins: list[tuple[float, int]] = field(default_factory=list)
    samples: list[Sample] = field(default_factory=list)
    _read: int = 0

    def update(self, report: Path) -> bool:
        """Read what is new; whether there was any."""
        with report.open('rb') as stream:
            stream.seek(self._read)
            data = stream.read()
        whole = data[: data.rfind(b'\n') + 1]
        self._read += len(whole)
        for line in whole.splitlines():
            try:
                self._note(json.loads(line))
            except (ValueError, KeyError, TypeError, AttributeError):
                continue  # somebody else has written there
        return bool(whole)

    def _note(self, row: Row) -> None:
        what, at = row['what'], float(row['at'])
        if what == 'started':
            self.process = int(row['process'])
        elif what == 'reached':
            self.reached[row['point']] = self.reached.get(row['point'], 0) + 1
            if row['point'] == 0:
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
        elif what == 'alone':
            self.alone += 1
        elif what == 'begin':
            self.begins.append((at, int(row['entity'])))
        elif what == 'looks':
            before, after = map(look_of, row['looks'])
            found = explain(self.process, (before, after))
            self.samples.append(Sample(at, (before, after), found))
