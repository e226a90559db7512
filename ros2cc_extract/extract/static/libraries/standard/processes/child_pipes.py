"""
Pipes of a child process that are not read while its end is waited for.

``Popen.wait`` deadlocks when the child has written more than the pipe holds: it waits for a
reader, and the only one waits for its end (CPython, library reference, ``subprocess``). Code that
asks for the stream before, or elsewhere in the program, counts as its reader.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Call, Instance, Library, Value
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Blocking

_PIPE = 'subprocess.PIPE'
_STREAMS = (('stdout', 4), ('stderr', 5))
WAIT = 'Popen.wait'


def piped(call: Call) -> list[str]:
    """The streams that a new child writes into pipes."""
    given = {name: call.argument(position, name) for name, position in _STREAMS}
    return [name for name, value in given.items() if _is_pipe(value)]


def _is_pipe(value: Value | None) -> bool:
    return isinstance(value, Library) and value.name == _PIPE


def note_read(world: ConcurrentWorld, child: Value) -> None:
    """Code asks for a stream of ``child``, or lets ``communicate`` read them."""
    if isinstance(child, Instance):
        readers = world.readers.setdefault(child.place, [])
        if not any(world.effects is reader for reader in readers):
            readers.append(world.effects)


def note_wait(world: ConcurrentWorld, child: Value, streams: list[str], place: Place) -> None:
    """The end of ``child`` is waited for without a time-out."""
    effects = world.effects
    if effects is None or not streams or not isinstance(child, Instance):
        return
    if not any(effects is reader for reader in world.readers.get(child.place, ())):
        effects.unread.setdefault((place, world.chain[1:]), (child.place, streams[0]))


def lines_after_kill(function: ast.AST) -> frozenset[int]:
    """
    The lines of statements behind one of the same block that sends ``SIGKILL``.

    No process outlives that signal (``signal(7)``); ``SIGTERM`` may be ignored, and a pipe that a
    child of the child has as well is open still.
    """
    found: set[int] = set()
    for part in walk(function):
        for block in (getattr(part, name, ()) for name in ('body', 'orelse', 'finalbody')):
            statements = block if isinstance(block, list) else []
            first = next((at for at, each in enumerate(statements) if _kills(each)), None)
            for each in statements[first + 1 :] if first is not None else ():
                found.update(range(each.lineno, (each.end_lineno or each.lineno) + 1))
    return frozenset(found)


def _kills(statement: ast.stmt) -> bool:
    """Whether a statement sends it, or tries to."""
    if isinstance(statement, ast.Try):
        return any(map(_kills, statement.body))
    return isinstance(statement, ast.Expr) and any(
        isinstance(part, ast.Attribute)
        and (part.attr == 'SIGKILL' or (part.attr == 'kill' and not _is_os(part.value)))
        for part in walk(statement)
    )


def _is_os(owner: ast.expr) -> bool:
    """``os.kill`` sends any signal."""
    return isinstance(owner, ast.Name) and owner.id == 'os'


def unread_at(world: ConcurrentWorld, block: Blocking, effects: EffectLog) -> str | None:
    """The stream that is not read while ``block`` lasts, of a child that is waited for."""
    child, stream = effects.unread.get((block.source, block.chain), (None, None))
    if block.call != WAIT or child is None:
        return None
    others = [reader for reader in world.readers.get(child, ()) if reader is not effects]
    return None if others else stream
