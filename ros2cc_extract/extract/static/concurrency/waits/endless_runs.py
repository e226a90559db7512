"""
Threads that run a loop of asyncio or a server for ever, where no text of the program may stop it.

Both go on until their ``stop`` or ``shutdown`` is called, whatever happens to rclpy, and raise
only what ends an interpreter, as ``SystemExit`` where they call the program. Sources: CPython
3.12, ``asyncio/base_events.py`` (``run_forever``), ``asyncio/events.py`` (``Handle._run``),
``socketserver.py`` (``serve_forever``, ``_handle_request_noblock``); run on 3.11.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import FINDS_BY_TEXT
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.values.values import Value
from ros2cc_extract.source_locations import Place

_EXITS = frozenset(['exit', '_exit', 'quit', 'SystemExit', 'KeyboardInterrupt', 'BaseException'])
_OTHERS = {'stop': 'self', 'shutdown': 'rclpy'}
"""What ends such a run, and the name of something else that has a method of that name."""


def note_endless_run(world: ConcurrentWorld, what: Value, place: Place, by: str) -> None:
    """
    It is run for ever; where a thread always does that, nothing but the program ends it.

    :param by: the name of what stops it.
    """
    activity = world.activity
    is_sure = world.second_pass and world.path == world.callback_path and not world.caught
    is_own = world.is_program and id(what) not in world.given
    if activity is not None and is_sure and is_own and not _may_stop(world, by):
        activity.loops, activity.endless = True, place


def _may_stop(world: ConcurrentWorld, by: str) -> bool:
    def stops(tree: ast.Module) -> bool:
        parts = tuple(walk(tree))
        return _stops(parts, by) or _exits(parts)

    return any(noted_on(tree, f'may_{by}_loops', stops) for tree, _ in world.files)


def _stops(parts: Sequence[ast.AST], by: str) -> bool:
    """Whether a text stops something, or finds functions by a text."""
    methods = [part for part in parts if isinstance(part, ast.Attribute) and part.attr == by]
    is_stopped = any(getattr(part.value, 'id', '') != _OTHERS[by] for part in methods)
    return is_stopped or not FINDS_BY_TEXT.isdisjoint(_names(parts))


def _exits(parts: Sequence[ast.AST]) -> bool:
    """Whether a coroutine, or a method that answers a server, may end its interpreter."""
    called = (
        part
        for part in parts
        if isinstance(part, ast.AsyncFunctionDef)
        or (isinstance(part, ast.FunctionDef) and part.name.startswith(('do_', 'handle')))
    )
    return any(not _EXITS.isdisjoint(_names(walk(part))) for part in called)


def _names(parts: Iterable[ast.AST]) -> set[str]:
    named = (getattr(part, 'attr', getattr(part, 'id', None)) for part in parts)
    return {name for name in named if isinstance(name, str)}
