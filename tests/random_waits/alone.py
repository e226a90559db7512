"""
What of a drawn program ever runs, as nobody but the program itself is there.

A model takes it that requests and messages come from outside. No other process asks the services
of a drawn program, or sends on its topic: a wait that only these would end does hang, and the
model is asked without them. If a waiting callback keeps those out that ask or send,
what they set off ends the wait only perhaps: it may be on its way when the wait begins.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from ros2cc_extract.spec.effects import Blocking, Waker
from ros2cc_extract.spec.model import Activity, Callback, GroupType, Spec

_ASKS = re.compile(r'self\.client_(\d+)\.call')
_SET_OFF = re.compile(r'(serve|work)_\d+|on_message')
_STARTS = re.compile(r'self\.(work_\d+)')

Doer = Callback | Activity


@dataclass(frozen=True)
class _Text:
    """The lines of a program, and of each of its functions the first and the last."""

    lines: list[str]
    functions: dict[str, tuple[int, int]]

    @staticmethod
    def of(text: str) -> _Text:
        """Read a program."""
        found = {
            node.name: (node.lineno, node.end_lineno or node.lineno)
            for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        }
        return _Text(text.splitlines(), found)

    def body(self, name: str, until: int | None = None) -> str:
        """The lines of a function, or those before ``until``."""
        first, last = self.functions[name]
        return '\n'.join(self.lines[first : last if until is None else until - 1])


def alone(unit: Spec, text: str) -> Spec:
    """The unit without callbacks that nothing in the program sets off, and whatever they do."""
    program = _Text.of(text)
    runs = _running(program)
    gone = {
        doer.name
        for doer in (*unit.callbacks, *unit.activities)
        if _function(doer) in program.functions.keys() - runs
        and _function(doer) not in ('main', '__init__')
    }
    return replace(
        unit,
        callbacks=tuple(
            replace(each, blocking=_waits(each, gone, unit, program))
            for each in unit.callbacks
            if each.name not in gone
        ),
        activities=tuple(
            replace(
                each,
                blocking=_waits(each, gone, unit, program),
                starts=tuple(waker for waker in each.starts if waker.by not in gone),
            )
            for each in unit.activities
            if each.name not in gone
        ),
    )


def _function(doer: Doer) -> str:
    return (doer.function or '').rpartition('.')[2]


def _running(program: _Text, out: Collection[str] = (), begun: str = '') -> set[str]:
    """
    What runs by itself, and what this sets off, one by the other.

    :param out: functions that do not run.
    :param begun: text that has run besides.
    """
    names = program.functions.keys() - set(out)
    new = {name for name in names if not _SET_OFF.fullmatch(name)}
    new |= set(_sets_off(begun)) & names
    runs: set[str] = set()
    while new:
        runs |= new
        new = {other for name in new for other in _sets_off(program.body(name))} & names - runs
    return runs


def _sets_off(body: str) -> Iterable[str]:
    yield from _STARTS.findall(body)
    yield from (f'serve_{number}' for number in _ASKS.findall(body))
    if 'self.publisher.publish' in body:
        yield 'on_message'


def _waits(doer: Doer, gone: Collection[str], unit: Spec, program: _Text) -> tuple[Blocking, ...]:
    return tuple(_alone_wait(block, doer, gone, unit, program) for block in doer.blocking)


def _alone_wait(
    block: Blocking, doer: Doer, gone: Collection[str], unit: Spec, program: _Text
) -> Blocking:
    left = [waker for waker in block.wakers if waker.by not in gone]
    runs = _running_meanwhile(block, doer, unit, program)
    functions = {each.name: _function(each) for each in (*unit.callbacks, *unit.activities)}
    return replace(
        block,
        wakers=tuple(
            replace(waker, conditional=waker.conditional or _is_off(waker, functions, runs))
            for waker in left
        ),
    )


def _is_off(waker: Waker, functions: dict[str, str], runs: set[str]) -> bool:
    """Whether a message or request must come first that nobody sends now."""
    name = functions.get(waker.by, '')
    return name not in runs and (name == 'on_message' or name.startswith('serve_'))


def _running_meanwhile(block: Blocking, doer: Doer, unit: Spec, program: _Text) -> set[str]:
    """What runs while ``doer`` waits, or is set off by what it has done before in that run."""
    name, at = _function(doer), block.source
    if not isinstance(doer, Callback) or name not in program.functions or at is None:
        return _running(program)
    out = {_function(other) for other in unit.callbacks if _is_kept_out(other, doer, block, unit)}
    return _running(program, out, program.body(name, at.line))


def _is_kept_out(other: Callback, doer: Callback, block: Blocking, unit: Spec) -> bool:
    lets_others_run = block.call == 'await' or 'spin' in block.call
    if len(unit.executor.threads) == 1 and not lets_others_run:
        return True
    is_exclusive = unit.group_of(doer).type is GroupType.EXCLUSIVE
    return is_exclusive and other.group == doer.group
