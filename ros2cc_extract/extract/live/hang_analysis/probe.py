"""
Where every thread of this process stands, and what rclpy's objects say: looked at twice.

Runs inside the user's process, in a thread of its own that ends by itself: the standard library
only. It changes nothing; what the looks mean is decided outside. Sources: rclpy 7.1.6 and 9.1.2,
``executors.py``, ``callback_groups.py``, ``client.py``, ``task.py``.
"""

from __future__ import annotations

import contextlib
import dis
import gc
import itertools
import json
import os
import sys
import threading
import time
from types import FrameType
from typing import Any

APART_S = 0.2
# How long the second look is put off for those at other processes.
PATIENCE_S = 10.0
FIRST_SUFFIX = '.first'
MOST_FRAMES = 60
_MOST_AT_ONCE = 5000
_ENTERS = ('BEFORE_WITH', 'BEFORE_ASYNC_WITH', 'SETUP_WITH', 'SETUP_ASYNC_WITH')
_KINDS = ('timers', 'subscriptions', 'services', 'clients', 'guards', 'waitables')
# Of an action client: the futures of requests that are not answered (``action/client.py``).
_GOALS = ('_pending_goal_requests', '_pending_cancel_requests', '_pending_result_requests')
_OF_INTEREST = {
    'lock', 'RLock', 'Condition', 'Event', 'Thread', 'Future', 'Task', 'Client', 'ActionClient',
    'Queue', 'SimpleQueue', 'Semaphore', 'BoundedSemaphore', 'Barrier', 'Rate',
    'SingleThreadedExecutor', 'MultiThreadedExecutor',
}  # fmt: skip


def look_twice(path: str, go: str) -> None:
    """
    Write both looks into a new file, which is there as soon as it is whole.

    :param go: a file that is there once all processes have been looked at for the first time;
        so there is a moment between both looks that all of them have in common.
    :raises TimeoutError: when it does not come.
    """
    looks = [look()]
    with open(path + FIRST_SUFFIX, 'x', encoding='utf-8'):  # noqa: PTH123
        pass
    time.sleep(APART_S)
    given_up = time.monotonic() + PATIENCE_S
    while not os.path.exists(go):  # noqa: PTH110
        if time.monotonic() > given_up:
            raise TimeoutError('the other processes were not looked at in time')
        time.sleep(0.01)
    looks.append(look())
    with open(path + '.new', 'x', encoding='utf-8') as stream:  # noqa: PTH123
        json.dump({'python': sys.version.split()[0], 'looks': looks}, stream)
    os.replace(path + '.new', path)  # noqa: PTH105


def look() -> dict[str, Any]:
    """Look at this process once, but not at the thread that looks."""
    frames = sys._current_frames()
    frames.pop(threading.get_ident(), None)
    objects: dict[int, dict[str, Any]] = {}
    names = {thread.ident: thread for thread in list(threading._active.values())}  # type: ignore[attr-defined]
    threads = [_thread(ident, names.get(ident), frame, objects) for ident, frame in frames.items()]
    executors, nodes, tasks = _of_rclpy()
    return {
        'main': threading.main_thread().ident,
        'threads': threads,
        'executors': [_executor(each) for each in executors],
        'nodes': [_node(each) for each in nodes],
        'tasks': [row for each in tasks if (row := _suspended(each, objects)) is not None],
        'objects': {str(key): row for key, row in objects.items()},
    }


def _of_rclpy() -> tuple[list[Any], list[Any], list[Any]]:
    module = sys.modules.get('rclpy.executors')
    if module is None:
        return [], [], []
    executors: list[Any] = []
    nodes: list[Any] = []
    tasks: list[Any] = []
    wanted: dict[type, list[Any] | None] = {}
    for number, each in enumerate(gc.get_objects()):
        kind = type(each)
        try:
            found = wanted[kind]
        except KeyError:
            # There are far fewer types than objects.
            if issubclass(kind, module.Executor):
                found = executors
            elif hasattr(kind, 'default_callback_group'):
                found = nodes
            elif kind.__name__ == 'Task' and kind.__module__ == 'rclpy.task':
                found = tasks
            else:
                found = None
            wanted[kind] = found
        if found is not None:
            found.append(each)
        if number % _MOST_AT_ONCE == 0:
            # A thread that waits for the interpreter's lock gets it now, not at the end.
            time.sleep(0)
    return executors, nodes, tasks


