"""Loops whose text shows that they do little but wait until other code has done something."""

from __future__ import annotations

import ast
from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import WORKING_LOOP
from ros2cc_extract.spec.model import ActivityKind

_LOGGING = frozenset(
    ['print', 'get_logger', 'debug', 'info', 'warn', 'warning', 'warning_once', 'error']
)
PASTIMES = _LOGGING | {'sleep'}
"""Calls that only let time pass, or log."""
ROS_CLOCKS = frozenset(['now', 'get_clock'])
CLOCKS = ROS_CLOCKS | {'time', 'time_ns', 'monotonic', 'perf_counter'}
"""Calls that ask a clock: of rclpy, and of ``time``."""

_IDLE = PASTIMES | {'ok'}

_WAITING = _IDLE | CLOCKS | {'spin_once'}

_HARMLESS = _IDLE | (CLOCKS - ROS_CLOCKS) | {'append', 'len', 'str', 'put', 'set'}


def goes_round(loop: ast.While) -> bool:
    """Whether there is a second round: not where each way through the body leaves the loop."""
    return _falls_through(loop.body) or any(_continues(each) for each in loop.body)


def _falls_through(body: Sequence[ast.stmt]) -> bool:
    return not any(_leaves(each) for each in body)


def _leaves(statement: ast.stmt) -> bool:
    """Whether what stands behind it is never reached from it."""
    if isinstance(statement, (ast.Break, ast.Return, ast.Raise)):
        return True
    if isinstance(statement, ast.If):
        return not (_falls_through(statement.body) or _falls_through(statement.orelse))
    if isinstance(statement, (ast.With, ast.AsyncWith)):
        # A manager that is made here, as contextlib.suppress(), may go on behind an exception.
        is_made = any(isinstance(item.context_expr, ast.Call) for item in statement.items)
        return not (is_made or _falls_through(statement.body))
    if isinstance(statement, ast.Try):
        handled = (handler.body for handler in statement.handlers)
        ways = ([*statement.body, *statement.orelse], *handled)
        return not _falls_through(statement.finalbody) or not any(map(_falls_through, ways))
    return False


def _continues(part: ast.AST) -> bool:
    """Whether it begins the next round; a loop or a function inside has rounds of its own."""
    if isinstance(part, (ast.For, ast.AsyncFor, ast.While)):
        return any(map(_continues, part.orelse))
    if isinstance(part, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)):
        return False
    return isinstance(part, ast.Continue) or any(map(_continues, ast.iter_child_nodes(part)))


def awaits_each_round(loop: ast.While) -> bool:
    """Whether no round of ``loop`` ends without an ``await``, unless it leaves the loop."""
    return _awaits((loop.test,)) or _always_awaits(loop.body)


def _always_awaits(statements: Sequence[ast.stmt]) -> bool:
    """Whether one of ``statements`` awaits on every branch inside of it."""
    return any(_awaits(_heads(each)) or _always_awaits(_bodies(each)) for each in statements)


def _bodies(statement: ast.stmt) -> Sequence[ast.stmt]:
    """What of a compound statement runs in any case."""
    if isinstance(statement, (ast.With, ast.AsyncWith)):
        return statement.body
    return (*statement.body, *statement.finalbody) if isinstance(statement, ast.Try) else ()


def _heads(statement: ast.stmt) -> Sequence[ast.AST]:
    """The parts of a statement that are evaluated in any case."""
    if isinstance(statement, (ast.If, ast.While)):
        return (statement.test,)
    if isinstance(statement, (ast.For, ast.AsyncFor)):
        return (statement.iter,)
    is_compound = hasattr(statement, 'body') or isinstance(statement, ast.Match)
    return () if is_compound else (statement,)


def _awaits(parts: Sequence[ast.AST]) -> bool:
    return any(isinstance(each, ast.Await) for part in parts for each in ast.walk(part))


def is_idle(loop: ast.While) -> bool:
    """True for a loop that only sleeps and logs while it waits."""
    return passes_time(loop.body)


def passes_time(body: Sequence[ast.stmt]) -> bool:
    """True for statements that only sleep and log."""
    return all(
        is_pastime(part)
        for statement in body
        for part in ast.walk(statement)
        if isinstance(part, (ast.Call, ast.Await))
    )


def is_pastime(part: ast.expr) -> bool:
    """True for a call that only sleeps or logs."""
    return _called_name(part) in _IDLE


def only_waits(loop: ast.While) -> bool:
    """True for a loop that only sleeps, logs and spins while it waits."""
    parts = [part for each in loop.body for part in ast.walk(each)]
    called = {_called_name(part) for part in parts if isinstance(part, ast.Call)}
    stores = (part for part in parts if isinstance(part, (ast.Attribute, ast.Subscript)))
    return called <= _WAITING and not any(isinstance(part.ctx, ast.Store) for part in stores)


def minds_nothing(loop: ast.While) -> bool:
    """Whether it does nothing that may raise, or end it, when rclpy is shut down."""
    called = (_called_name(part) for part in ast.walk(loop) if isinstance(part, ast.Call))
    is_plain = not any(isinstance(part, (ast.Raise, ast.Await)) for part in ast.walk(loop))
    return _called_name(loop.test) != 'ok' and is_plain and _HARMLESS.issuperset(called)


def kept_by(loop: ast.While, place: Place) -> tuple[Place | None, Place | None]:
    """What keeps a thread in it: the loop that not even the end of rclpy ends, or all but that."""
    raises = any(isinstance(part, ast.Raise) for part in ast.walk(loop))
    asks = _called_name(loop.test) == 'ok' and not raises
    return place if minds_nothing(loop) else None, place if asks else None


def call_of_loop(loop: ast.While, call: str, activity: ActivityState | None) -> str:
    """
    How a loop that others end is called: one in which a thread works waits for nobody.

    Code that joins the thread waits for its end all the same.
    """
    works = activity is not None and activity.kind is not ActivityKind.MAIN and not is_idle(loop)
    return WORKING_LOOP if works else call


def spins(loop: ast.While) -> bool:
    """True for a loop that lets an executor run what is ready, again and again."""
    return any(
        isinstance(part, ast.Call) and _called_name(part) == 'spin_once'
        for statement in loop.body
        for part in ast.walk(statement)
    )


def is_endless(loop: ast.While) -> bool:
    """True for ``while True`` and ``while rclpy.ok()``."""
    test = loop.test
    return bool(test.value) if isinstance(test, ast.Constant) else _called_name(test) == 'ok'


def _called_name(call: ast.expr) -> str:
    function = call.func if isinstance(call, ast.Call) else None
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ''
