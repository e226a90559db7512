"""The table of shapes: what was observed of each, and what the tool must say."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import yaml

HERE = Path(__file__).parent
TABLE = HERE / 'table.yaml'
# Where something stands forever, and where it is broken off.
WAITS, BREAKS = 'waits here', 'breaks here'
DISTRIBUTIONS = ('jazzy', 'kilted')
# Between what is observed on one run and on another.
OTHERWISE = ' or '


@dataclass(frozen=True, eq=False)
class Row:
    """
    One shape of waiting or ending.

    :param finds: ``finding``, a code, several with commas, or ``undecided``: what the tool must
        say at a marked line of the bad node.
    :param not_yet: what the tool says instead today; ``None`` once it says what it must.
    """

    shape: str
    what: str
    kind: str
    where: str
    source: str
    bad: Mapping[str, str]
    good: Mapping[str, str]
    finds: str
    not_yet: Mapping[str, str]
    note: str

    @property
    def number(self) -> int:
        return int(self.shape[1:].partition('_')[0])


@dataclass(frozen=True)
class Node:
    """The bad or the good node of a row."""

    row: Row
    word: str

    @property
    def path(self) -> Path:
        return HERE / f'{self.row.shape}_{self.word}.py'

    @property
    def name(self) -> str:
        return f'{self.row.shape}_{self.word}'

    @property
    def observed(self) -> Mapping[str, str]:
        return self.row.bad if self.word == 'bad' else self.row.good


@cache
def rows() -> tuple[Row, ...]:
    entries = yaml.safe_load(TABLE.read_text(encoding='utf-8'))
    return tuple(_row(entry) for entry in entries)


def _row(entry: Mapping[str, object]) -> Row:
    words = {key: value for key, value in entry.items() if key != 'tool'}
    not_yet = entry.get('tool', {})
    return Row(**{'note': '', **words}, not_yet=not_yet)  # type: ignore[arg-type]


def nodes() -> tuple[Node, ...]:
    return tuple(Node(row, word) for row in rows() for word in ('bad', 'good'))


@cache
def marked_lines(path: Path, *marks: str) -> tuple[range, ...]:
    """Lines of the statements that are marked; of a loop, its body too."""
    text = path.read_text(encoding='utf-8')
    lines = enumerate(text.splitlines(), 1)
    marked = {at for at, line in lines if line.endswith(tuple(f'# {mark}' for mark in marks))}
    spans = []
    for statement in ast.walk(ast.parse(text)):
        if isinstance(statement, ast.stmt):
            first, last = statement.lineno, statement.end_lineno or statement.lineno
            own = last if _is_whole(statement) else first
            spans.append((last - first, first, own, last))
    found = []
    for mark in sorted(marked):
        # The smallest statement that holds the mark is the one that is meant.
        _, first, own, last = min(span for span in spans if span[1] <= mark <= span[3])
        found.append(range(first, max(own, mark) + 1))
    return tuple(found)


def _is_whole(statement: ast.stmt) -> bool:
    compound = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.With, ast.Try, ast.If)
    return not isinstance(statement, compound)
