"""
Ways out of a function on which it keeps a lock that it gives back on others.

Only the text is looked at: which statements follow each other. Exceptions are left out, since
any call may raise one; but for those that a statement of the function raises and a caller catches.
Methods of a class that do nothing but take its lock, or give it back, count like those of a lock.
"""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import field

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.accesses.signal_locks import are_signals
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.values.values import Function, Value
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

FunctionNode = ast.FunctionDef | ast.AsyncFunctionDef
Held = frozenset[bool]
"""Whether the lock may be held, and whether it may be free; empty where nothing gets."""

_NOWHERE: Held = frozenset()
_TAKES, _GIVES = 'acquire', 'release'


@dataclass(frozen=True)
class Verbs:
    """
    The methods that take a lock and give it back.

    :param of: the lock's expression in these methods, empty where they are its own.
    """

    takes: frozenset[str]
    gives: frozenset[str]
    of: str = ''


def own_verbs(suffix: str = '') -> Verbs:
    """Those of a lock itself; ``_read`` for ``acquire_read`` and ``release_read``."""
    return Verbs(frozenset({_TAKES + suffix}), frozenset({_GIVES + suffix}))


def ways_that_keep(
    function: FunctionNode,
    lock: str,
    verbs: Verbs,
    caught: Set[tuple[int, int]] = frozenset(),
) -> tuple[ast.stmt, ...]:
    """
    The statements by which the function is left with the lock still held.

    :param lock: text of the lock's expression, ``self.lock``.
    :param caught: lines and columns where it raises what a caller catches.
    :return: nothing where the function never gives the lock back: another one may; and nothing
        where it gives it back first: its caller holds the lock, and wants it held again. Nor
        where one loop takes several locks, and another one gives them back.
    """
    walk = _Walk(lock, verbs, caught)
    given = min((_at(p) for p in ast.walk(function) if walk.does(p, verbs.gives)), default=None)
    taken = min((_at(p) for p in ast.walk(function) if walk.does(p, verbs.takes)), default=None)
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
    verbs: Verbs
    caught: Set[tuple[int, int]]
    handled: int = 0
    kept: list[ast.stmt] = field(default_factory=list)
    finals: list[Sequence[ast.stmt]] = field(default_factory=list)

    def does(self, node: ast.AST, verbs: Set[str]) -> bool:
        """Whether ``node`` is ``lock.acquire()`` or ``lock.release()``."""
        return (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr in verbs
            and ast.unparse(node.func.value) == self.lock
        )

    def is_try(self, node: ast.AST) -> bool:
        """Whether it takes the lock in another way than by a statement of its own."""
        if not self.does(node, self.verbs.takes):
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
        return isinstance(first, ast.Expr) and self.does(first.value, self.verbs.gives)

    def _simple(self, node: ast.stmt, held: Held) -> Held:
        for part in ast.walk(node):
            if self.does(part, self.verbs.takes):
                held = frozenset({True})
            elif self.does(part, self.verbs.gives):
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
    wrappers = _wrappers(world)
    for function in world.called.values():
        node = function.node
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            caught = world.caught_raises.get(function.place.file, set())
            for call, lock, verbs in _taken_in(node, wrappers, world):
                for way in ways_that_keep(node, lock, verbs, caught):
                    world.diagnostics.append(_kept(function, call, lock, verbs, way))


def _taken_in(
    node: FunctionNode, wrappers: Mapping[str, Verbs], world: ConcurrentWorld
) -> Iterator[tuple[ast.Call, str, Verbs]]:
    """The locks that a function takes by a call, each once, with how they are taken."""
    reported: set[tuple[str, str]] = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Call) and isinstance(part.func, ast.Attribute):
            method, lock = part.func.attr, ast.unparse(part.func.value)
            verbs = wrappers.get(method)
            if verbs is None and method.startswith(_TAKES) and _is_lock(lock, world):
                verbs = own_verbs(method.removeprefix(_TAKES))
            if verbs is not None and (lock, method) not in reported:
                reported.add((lock, method))
                yield part, lock, verbs


def _is_lock(text: str, world: ConcurrentWorld) -> bool:
    locks = world.locks.get(text.rpartition('.')[2], [])
    return bool(locks) and not are_signals(world, locks)


def _wrappers(world: ConcurrentWorld) -> Mapping[str, Verbs]:
    """What takes the lock of its object, by the name of the method; no name with two meanings."""
    doing: dict[tuple[Value, str], dict[str, set[str]]] = {}
    meant: dict[str, set[tuple[Value, str] | None]] = {}
    for function in world.called.values():
        found = _done_alone(function, world)
        home = (function.owner, found[1]) if found is not None and function.owner else None
        meant.setdefault(function.name, set()).add(home)
        if found is not None and home is not None:
            doing.setdefault(home, {}).setdefault(found[0], set()).add(function.name)
    return {
        name: Verbs(frozenset(verbs[_TAKES]), frozenset(verbs[_GIVES]), home[1])
        for home, verbs in doing.items()
        if _TAKES in verbs and _GIVES in verbs
        for name in verbs[_TAKES]
        if meant[name] == {home}
    }


def _done_alone(function: Function, world: ConcurrentWorld) -> tuple[str, str] | None:
    """Whether a method takes one lock, always, or gives it back, and which one it is."""
    node = function.node
    if not isinstance(node, ast.FunctionDef):
        return None
    calls = [
        part
        for part in ast.walk(node)
        if isinstance(part, ast.Call)
        and isinstance(part.func, ast.Attribute)
        and part.func.attr in (_TAKES, _GIVES)
        and _is_lock(ast.unparse(part.func.value), world)
    ]
    found = {(call.func.attr, ast.unparse(call.func.value)) for call in calls}  # type: ignore[attr-defined]
    verb, lock = found.pop() if len(found) == 1 else ('', '')
    is_always = verb == _GIVES or (verb == _TAKES and _is_reached(calls[0], node))
    return (verb, lock) if is_always and lock.startswith('self.') else None


def _is_reached(call: ast.Call, node: ast.FunctionDef) -> bool:
    """Whether the function always comes to the call, which waits as long as it takes."""
    for statement in node.body:
        if any(part is call for part in ast.walk(statement)):
            is_plain = isinstance(statement, (ast.Expr, ast.Return, ast.Assign))
            return is_plain and not (call.args or call.keywords)
        if any(isinstance(part, (ast.Return, ast.Raise)) for part in ast.walk(statement)):
            return False
    return False


def _kept(
    function: Function, call: ast.Call, lock: str, verbs: Verbs, way: ast.stmt
) -> Diagnostic:
    file = function.place.file
    leaves = 'returns' if isinstance(way, ast.Return) else 'may end'
    if isinstance(way, ast.Raise):
        leaves = 'raises'
    taken = f'taken by {ast.unparse(call.func)}' if verbs.of else 'taken'
    kept = f'{lock}{verbs.of.removeprefix("self")}'
    way_out = f'write "with {lock}:", which gives it back however it is left'
    if verbs.of:
        way_out = f'call {lock}.{min(verbs.gives)} in a finally, or give the class a "with"'
    return Diagnostic(
        severity=Severity.ERROR,
        slug='lock-kept',
        place=Place(file, way.lineno, way.col_offset + 1),
        message=f'{function.name} {leaves} here and keeps {kept}, '
        f'{taken} at line {call.lineno}: the next one that takes it waits forever',
        help=way_out,
    )
