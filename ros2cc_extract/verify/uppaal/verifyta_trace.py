"""
Reads the runs that ``verifyta -t0`` prints, on its error stream.

The layout is that of samples and parsers in public repositories: states as ``State`` with or
without a colon, locations in parentheses, then ``name=value`` and, of clocks, inequalities;
transitions as ``Transitions:`` with one edge a line; ``Delay:`` before a state that only time
separates from the one before. UPPAAL's ``tracer`` prints the same without the parentheses.
Sources: uppaal-emf/uppaal (``DiagnosticTrace.xtext``), Djekkoo/UPPAAL-trace-parser
(``UPPAALTrace.g4`` and its samples), Jack0Chan/PyUPPAAL (``verifyta.py``),
UPPAALModelChecker/tracer (``tracer.cpp``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from ros2cc_extract.checker.runs.printed_runs import NamedState

_ITEM = re.compile(r'^(State|Transitions?|Delay)\b:?', re.MULTILINE)
_LOCATIONS = re.compile(r'\(\s+(.*?)\s+\)(?=\s|$)', re.DOTALL)
_BARE_LOCATIONS = re.compile(r'((?:\s+[^\s=<>]+\.[^\s=<>.]+(?=\s|$))+)')
_VALUE = re.compile(r'([^\s,=<>]+)\s*=\s*(-?\d+)(?=[\s,]|$)')

PrintedRun = tuple[NamedState, ...]


def read_runs(text: str) -> tuple[PrintedRun, ...]:
    """Read all runs of one output; a new one begins where nothing leads to a state."""
    runs: list[list[NamedState]] = []
    before = 'State'
    for kind, body in _items(text):
        if kind == 'State' and (state := _state(body)):
            if before == 'State' or not runs:
                runs.append([])
            if before != 'Delay':
                runs[-1].append(state)
        before = kind
    return tuple(tuple(run) for run in runs)


def _items(text: str) -> Iterator[tuple[str, str]]:
    found = list(_ITEM.finditer(text))
    ends = [*(match.start() for match in found), len(text)][1:]
    for match, end in zip(found, ends, strict=False):
        yield match.group(1), text[match.end() : end]


def _state(body: str) -> NamedState | None:
    match = _LOCATIONS.search(body) or _BARE_LOCATIONS.match(body)
    if match is None:
        return None
    pairs = [word.rpartition('.') for word in match.group(1).split()]
    values = _VALUE.findall(body[match.end() :])
    return NamedState(
        {process: location for process, _, location in pairs},
        {name: int(value) for name, value in values},
    )
