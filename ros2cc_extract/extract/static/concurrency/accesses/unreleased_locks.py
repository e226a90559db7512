"""
Ways out of a function on which it keeps a lock that it gives back on others.

Only the text is looked at: which statements follow each other. Exceptions are left out, since
any call may raise one; but for those that a statement of the function raises and a caller catches.
"""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator, Sequence, Set
from dataclasses import field

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.accesses.signal_locks import are_signals
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.values.values import Function
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

FunctionNode = ast.FunctionDef | ast.AsyncFunctionDef
Held = frozenset[bool]
"""Whether the lock may be held, and whether it may be free; empty where nothing gets."""

_NOWHERE: Held = frozenset()
_TAKES, _GIVES = 'acquire', 'release'


def ways_that_keep(
    function: FunctionNode, lock: str, suffix: str = '', caught: Set[tuple[int, int]] = frozenset()
) -> tuple[ast.stmt, ...]:
    """
    The statements by which the function is left with the lock still held.

    :param lock: text of the lock's expression, ``self.lock``.
    :param suffix: of the methods: ``_read`` for ``acquire_read`` and ``release_read``.
    :param caught: lines and columns where it raises what a caller catches.
    :return: nothing where the function never gives the lock back: another one may; and nothing
        where it gives it back first: its caller holds the lock, and wants it held again. Nor
        where one loop takes several locks, and another one gives them back.
    """
    walk = _Walk(lock, suffix, caught)
    given = min((_at(p) for p in ast.walk(function) if walk.does(p, _GIVES)), default=None)
    taken = min((_at(p) for p in ast.walk(function) if walk.does(p, _TAKES)), default=None)
    if given is None or (taken is not None and given < taken):
        return ()
    if any(walk.is_try(part) for part in ast.walk(function)) or _is_of_loops(function, lock):
        return ()
    at_end = walk.block(function.body, frozenset({False}))
    if True in at_end:
        walk.kept.append(function.body[-1])
    return tuple(sorted(set(walk.kept), key=lambda statement: statement.lineno))


def _is_of_loops(function: FunctionNode, lock: str) -> bool:
    """Whether one loop goes over locks and takes them, and another one to give them back."""
    name = lock.partition('.')[0]
    loops = [part for part in ast.walk(function) if isinstance(part, (ast.For, ast.AsyncFor))]
    return sum(isinstance(loop.target, ast.Name) and loop.target.id == name for loop in loops) > 1


def note_raised(world: ConcurrentWorld, error: ast.expr, place: Place) -> None:
    """Remember the place of a ``raise`` that some caller has a handler for."""
    called = error.func if isinstance(error, ast.Call) else error
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, 'id', '')
    kind = getattr(builtins, name, Exception)  # of a class of the program's own
    classes = kind.__mro__ if isinstance(kind, type) else ()
    names = {name, *(each.__name__ for each in classes)}
    if any(not names.isdisjoint(caught) for caught in world.caught):
        world.caught_raises.setdefault(place.file, set()).add((place.line, place.column - 1))


def _at(call: ast.AST) -> tuple[int, int]:
    return call.lineno, call.col_offset  # type: ignore[attr-defined]