def _thread(
    ident: int, thread: Any, frame: FrameType | None, objects: dict[int, dict[str, Any]]
) -> dict[str, Any]:
    rows: list[dict[str, Any]] = []
    while frame is not None and len(rows) < MOST_FRAMES:
        rows.append(_frame(frame, objects))
        frame = frame.f_back
    rows.reverse()
    native = getattr(thread, 'native_id', None)
    return {
        'ident': ident,
        'name': getattr(thread, 'name', 'a thread without a name'),
        'frames': rows,
        'ticks': _ticks(native),
    }


def _ticks(native: int | None) -> int | None:
    try:
        with open(f'/proc/self/task/{native}/stat', encoding='utf-8') as stream:  # noqa: PTH123
            fields = stream.read().rpartition(')')[2].split()
        return int(fields[11]) + int(fields[12])
    except (OSError, ValueError, IndexError):
        return None


def _frame(frame: FrameType, objects: dict[int, dict[str, Any]]) -> dict[str, Any]:
    code, known = frame.f_code, frame.f_locals
    values: dict[str, Any] = {name: known[name] for name in list(known) if isinstance(name, str)}
    held = values.get('self')
    for name, value in list(getattr(held, '__dict__', {}).items()):
        values[f'self.{name}'] = value
    for name in code.co_names:
        values.setdefault(name, frame.f_globals.get(name))
    return {
        'id': id(frame),
        'file': code.co_filename,
        'function': code.co_name,
        # With its class, from Python 3.11 on.
        'qualified': getattr(code, 'co_qualname', code.co_name),
        'module': str(frame.f_globals.get('__name__', '')),
        'line': frame.f_lineno,
        'at': frame.f_lasti,
        'position': _position(frame),
        'item': _item(frame),
        'objects': {
            name: _object(value, objects) for name, value in values.items() if _of_interest(value)
        },
        'endless': _is_endless(known),
        # What runs a callback: `Executor._make_handler`, its coroutine `handler`.
        'entity': id(known['entity']) if _runs_an_entity(frame) else None,
    }


def _runs_an_entity(frame: FrameType) -> bool:
    return (
        frame.f_code.co_name == 'handler'
        and frame.f_globals.get('__name__') == 'rclpy.executors'
        and 'entity' in frame.f_locals
    )


def _is_endless(known: Any) -> bool:
    for name in ('timeout', 'timeout_sec'):
        value = known.get(name)
        if isinstance(value, (int, float)) and 0 <= value < float('inf'):
            return False
    return True


def _position(frame: FrameType) -> list[int] | None:
    positions = getattr(frame.f_code, 'co_positions', None)
    if positions is None:
        return None
    for index, found in enumerate(positions()):
        if index == frame.f_lasti // 2:
            return None if None in found else list(found)
    return None


def _item(frame: FrameType) -> int | None:
    """
    Which item of its `with` a frame is entering, where positions do not show it.

    Until Python 3.11 all items of a statement have the place of the statement, or only its line.
    """
    if sys.version_info >= (3, 12) or frame.f_lasti < 0:
        return None
    steps = frame.f_code.co_code
    # Most frames stand elsewhere, and are not worth more.
    if dis.opname[steps[frame.f_lasti]] not in _ENTERS:
        return None
    before = (at for at in range(0, frame.f_lasti, 2) if dis.opname[steps[at]] in _ENTERS)
    here = _place_of(frame, frame.f_lasti)
    return sum(_place_of(frame, at) == here for at in before)


