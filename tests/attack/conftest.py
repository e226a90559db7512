"""
Counts attacks: one table at the end says how many of each class there were, and what gave way.

Each module names its class (``CLASS``). A test is one attack unless it says how many it tries
(``tally``); what it finds is counted under its kind.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest

KINDS = ('crash', 'hang', 'leftover', 'canary', 'internal error', 'too dear')
FAILED = 'failed test'
PROPERTY = 'attacks'
BOUND = '--at-least'


@dataclass
class Tally:
    """
    What one test has tried.

    :param kind: the class of its attacks.
    :param found: how often something gave way, by kind.
    """

    kind: str
    tried: int = 0
    found: Counter[str] = field(default_factory=Counter)

    def add(self, tried: int = 1) -> None:
        self.tried += tried


class Totals:
    """All classes, in the process that reports."""

    def __init__(self, at_least: int) -> None:
        self._at_least = at_least
        self._tried: Counter[str] = Counter()
        self._found: defaultdict[str, Counter[str]] = defaultdict(Counter)
        self._failed: set[str] = set()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self._failed.add(report.nodeid)
        if report.when != 'teardown':
            return
        for name, value in report.user_properties:
            if name == PROPERTY:
                kind, tried, found = value  # type: ignore[misc]
                self._tried[kind] += tried
                self._found[kind].update(dict(found))
                if report.nodeid in self._failed and not found:
                    self._found[kind][FAILED] += 1

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if self._tried and self._tried.total() < self._at_least:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        if not self._tried:
            return
        columns = (*KINDS, FAILED)
        rows = [('class', 'tried', *columns)]
        for kind in sorted(self._tried):
            rows.append((kind, self._tried[kind], *(self._found[kind][c] for c in columns)))
        sums = (sum(found[c] for found in self._found.values()) for c in columns)
        rows.append(('total', self._tried.total(), *sums))
        widths = [max(len(str(row[i])) for row in rows) for i in range(len(rows[0]))]
        terminalreporter.section('attacks')
        for first, *rest in rows:
            cells = (f'{cell:>{width}}' for cell, width in zip(rest, widths[1:], strict=True))
            terminalreporter.line(f'{first:<{widths[0]}}  {"  ".join(cells)}')
        if self._tried.total() < self._at_least:
            terminalreporter.line(f'fewer than {self._at_least}')


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(BOUND, type=int, default=0, help='fail where fewer attacks were tried')


def pytest_configure(config: pytest.Config) -> None:
    if not hasattr(config, 'workerinput'):  # a process of xdist only runs tests
        config.pluginmanager.register(Totals(config.getoption(BOUND, 0)), 'attacks')


@pytest.fixture(autouse=True)
def tally(request: pytest.FixtureRequest) -> Iterator[Tally]:
    counted = Tally(request.module.CLASS)
    yield counted
    value = (counted.kind, counted.tried or 1, tuple(counted.found.items()))
    request.node.user_properties.append((PROPERTY, value))
