"""Calls that wait by their name, on an object that could not be followed."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.waits.completed_futures import is_done_before
from ros2cc_extract.extract.static.program.relevance import holds_thread
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable
from ros2cc_extract.extract.static.python.values.looked_up import LookedUp
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Const,
    Function,
    Mystery,
    Partial,
    Value,
)
from ros2cc_extract.source_locations import Unknown

_ALWAYS = frozenset(
    ['wait', 'wait_for', 'communicate', 'recv', 'recvfrom', 'recv_multipart', 'accept', 'acquire']
)
_WITHOUT_VALUES = frozenset(['join', 'get'])
_OF_FUTURES = frozenset(['result', 'exception'])
_WAIT = 'wait_'
_TIMEOUT_FIRST = frozenset(['wait', 'join', 'result', 'exception'])
_LIMITS = ('timeout', 'timeout_sec', 'timeout_s', 'time_to_wait')
"""What a time-out is called, as in rclpy."""
_KEYWORDS = frozenset([*_LIMITS, 'block', 'blocking'])
# What has a ``get`` or ``wait`` that does not wait, or waits for a person that looks at it.
_OTHERS = ('tkinter', 'Tk', 'argparse', 'mock', 'Mock', 'contextvars', 'launch')
_AT_ONCE = frozenset(['NOBLOCK', 'DONTWAIT', 'MSG_DONTWAIT'])  # pyzmq, ``socket``
_FUTURES_FROM = frozenset(['asyncio', 'concurrent', 'multiprocessing'])


def called_name(call: Call) -> str:
    """The method that is called."""
    node = call.text
    is_method = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
    return node.func.attr if is_method else ''  # type: ignore[union-attr]


def unknown_wait(function: Mystery, call: Call, trees: list[ast.Module]) -> Unknown | None:
    """Why ``call`` may wait for something that is not known; ``None`` where it does not wait."""
    node = call.text
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return None
    name, reason = node.func.attr, function.unknown.reason
    if any(word in reason for word in _OTHERS) or not _waits(name, call, trees):
        return None
    if name == 'accept' and any(id(node) in noted_on(tree, 'alone', _alone) for tree in trees):
        return None  # a socket's gives the connection; a dialogue of a window's gives nothing
    return Unknown(f'{ast.unparse(node.func)}: {reason}', function.unknown.at or call.place)


def wait_of_one(world: World, function: Mystery) -> Unknown | None:
    """Why what was looked up by a computed name may wait, if a function that it may be does."""
    for each in function.functions if isinstance(function, LookedUp) else ():
        inner = each
        while isinstance(inner, Partial):
            inner = inner.function
        known = inner.function if isinstance(inner, Bound) else inner
        if not isinstance(known, Function) or known.name.startswith('__'):
            continue
        if any(holds_thread(text) for text in reachable(world, known.node)):
            return Unknown(f'{function.unknown.reason} may be {known.name}', function.unknown.at)
    return None


def timeout_of(call: Call) -> Value | None:
    """The time-out of a wait, which may be the first argument where nothing else can be."""
    if called_name(call) == 'poll':
        return None
    name = called_name(call)
    may_be_first = name in _TIMEOUT_FIRST or name.startswith(_WAIT)
    first = call.args[0] if call.args and may_be_first else None
    named = (call.keywords[name] for name in _LIMITS if name in call.keywords)
    return next(named, first if _is_number(first) else None)


def _waits(name: str, call: Call, trees: list[ast.Module]) -> bool:
    if _does_not_block(call):
        return False
    if name in _ALWAYS or name.startswith(_WAIT):
        return True
    if name == 'poll':
        return _has_no_end(call)
    if name in _OF_FUTURES:
        if isinstance(call.text, ast.Call) and is_done_before(call.text, trees):
            return False
        # ``rclpy.task.Future.result`` does not wait (rclpy 7.1.6, ``task.py``).
        is_plain = not call.args or _is_number(call.args[0])
        return is_plain and any(noted_on(tree, 'knows_futures', _knows_futures) for tree in trees)
    return name in _WITHOUT_VALUES and _takes_no_value(name, call)


def _alone(tree: ast.Module) -> frozenset[int]:
    """The calls whose result nobody uses."""
    return frozenset(id(part.value) for part in walk(tree) if isinstance(part, ast.Expr))


def _has_no_end(call: Call) -> bool:
    """``socket.poll(-1)`` waits forever (pyzmq, ``Socket.poll``); other ``poll`` may not wait."""
    limit = call.keywords.get('timeout', call.args[0] if call.args else None)
    is_number = isinstance(limit, Const) and isinstance(limit.value, int)
    return is_number and limit.value < 0  # type: ignore[union-attr]


def _does_not_block(call: Call) -> bool:
    flags = [call.keywords.get('block'), call.keywords.get('blocking'), *call.args[:1]]
    if any(isinstance(flag, Const) and flag.value is False for flag in flags):
        return True
    given = [*call.text.args, *call.text.keywords] if isinstance(call.text, ast.Call) else []
    names = (
        part.attr for each in given for part in ast.walk(each) if isinstance(part, ast.Attribute)
    )
    return not _AT_ONCE.isdisjoint(names)


def _takes_no_value(name: str, call: Call) -> bool:
    """``q.get()``, ``q.get(timeout=1)``, ``t.join(1)``; not ``d.get(k)``, ``text.join(words)``."""
    if not set(call.keywords) <= _KEYWORDS or call.more is not None:
        return False
    return not call.args or (name == 'join' and _is_number(call.args[0]) and len(call.args) == 1)


def _is_number(value: object) -> bool:
    return isinstance(value, Const) and isinstance(value.value, (int, float))


def _knows_futures(tree: ast.Module) -> bool:
    """Whether a file imports anything whose futures wait when they are asked."""
    for part in walk(tree):
        names = [alias.name for alias in part.names] if isinstance(part, ast.Import) else []
        if isinstance(part, ast.ImportFrom):
            names = [part.module or '']
        if any(name.partition('.')[0] in _FUTURES_FROM for name in names):
            return True
    return False
