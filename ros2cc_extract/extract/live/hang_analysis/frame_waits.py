"""What a thread or a coroutine waits for, read from its frames and from the source they name."""

from __future__ import annotations

import ast
import functools
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Frame, Look
from ros2cc_extract.files import read_regular

_MOST_SOURCE_BYTES = 5_000_000
_EXECUTORS = 'rclpy.executors'


class Kind(Enum):
    """What is waited for."""

    ANSWER = 'the answer of a service'
    ACTION = 'the answer of an action server'
    SERVER = 'a server that is not there'
    LOCK = 'a lock'
    EVENT = 'an event'
    CONDITION = 'a condition'
    QUEUE = 'a queue'
    FUTURE = 'a future'
    JOIN = 'the end of a thread'
    RATE = 'a rate'
    SPIN = 'a nested spin, which ends at shutdown'
    SLEEP = 'time'
    WORK = 'work'
    NOTHING = 'nothing that can be recognised'


@dataclass(frozen=True)
class Wait:
    """
    :param resource: number of the object, of a client for an answer.
    :param timed: ends by a time-out.
    :param spins: the executor that is served meanwhile.
    """

    kind: Kind
    resource: int | None = None
    timed: bool = False
    spins: int | None = None


def wait_of(activity: Activity, look: Look) -> Wait:
    """Say what the innermost frames wait for."""
    if activity.future is not None:
        return _of_future(activity.future, look)
    frame = activity.frames[-1]
    spin = _spin(activity, look)
    if spin is not None:
        return spin
    if any(f.is_in('concurrent.futures.thread', '_worker') for f in activity.frames[-1:]):
        return Wait(Kind.WORK)
    if frame.is_in('threading', 'wait') and 'self' in frame.objects:
        return _of_condition(activity, frame, look)
    if frame.is_in('threading', 'join', '_wait_for_tstate_lock', '_join_thread'):
        return Wait(Kind.JOIN, frame.objects.get('self'), timed=not frame.endless)
    if frame.is_in('rclpy.client', 'wait_for_service') or frame.is_in(
        'rclpy.action.client', 'wait_for_server'
    ):
        return Wait(Kind.SERVER, frame.objects.get('self'), timed=not frame.endless)
    return _of_source(frame, look)


def _spin(activity: Activity, look: Look) -> Wait | None:
    """A spin whose innermost frames are those of the executor, with no callback above it."""
    last = len(activity.frames)
    while last and not activity.frames[last - 1].of_program:
        last -= 1
    inner = activity.frames[last:]
    spinning = [f for f in inner if f.is_in(_EXECUTORS) and f.function.startswith('spin')]
    if not spinning or any(f.entity is not None for f in inner[inner.index(spinning[-1]) :]):
        return None
    executor = spinning[-1].objects.get('self')
    outer = activity.frames[: activity.frames.index(spinning[0])]
    future = next((f.objects['future'] for f in inner if 'future' in f.objects), None)
    timed = any(not f.endless for f in inner if f.function.startswith('spin'))
    if not any(f.entity is not None for f in outer) and future is None:
        return Wait(Kind.WORK, timed=timed, spins=executor)
    if future is None:
        return Wait(
            Kind.SPIN, executor, timed=timed or inner[0].function != 'spin', spins=executor
        )
    found = _of_future(future, look)
    return Wait(found.kind, found.resource, timed=timed, spins=executor)


def _of_future(future: int, look: Look) -> Wait:
    for entity in look.entities.values():
        if future in entity.pending:
            kind = Kind.ANSWER if entity.kind == 'clients' else Kind.ACTION
            return Wait(kind, entity.number)
    return Wait(Kind.FUTURE, future)