@dataclass
class _Walk:
    lock: str
    suffix: str
    caught: Set[tuple[int, int]]
    handled: int = 0
    kept: list[ast.stmt] = field(default_factory=list)
    finals: list[Sequence[ast.stmt]] = field(default_factory=list)

    def does(self, node: ast.AST, verb: str) -> bool:
        """Whether ``node`` is ``lock.acquire()`` or ``lock.release()``."""
        return (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr == verb + self.suffix
            and ast.unparse(node.func.value) == self.lock
        )

    def is_try(self, node: ast.AST) -> bool:
        """Whether it takes the lock in another way than by a statement of its own."""
        if not self.does(node, _TAKES):
            return False
        return bool(node.args or node.keywords)  # type: ignore[attr-defined]

    def block(self, body: Sequence[ast.stmt], held: Held) -> Held:
        """What may hold after the statements; leaves are noted on the way."""
        for statement in body:
            held = self.statement(statement, held)
        return held

    def statement(self, node: ast.stmt, held: Held) -> Held:
        """What may hold after one statement."""
        if not held or isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            return held
        if isinstance(node, ast.If):
            return self.block(node.body, held) | self.block(node.orelse, held)
        if isinstance(node, (ast.For, ast.AsyncFor, ast.While)):
            return self.block(node.orelse, held | self.block(node.body, held))
        if isinstance(node, (ast.With, ast.AsyncWith)):
            return self.block(node.body, held)
        if isinstance(node, ast.Match):
            return held.union(*(self.block(case.body, held) for case in node.cases))
        if isinstance(node, ast.Try):
            return self._try(node, held)
        return self._simple(node, held)

    def _try(self, node: ast.Try, held: Held) -> Held:
        self.finals.append(node.finalbody)
        self.handled += bool(node.handlers)
        after = self.block(node.body, held)
        self.handled -= bool(node.handlers)
        caught_with = after if self._begins_by_giving(node.body) else held | after
        caught = [self.block(handler.body, caught_with) for handler in node.handlers]
        after = self.block(node.orelse, after).union(*caught)
        self.finals.pop()
        return self.block(node.finalbody, after)

    def _begins_by_giving(self, body: Sequence[ast.stmt]) -> bool:
        """Whether ``release`` is what may fail first; it does so where the lock is not held."""
        first = body[0]
        return isinstance(first, ast.Expr) and self.does(first.value, _GIVES)

    def _simple(self, node: ast.stmt, held: Held) -> Held:
        for part in ast.walk(node):
            if self.does(part, _TAKES):
                held = frozenset({True})
            elif self.does(part, _GIVES):
                held = frozenset({False})
        if not isinstance(node, (ast.Return, ast.Raise)):
            return held
        is_way_out = isinstance(node, ast.Return) or (
            not self.handled and _at(node) in self.caught
        )
        if is_way_out and True in self._after_finals(held):
            self.kept.append(node)
        return _NOWHERE

    def _after_finals(self, held: Held) -> Held:
        pending, self.finals = self.finals, []
        for body in reversed(pending):
            held = self.block(body, held)
        self.finals = pending
        return held


def locks_given_back(body: Sequence[ast.stmt], world: ConcurrentWorld) -> tuple[str, ...]:
    """
    The locks that statements give back, by name.

    A handler that does so runs while they are held, wherever before it they were taken.
    """
    calls = (part for statement in body for part in ast.walk(statement))
    owners = [
        ast.unparse(call.func.value).rpartition('.')[2]
        for call in calls
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Attribute)
        and call.func.attr.startswith(_GIVES)
    ]
    return tuple(name for name in dict.fromkeys(owners) if name in world.locks)


def note_kept_locks(world: ConcurrentWorld) -> None:
    """Note every followed function that keeps a lock on some way out."""
    if not world.locks:
        return
    for function in world.called.values():
        node = function.node
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            caught = world.caught_raises.get(function.place.file, set())
            for call, lock, suffix in _taken_in(node, world):
                for way in ways_that_keep(node, lock, suffix, caught):
                    world.diagnostics.append(_kept(function, call, lock, way))


def _taken_in(node: FunctionNode, world: ConcurrentWorld) -> Iterator[tuple[ast.Call, str, str]]:
    """The locks that a function takes by a call, each once, with the end of the method's name."""
    reported: set[tuple[str, str]] = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Call) and isinstance(part.func, ast.Attribute):
            method, lock = part.func.attr, ast.unparse(part.func.value)
            key = lock, method.removeprefix(_TAKES)
            locks = world.locks.get(lock.rpartition('.')[2], [])
            is_lock = bool(locks) and not are_signals(world, locks)
            if method.startswith(_TAKES) and is_lock and key not in reported:
                reported.add(key)
                yield part, *key


def _kept(function: Function, call: ast.Call, lock: str, way: ast.stmt) -> Diagnostic:
    file = function.place.file
    leaves = 'returns' if isinstance(way, ast.Return) else 'may end'
    if isinstance(way, ast.Raise):
        leaves = 'raises'
    return Diagnostic(
        severity=Severity.ERROR,
        slug='lock-kept',
        place=Place(file, way.lineno, way.col_offset + 1),
        message=f'{function.name} {leaves} here and keeps {lock}, '
        f'taken at line {call.lineno}: the next one that takes it waits forever',
        help=f'write "with {lock}:", which gives it back however it is left',
    )