def _place_of(frame: FrameType, offset: int) -> object:
    """The position of an instruction, or its line."""
    positions = getattr(frame.f_code, 'co_positions', None)
    if positions is not None:
        return next(itertools.islice(positions(), offset // 2, None), None)
    lines = frame.f_code.co_lines()
    return next((line for start, end, line in lines if start <= offset < end), None)


def _of_interest(value: Any) -> bool:
    return any(kind.__name__ in _OF_INTEREST for kind in type(value).__mro__)


def _object(value: Any, objects: dict[int, dict[str, Any]]) -> int:
    if id(value) not in objects:
        objects[id(value)] = row = {'kind': type(value).__name__}
        with contextlib.suppress(Exception):
            _describe(value, row)
    return id(value)


def _describe(value: Any, row: dict[str, Any]) -> None:
    if row['kind'] == 'lock':
        row['locked'] = value.locked()
    elif row['kind'] == 'RLock':
        # `<locked _thread.RLock object owner=140 count=1 at 0x...>`: CPython, _threadmodule.c.
        owner = repr(value).partition('owner=')[2].partition(' ')[0]
        row['owner'] = int(owner) if owner.isdigit() else 0
    elif isinstance(value, threading.Thread):
        row.update(ident=value.ident, alive=value.is_alive(), name=value.name)
    elif callable(getattr(value, 'done', None)):
        row['done'] = bool(value.done())
    elif row['kind'] == 'Rate':
        row['timer'] = id(getattr(value, '_timer', None))


def _executor(executor: Any) -> dict[str, Any]:
    pool = getattr(executor, '_executor', None)
    return {
        'id': id(executor),
        'class': type(executor).__name__,
        'workers': getattr(pool, '_max_workers', None),
        'pool': id(getattr(pool, '_work_queue', None)) if pool is not None else None,
        'nodes': [id(node) for node in list(getattr(executor, '_nodes', ()))],
        'spun': getattr(executor, '_last_args', None) is not None,
    }


def _node(node: Any) -> dict[str, Any]:
    row: dict[str, Any] = {
        'id': id(node), 'name': '', 'domain': None, 'entities': [], 'unread': None,
    }  # fmt: skip
    with contextlib.suppress(Exception):
        row['name'] = node.get_fully_qualified_name()
        # Not by the method of the context: it takes a lock, which a shutdown that hangs holds.
        context = node.context.handle
        with context:
            row['domain'] = context.get_domain_id()
    # `use_sim_time`: then a rate waits for a publisher of `/clock`.
    row['simulated_clock'] = bool(
        getattr(getattr(node, '_clock', None), 'ros_time_is_active', False)
    )
    for kind in _KINDS:
        try:
            entities = list(getattr(node, kind, ()))
        except AttributeError as error:
            # Its constructor has not come that far (`node.py`: the properties are generators).
            row['unread'] = f'a node that is being made: {error!r}'[:200]
            continue
        for entity in entities:
            try:
                row['entities'].append(_entity(entity, kind, node))
            except Exception as error:
                row['unread'] = f'{type(entity).__name__}: {error!r}'[:200]
    return row


def _entity(entity: Any, kind: str, node: Any) -> dict[str, Any]:
    function = getattr(entity, 'callback', None)
    code = getattr(getattr(function, '__func__', function), '__code__', None)
    group = entity.callback_group
    row: dict[str, Any] = {
        'id': id(entity),
        'kind': kind,
        'class': type(entity).__name__,
        'group': id(group),
        'exclusive': hasattr(group, '_active_entity'),
        'active': id(group._active_entity) if getattr(group, '_active_entity', None) else None,
        'function': getattr(function, '__qualname__', None),
        'place': [code.co_filename, code.co_firstlineno] if code is not None else None,
        'module': getattr(function, '__module__', None) or '',
        'queued': bool(getattr(entity, '_executor_event', False)),
        'key': None,
    }
    if kind in ('services', 'clients'):
        with entity.handle:
            # `_rclpy.Client.service_name`, `_rclpy.Service.name`.
            row['key'] = str(getattr(entity.handle, 'service_name', None) or entity.handle.name)
    if kind == 'clients':
        row['there'] = bool(entity.service_is_ready())
        row['pending'] = [id(each) for each in list(entity._pending_requests.values())]
        if row['pending'] and hasattr(node, 'count_services'):  # since Jazzy
            row['servers'] = node.count_services(row['key'])
    if kind == 'timers':
        with entity.handle:
            row['ready'] = bool(entity.handle.is_timer_ready())
            row['cancelled'] = bool(entity.handle.is_timer_canceled())
    if kind == 'waitables' and hasattr(entity, _GOALS[0]):
        row['key'] = str(entity._action_name)
        row['there'] = bool(entity.server_is_ready())
        row['pending'] = [
            id(each) for name in _GOALS for each in list(getattr(entity, name).values())
        ]
    return row


def _suspended(task: Any, objects: dict[int, dict[str, Any]]) -> dict[str, Any] | None:
    """Where a coroutine that has given its thread back stands, and on which future."""
    handler = getattr(task, '_handler', None)
    if task.done() or task.executing() or getattr(handler, 'cr_frame', None) is None:
        return None
    executor = task._executor()
    if executor is None or getattr(executor, '_is_shutdown', False):
        return None  # nobody ever goes on with it
    owner = None
    rows: list[dict[str, Any]] = []
    future = None
    while handler is not None and len(rows) < MOST_FRAMES:
        frame = getattr(handler, 'cr_frame', None) or getattr(handler, 'gi_frame', None)
        if frame is None:
            break
        owner = owner or id(frame.f_locals.get('entity'))
        if frame.f_code.co_name == '__await__':
            future = frame.f_locals.get('self')
        rows.append(_frame(frame, objects))
        handler = getattr(handler, 'cr_await', None) or getattr(handler, 'gi_yieldfrom', None)
    if future is None or len(rows) < 2:
        return None
    return {
        'entity': owner,
        'executor': id(executor),
        'frames': rows,
        'future': _object(future, objects),
        'done': bool(future.done()),
    }
