"""
What of a drawn program ever runs, as nobody but the program itself is there.

A model takes it that requests and messages come from outside. No other process asks the services
of a drawn program, or sends on its topic: a wait that only these would end does hang, and the
model is asked of the program without them.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from dataclasses import replace

from ros2cc_extract.spec.deeds import Blocking, Waker
from ros2cc_extract.spec.model import Activity, Callback, Spec

_ASKS = re.compile(r'self\.client_(\d+)\.call')
_SET_OFF = re.compile(r'(serve|work)_\d+|on_message')
_STARTS = re.compile(r'self\.(work_\d+)')


def alone(unit: Spec, text: str) -> Spec:
    """The unit without callbacks that nothing in the program sets off, and whatever they do."""
    bodies = {
        node.name: ast.unparse(node)
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    runs = _running(bodies)
    gone = {
        doer.name
        for doer in (*unit.callbacks, *unit.activities)
        if _function(doer) in bodies.keys() - runs and _function(doer) not in ('main', '__init__')
    }
    return replace(
        unit,
        callbacks=tuple(
            replace(each, blocking=_waits(each, gone))
            for each in unit.callbacks
            if each.name not in gone
        ),
        activities=tuple(
            replace(each, blocking=_waits(each, gone), starts=_starts(each, gone))
            for each in unit.activities
            if each.name not in gone
        ),
    )


def _function(doer: Callback | Activity) -> str:
    return (doer.function or '').rpartition('.')[2]


def _running(bodies: dict[str, str]) -> set[str]:
    """What runs by itself, and what this sets off, one by the other."""
    runs: set[str] = set()
    new = {name for name in bodies if not _SET_OFF.fullmatch(name)}
    while new:
        runs |= new
        new = {name for body in new for name in _sets_off(bodies[body])} & bodies.keys() - runs
    return runs


def _sets_off(body: str) -> Iterable[str]:
    yield from _STARTS.findall(body)
    yield from (f'serve_{number}' for number in _ASKS.findall(body))
    if 'self.publisher.publish' in body:
        yield 'on_message'


def _waits(doer: Callback | Activity, gone: set[str]) -> tuple[Blocking, ...]:
    return tuple(
        replace(block, wakers=tuple(waker for waker in block.wakers if waker.by not in gone))
        for block in doer.blocking
    )


def _starts(activity: Activity, gone: set[str]) -> tuple[Waker, ...]:
    return tuple(waker for waker in activity.starts if waker.by not in gone)
