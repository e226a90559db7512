"""
Force two accesses of one attribute: a reader is held before the write, or before the next
read, until another thread has written.

Only the functions that hold these writes are traced, instruction by instruction. Source: Python,
`sys.settrace` (event `opcode`), `dis`.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import dis
import os
import threading
import time
from collections.abc import Callable
from types import CodeType, FrameType
from typing import Any

from .instructions import SWITCHES, has_global_lock, trace_instructions
from .report import Report
from .values import NOTHING, copied, shown, target, value

Trace = Callable[[FrameType, str, Any], Any]
# Long enough for a timer of a second.
HELD_S = 1.5
# How long both may come, then the other side is kept out, then the own one, and so on; in the end
# both may come.
TURNS_S = (3.0, 3.0, 3.0, 3.0, 6.0, 6.0)
_MOST_TRIES = 16
_MOST_FORCED = 3
_READ, _USE, _WRITE, _SWITCH = 'read', 'use', 'write', 'switch'


class Write:
    """Lines of a statement that writes the attribute."""

    def __init__(self, row: dict[str, Any]) -> None:
        self.file = str(row['file'])
        self.first = int(row['first'])
        self.last = int(row['last'])

    def contains(self, line: int | None) -> bool:
        return line is not None and self.first <= line <= self.last


class Race:
    """
    One attribute, the held thread, and the one that writes meanwhile.

    :param row: `attribute`, `own`: the write that is held; `others`: writes of other threads,
        which may be the same statement; `is_use`: what is held is a read of what was tested, until
        another thread has set it to None.
    """

    def __init__(self, row: dict[str, Any], report: Report) -> None:
        self.attribute = str(row['attribute'])
        self.own = Write(row['own'])
        self.is_use = bool(row.get('is_use', False))
        self.others = [Write(each) for each in row['others']]
        self._report = report
        self._known: dict[CodeType, dict[int, str]] = {}
        self._changed = threading.Condition(threading.Lock())
        self._held: int | None = None
        self._object: Any = None
        self._other: Any = NOTHING
        self._tries = 0
        self._forced_times = 0
        self._turns = _Turns()
        self.calls = _Calls()

    def of(self, frame: FrameType) -> Trace | None:
        """Give what traces a call, if it may read or write the attribute."""
        self.calls.count += 1
        code = frame.f_code
        marks = self._known.get(code)
        if marks is None:
            marks = self._known[code] = self._marks(code)
        if _WRITE not in marks.values() and _USE not in marks.values():
            return None
        self._keep_out(code)
        trace_instructions(frame)
        return _Call(self, marks).trace

    def _marks(self, code: CodeType) -> dict[int, str]:
        """What each instruction does with the attribute, by its offset."""
        writes = [self.own, *self.others]
        file = os.path.realpath(code.co_filename)
        if file not in {each.file for each in writes}:
            return {}
        lines = {
            offset: line for first, end, line in code.co_lines() for offset in range(first, end)
        }
        marks = {}
        for each in dis.get_instructions(code):
            line = lines.get(each.offset)
            is_there = any(w.file == file and w.contains(line) for w in writes)
            named = each.argval == self.attribute
            if each.opname in ('LOAD_ATTR', 'LOAD_METHOD') and named:
                is_use = self.is_use and self.own.file == file and self.own.contains(line)
                marks[each.offset] = _USE if is_use else _READ
            elif is_there and (
                (each.opname == 'STORE_ATTR' and named) or each.opname == 'STORE_SUBSCR'
            ):
                marks[each.offset] = _WRITE
            elif each.opname.startswith(SWITCHES):
                marks[each.offset] = _SWITCH
        return marks

    def _keep_out(self, code: CodeType) -> None:
        """
        Let one side begin only once the other is held, each side in its turn.

        Else what comes often would leave nothing to the other that it could write over.
        """
        lines = {line for _, _, line in code.co_lines()}
        is_own = any(map(self.own.contains, lines))
        if is_own is any(each.contains(line) for each in self.others for line in lines):
            return
        with self._changed:
            while self._held is None and self._tries < _MOST_TRIES:
                left_s = self._turns.left_s(out=is_own)
                if left_s <= 0:
                    return
                self._changed.wait(left_s)

    def is_own(self, frame: FrameType, line: int) -> bool:
        return _is_in(frame, line, self.own)

    def is_other(self, frame: FrameType, line: int) -> bool:
        return any(_is_in(frame, line, each) for each in self.others)

    def hold(self, owner: Any) -> tuple[Any, ...] | None:
        """
        Hold this thread until another one has written.

        :return: what that one wrote, in a tuple; an empty one if none did in time; `None` if
            this thread was not held.
        """
        with self._changed:
            if self._held is not None or self._tries >= _MOST_TRIES:
                return None
            self._tries += 1
            self._held, self._object, self._other = threading.get_ident(), owner, NOTHING
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._other is not NOTHING, HELD_S)
            self._held, self._object = None, None
            return () if self._other is NOTHING else (self._other,)

    def may_force(self) -> bool:
        """Hold where Python would not switch threads: only to say what then happens."""
        self._forced_times += 1
        return self._forced_times <= _MOST_FORCED

    def wrote(self, owner: Any) -> None:
        """Let the held thread go on: another one has written."""
        with self._changed:
            is_other = self._held not in (None, threading.get_ident())
            if is_other and owner is self._object and self._other is NOTHING:
                written = value(self._object, self.attribute)
                if not self.is_use or written is None:
                    self._other = written
                    self._changed.notify_all()

    def write_row(
        self, read: Any, other: Any, own: Any, *, line: int = 0, let_in: bool = True
    ) -> None:
        """:param let_in: since the read, Python by itself may have let another thread in."""
        if other is NOTHING:
            self._report.write('alone')
        else:
            texts = {'read': shown(read), 'other': shown(other), 'own': shown(own)}
            differs = read is not NOTHING and texts['read'] != texts['other']
            self._report.write(
                'raced',
                line=line,
                thread=threading.get_ident(),
                **texts,
                stale=differs,
                lost=texts['own'] != texts['other'],
                let_in=let_in or not has_global_lock(),
            )


class _Turns:
    """Which side is kept out, from the first time on that one comes."""

    def __init__(self) -> None:
        self._begun_at: float | None = None

    def left_s(self, *, out: bool) -> float:
        """
        How much longer a side is kept out; 0 if it is not.

        :param out: whether it is the side that has the own write.
        """
        now = time.monotonic()
        end = self._begun_at = now if self._begun_at is None else self._begun_at
        for number, seconds in enumerate(TURNS_S):
            end += seconds
            if now < end:
                return end - now if number % 3 == (2 if out else 1) else 0.0
        return 0.0


class _Calls(threading.local):
    """How many Python functions a thread has called, such as those behind attributes."""

    count = 0


class _Call:
    """One call of such a function."""

    def __init__(self, race: Race, marks: dict[int, str]) -> None:
        self._race = race
        self._marks = marks
        self._before = -1
        self._line = 0
        self._read: Any = NOTHING
        self._forced: Any = None
        self._switched = True
        self._calls = 0

    @property
    def _let_in(self) -> bool:
        """Since the read, Python by itself may have let another thread in."""
        return self._switched or self._race.calls.count != self._calls

    def trace(self, frame: FrameType, event: str, _argument: Any) -> Any:
        if event in ('opcode', 'return'):
            self._after(frame)
        if event == 'opcode':
            self._before, self._line = frame.f_lasti, frame.f_lineno
            mark = self._marks.get(frame.f_lasti)
            if mark == _USE and self._was_there and self._let_in:
                self._hold(frame)
                self._report_use(frame)
            elif mark == _WRITE and not self._race.is_use and self._is_worth_holding(frame):
                self._hold(frame)
        return self.trace

    def _after(self, frame: FrameType) -> None:
        """What the instruction before has done."""
        did, self._before = self._marks.get(self._before), -1
        if did in (_READ, _USE):
            self._read = copied(value(target(frame), self._race.attribute))
            self._switched, self._calls = False, self._race.calls.count
        elif did == _SWITCH:
            self._switched = True
        elif did == _WRITE:
            if self._forced is not None:
                other, self._forced = self._forced[0], None
                own = value(target(frame), self._race.attribute)
                self._race.write_row(self._read, other, own, line=self._line, let_in=self._let_in)
            elif self._race.is_own(frame, self._line) or self._race.is_other(frame, self._line):
                self._race.wrote(target(frame))

    @property
    def _was_there(self) -> bool:
        return self._read is not NOTHING and self._read is not None

    def _report_use(self, frame: FrameType) -> None:
        """Before it is used: that it is gone shows in the exception."""
        if self._forced is not None:
            other, self._forced = self._forced[0], None
            self._race.write_row(self._read, other, NOTHING, line=frame.f_lineno)

    def _is_worth_holding(self, frame: FrameType) -> bool:
        """The other side too, where it has read before and another thread may have come in."""
        if self._race.is_own(frame, frame.f_lineno):
            return self._let_in or not has_global_lock() or self._race.may_force()
        has_read = self._read is not NOTHING and self._let_in
        return has_read and self._race.is_other(frame, frame.f_lineno)

    def _hold(self, frame: FrameType) -> None:
        forced = self._race.hold(target(frame))
        self._forced = forced or None
        if forced == ():
            self._race.write_row(self._read, NOTHING, NOTHING)


def _is_in(frame: FrameType, line: int, write: Write) -> bool:
    return write.contains(line) and write.file == os.path.realpath(frame.f_code.co_filename)
