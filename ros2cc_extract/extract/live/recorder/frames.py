"""
Where something was created, and what a callback is called.

Runs inside the user's process: the standard library only, nothing else of ours.
"""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import islice
from pathlib import PurePath
from types import CodeType, CoroutineType, FrameType
from typing import Any

# file, line, column; line and column 1-based, column 0 where the interpreter does not keep it.
RawPlace = tuple[str, int, int]

# Libraries that create entities on a node's behalf; the place of interest is their caller's.
LIBRARIES = frozenset({'tf2_ros', 'message_filters', 'diagnostic_updater'})
# Our wrappers lie between rclpy and the program.
_OURS = __name__.rsplit('.', 2)[0]


@dataclass
class Creation:
    """
    Where in the user's program an object was created, and by way of what.

    :param through: modules of rclpy passed on the way, innermost first (``node``, ``timer`` …).
    :param functions: functions of rclpy passed on the way.
    :param node: node concerned, if one was passed on the way.
    :param callback: what a QoS event handler is going to call.
    :param topic: of the publisher or subscription concerned.
    """

    place: RawPlace | None = None
    library: str | None = None
    through: list[str] = field(default_factory=list)
    functions: list[str] = field(default_factory=list)
    in_callback: bool = False
    in_configure: bool = False
    node: Any = None
    callback: Any = None
    topic: str | None = None
    action_name: str | None = None
    execute_callback: Any = None


def trace_creation(frame: FrameType | None, made: Any = None) -> Creation:
    """
    Walk outwards from inside rclpy until the whole way to the program is known.

    :param made: the object that is being made; its own constructors are passed over.
    """
    creation = Creation()
    while frame is not None:
        module = str(frame.f_globals.get('__name__', ''))
        package, _, rest = module.partition('.')
        if package == 'rclpy':
            _pass_rclpy(creation, frame, rest)
        elif module.rsplit('.', 2)[0] == _OURS:
            pass
        elif package in LIBRARIES and creation.place is None:
            creation.library = package
        elif not _is_constructor_of(made, frame):
            creation.place = creation.place or place_of(frame)
            creation.in_configure |= frame.f_code.co_name == 'on_configure'
        frame = frame.f_back
    return creation


def _is_constructor_of(made: Any, frame: FrameType) -> bool:
    return (
        made is not None
        and frame.f_code.co_name == '__init__'
        and frame.f_locals.get('self') is made
    )


def _pass_rclpy(creation: Creation, frame: FrameType, module: str) -> None:
    function = frame.f_code.co_name
    if creation.place is not None:
        creation.in_callback = creation.in_callback or (
            module == 'executors' and function in ('_execute', 'await_or_execute')
        )
        return
    creation.through.append(module)
    creation.functions.append(function)
    if creation.node is None:
        known = frame.f_locals
        creation.node = next(
            (known[name] for name in ('self', 'node') if is_node(known.get(name))), None
        )
    if function == '__init__':
        _read_arguments(creation, module, frame.f_locals)
    elif function in ('create_publisher', 'create_subscription'):
        creation.topic = frame.f_locals.get('topic')


def _read_arguments(creation: Creation, module: str, arguments: Mapping[str, Any]) -> None:
    """Keep the arguments that an entity of rclpy does not keep itself, or not yet."""
    if module.startswith('action.'):
        creation.action_name = arguments.get('action_name') or creation.action_name
        creation.execute_callback = arguments.get('execute_callback')
    elif module == 'event_handler':
        creation.callback = arguments.get('callback') or creation.callback


def is_node(value: Any) -> bool:
    """Return whether ``value`` is an rclpy node, without importing rclpy."""
    return hasattr(type(value), 'default_callback_group')


def place_of(frame: FrameType) -> RawPlace:
    """Give the place of the call that ``frame`` is executing."""
    line, column = frame.f_lineno, 0
    positions = getattr(frame.f_code, 'co_positions', None)
    if positions is not None:
        found = next(islice(positions(), frame.f_lasti // 2, None), None)
        if found is not None and found[0] is not None and found[2] is not None:
            line, column = found[0], _characters(frame.f_code.co_filename, found[0], found[2]) + 1
    return frame.f_code.co_filename, line, column


def _characters(file: str, line: int, offset: int) -> int:
    """Turn an offset in bytes of UTF-8 into one in characters; equal where all is ASCII."""
    linecache = sys.modules.get('linecache')
    text = linecache.getline(file, line) if linecache else ''
    return offset if not text or text.isascii() else len(text.encode()[:offset].decode())


@dataclass(frozen=True)
class FunctionName:
    """
    A callback as a person would name it.

    :param name: module and qualified name; ``__main__`` replaced by the name of its file.
    :param defined: where it is written; ``None`` for functions written in C.
    """

    name: str
    module: str
    defined: RawPlace | None
    coroutine: bool


def name_function(callback: Any) -> FunctionName | None:
    """Look through partials, decorators, methods and callable objects; a coroutine may run."""
    if callback is None:
        return None
    if inspect.iscoroutine(callback):
        return _name_coroutine(callback)
    while isinstance(callback, functools.partial):
        callback = callback.func
    callback = inspect.unwrap(callback)
    coroutine = inspect.iscoroutinefunction(callback)
    if not (inspect.isroutine(callback) or inspect.isclass(callback)):
        callback = type(callback).__call__
    code = getattr(callback, '__code__', None)
    module = getattr(callback, '__module__', None) or ''
    qualname = getattr(callback, '__qualname__', None) or repr(callback)
    return FunctionName(
        f'{_module_name(module, code)}.{qualname}', module, _defined(code), coroutine
    )


def _name_coroutine(begun: CoroutineType[Any, Any, Any]) -> FunctionName:
    code, frame = begun.cr_code, begun.cr_frame
    module = str(frame.f_globals.get('__name__', '')) if frame is not None else ''
    name = f'{_module_name(module, code)}.{begun.__qualname__}'
    return FunctionName(name, module, _defined(code), coroutine=True)


def _defined(code: CodeType | None) -> RawPlace | None:
    return (code.co_filename, code.co_firstlineno, 0) if code is not None else None


def _module_name(module: str, code: CodeType | None) -> str:
    if module in ('__main__', '__mp_main__', '<run_path>') and code is not None:
        return PurePath(code.co_filename).stem
    return module


def class_name(value: Any) -> str:
    return type(value).__name__