def _of_condition(activity: Activity, frame: Frame, look: Look) -> Wait:
    outer = activity.frames[-2] if len(activity.frames) > 1 else frame
    timed = not frame.endless
    if outer.is_in('threading', 'wait'):
        event, outer = outer.objects.get('self'), activity.frames[-3]
        if outer.module in ('rclpy.client', 'rclpy.action.client'):
            known = outer.objects
            future = known.get('future', known.get('send_goal_future'))
            found = _of_future(future, look) if future is not None else Wait(Kind.FUTURE)
            return Wait(found.kind, found.resource, timed=timed)
        if outer.is_in('rclpy.timer', 'sleep'):
            rate = look.objects.get(outer.objects.get('self', 0), {})
            return Wait(Kind.RATE, rate.get('timer'), timed=timed)
        return Wait(Kind.EVENT, event, timed=timed)
    kind = {'queue': Kind.QUEUE, 'concurrent.futures._base': Kind.FUTURE}.get(outer.module)
    return Wait(kind or Kind.CONDITION, outer.objects.get('self'), timed=timed)


def _of_source(frame: Frame, look: Look) -> Wait:
    asked = list(_asked(frame))
    if len(asked) > 1:
        return Wait(Kind.LOCK)  # one of several, and the interpreter does not say which
    for expression, call in asked:
        name = ast.unparse(expression)
        number = frame.objects.get(name)
        if number is not None and look.objects[number]['kind'] in ('lock', 'RLock'):
            # `acquire` with arguments may give up by itself.
            return Wait(Kind.LOCK, number, timed=bool(call and (call.args or call.keywords)))
        if call is not None and name in ('time', 'sleep'):
            return Wait(Kind.SLEEP, timed=True)
    return Wait(Kind.NOTHING)


def _asked(frame: Frame) -> Iterator[tuple[ast.expr, ast.Call | None]]:
    """What is entered by ``with``, or called by a method, where the frame stands."""
    for node in ast.walk(_tree(frame.file)):
        if isinstance(node, (ast.With, ast.AsyncWith)):
            yield from ((item.context_expr, None) for item in _entering(node, frame))
        elif isinstance(node, ast.Call) and _is_at(node, frame):
            if isinstance(node.func, ast.Attribute) and node.func.attr in ('acquire', 'sleep'):
                yield node.func.value, node
            elif isinstance(node.func, ast.Name):
                yield node.func, node


def _is_at(node: ast.expr | ast.stmt, frame: Frame) -> bool:
    if frame.position is None:
        return node.lineno == frame.line
    own = (node.lineno, node.end_lineno, node.col_offset, node.end_col_offset)
    return own == frame.position


def locks_held(activity: Activity) -> Iterator[tuple[int, Frame]]:
    """Locks that the frames have entered by ``with``, and the frames."""
    for frame in activity.frames:
        if not frame.of_program:
            continue
        for node in ast.walk(_tree(frame.file)):
            if isinstance(node, ast.With) and _is_around(node, frame):
                for item in _entered(node, frame):
                    number = frame.objects.get(ast.unparse(item.context_expr))
                    if number is not None:
                        yield number, frame


def _is_around(node: ast.With, frame: Frame) -> bool:
    """Within the `with`, and within no function that is only defined there."""
    if not node.lineno <= frame.line <= (node.end_lineno or node.lineno):
        return False
    return not any(
        isinstance(each, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda))
        and each.lineno <= frame.line <= (each.end_lineno or each.lineno)
        for each in ast.walk(node)
    )


def _entered(node: ast.With, frame: Frame) -> list[ast.withitem]:
    if frame.line >= node.body[0].lineno and frame.line > node.items[-1].context_expr.lineno:
        return node.items
    entering = _entering(node, frame)
    return node.items[: node.items.index(entering[0])] if len(entering) == 1 else []


def _entering(node: ast.With | ast.AsyncWith, frame: Frame) -> list[ast.withitem]:
    """The item at whose beginning the frame stands; several if it is not known."""
    whole = _is_at(node, frame)  # all items have the place of the statement in Python 3.11
    here = [item for item in node.items if whole or _is_at(item.context_expr, frame)]
    return here if frame.item is None else here[frame.item : frame.item + 1]


@functools.cache
def _tree(file: str) -> ast.Module:
    """Return the tree of the source as it is now; an empty one if it cannot be read."""
    try:
        return ast.parse(read_regular(Path(file), _MOST_SOURCE_BYTES))
    except (OSError, SyntaxError, ValueError, RecursionError):
        return ast.Module(body=[], type_ignores=[])
