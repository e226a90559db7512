"""
Which instructions of a function are points of control: what the scanner has named, found again
in the code. Source: Python, `dis`; the place of an instruction: PEP 657.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import dis
import os
from collections.abc import Sequence
from types import CodeType
from typing import Any

from ..steering.instructions import SWITCHES

READ, WRITE, WAIT = 'read', 'write', 'wait'
_READS = ('LOAD_ATTR', 'LOAD_METHOD', 'LOAD_GLOBAL', 'LOAD_NAME')
_WRITES = ('STORE_ATTR', 'STORE_GLOBAL', 'STORE_NAME')
_TEST = ('POP_JUMP', 'JUMP_IF')


class Point:
    """
    A place that the scanner has named.

    :param kind: `access` or `wait`.
    :param name: `Class.attribute`, `module.name`, or the name of what is waited for.
    :param rests: what is written there rests on what was read of it before.
    :param computed: by its value, not only by a test.
    """

    def __init__(self, row: dict[str, Any]) -> None:
        self.file = str(row['file'])
        self.line = int(row['line'])
        self.column = int(row.get('column', 0))
        self.kind = str(row['kind'])
        self.name = str(row.get('name', ''))
        self.rests = bool(row.get('rests', False))
        self.computed = bool(row.get('computed', False))


class Mark:
    """
    An instruction at which a thread may be held.

    :param attribute: that is read or written; empty for a wait.
    :param at: as it stands in a schedule.
    """

    def __init__(self, kind: str, point: Point, line: int) -> None:
        self.kind = kind
        self.line = line
        self.file = point.file
        self.name = point.name
        self.rests = point.rests
        self.computed = point.computed
        self.attribute = '' if kind == WAIT else point.name.rpartition('.')[2]
        self.at = f'{os.path.basename(point.file)}:{line} {kind} {point.name}'.rstrip()  # noqa: PTH119

    @property
    def after_test(self) -> str:
        """Where a thread stands that has tested what it read, and is about to act on it."""
        return f'{self.at.partition(" ")[0]} tested {self.name}'


class OfCode:
    """
    What is marked of one function.

    :param marks: by the offsets of their instructions.
    :param switches: offsets of instructions at which another thread may come in.
    :param tests: offsets of instructions that branch.
    """

    def __init__(
        self, marks: dict[int, Mark], switches: frozenset[int], tests: frozenset[int]
    ) -> None:
        self.marks = marks
        self.switches = switches
        self.tests = tests


_NOTHING = OfCode({}, frozenset(), frozenset())


class Marks:
    """The marks of each function, looked up once."""

    def __init__(self, points: Sequence[Point]) -> None:
        self._of_file: dict[str, list[Point]] = {}
        for point in points:
            self._of_file.setdefault(point.file, []).append(point)
        self._known: dict[CodeType, OfCode] = {}
        self._files: dict[str, str] = {}

    def of(self, code: CodeType) -> OfCode:
        found = self._known.get(code)
        if found is None:
            found = self._known[code] = self._find(code)
        return found

    def _find(self, code: CodeType) -> OfCode:
        file = self._files.get(code.co_filename)
        if file is None:
            file = self._files[code.co_filename] = os.path.realpath(code.co_filename)
        points = self._of_file.get(file)
        if not points or code.co_name == '<module>':
            return _NOTHING
        lines = _lines(code)
        instructions = list(dis.get_instructions(code))
        marks: dict[int, Mark] = {}
        for point in points:
            if point.line in lines.values():
                if point.kind == WAIT:
                    _mark_wait(marks, point, instructions, code, lines)
                else:
                    _mark_accesses(marks, point, instructions, lines)
        switches = frozenset(o.offset for o in instructions if o.opname.startswith(SWITCHES))
        tests = frozenset(o.offset for o in instructions if o.opname.startswith(_TEST))
        return OfCode(marks, switches, tests)


def _mark_accesses(
    marks: dict[int, Mark],
    point: Point,
    instructions: Sequence[dis.Instruction],
    lines: dict[int, int],
) -> None:
    attribute = point.name.rpartition('.')[2]
    for each in instructions:
        if lines.get(each.offset) != point.line:
            continue
        is_write = each.opname in _WRITES and each.argval == attribute
        is_write = is_write or each.opname in ('STORE_SUBSCR', 'DELETE_SUBSCR')
        if is_write and (each.offset not in marks or point.rests):
            marks[each.offset] = Mark(WRITE, point, point.line)
        elif each.opname in _READS and each.argval == attribute:
            marks.setdefault(each.offset, Mark(READ, point, point.line))


def _mark_wait(
    marks: dict[int, Mark],
    point: Point,
    instructions: Sequence[dis.Instruction],
    code: CodeType,
    lines: dict[int, int],
) -> None:
    """The first instruction of the call, or of the line if Python gives no columns."""
    of_line = [each.offset for each in instructions if lines.get(each.offset) == point.line]
    positions = getattr(code, 'co_positions', None)
    if positions is not None and point.column:
        columns = [column for _, _, column, _ in positions()]
        at = [o for o in of_line if columns[o // 2] == point.column - 1]
        of_line = at or of_line
    marks.setdefault(of_line[0], Mark(WAIT, point, point.line))


def _lines(code: CodeType) -> dict[int, int]:
    """The line of each instruction, by its offset."""
    return {
        offset: line
        for first, end, line in code.co_lines()
        if line is not None
        for offset in range(first, end, 2)
    }
