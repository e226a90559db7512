"""
Whether a wait has begun already when a condition is notified.

A condition forgets a ``notify`` that comes while nothing waits (CPython 3.12, ``threading.py``,
``Condition.notify``). It reaches code that has asked, in the same hold of the lock, for what the
notifier writes, or has begun in that hold what notifies: that cannot go on before the wait.
"""

from __future__ import annotations

import ast
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses.held_locks import lock_of, locks_named
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import Guard, Waking
from ros2cc_extract.extract.static.python.machine.dependences import Asked
from ros2cc_extract.extract.static.python.machine.recorded_effects import Hold
from ros2cc_extract.extract.static.python.machine.world import note_once
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import FLAG, Act

CONDITION_WAITS = frozenset({'Condition.wait', 'Condition.wait_for'})
# They answer from what they are given, or for the whole program.
_PLAIN = frozenset({'ok', 'len', 'bool', 'any', 'all', 'isinstance'})


def holds_of(world: ConcurrentWorld) -> frozenset[Hold]:
    """The locks that are held, each with the number of that hold."""
    return frozenset((name, world.holds.get(name, 0)) for name in world.held)


def begin_hold(world: ConcurrentWorld, name: str) -> None:
    """A lock is taken, or taken again."""
    world.takes[name] += 1
    world.holds = {**world.holds, name: world.takes[name]}


def note_test(
    world: ConcurrentWorld,
    test: ast.expr,
    place: Place,
    found: frozenset[str],
    *,
    repeats: bool = False,
) -> Asked:
    """A branch, or a loop that ``repeats``, rests on what was ``found`` to be read for it."""
    rests_on_more = may_rest_on_more(test)
    is_open = (repeats and bool(found)) or rests_on_more
    until = found if repeats and not rests_on_more else frozenset[str]()
    before = world.reading.asked.get(place)
    several = asks_for_several(test, wanted=False)
    asked = Asked(found, holds_of(world), is_open, until, several)
    if before is not None and before.holds == asked.holds:
        is_open, until = before.is_open or is_open, (before.until | until if until else until)
        asked = Asked(before.names | found, before.holds, is_open, until, several)
    world.reading.asked[place] = asked
    return asked


def may_rest_on_more(test: ast.expr) -> bool:
    """Whether an answer may rest on more than attributes of known objects: calls, own names."""
    owners = {id(part.value) for part in ast.walk(test) if isinstance(part, ast.Attribute)}
    asked = {id(part.func) for part in ast.walk(test) if isinstance(part, ast.Call)}
    return any(
        (isinstance(part, ast.Call) and _name_of(part.func) not in _PLAIN)
        or isinstance(part, ast.Await)
        or (isinstance(part, ast.Attribute) and id(part) in owners)
        or (isinstance(part, ast.Name) and id(part) not in owners | asked)
        for part in ast.walk(test)
    )


def asks_for_several(test: ast.expr, *, wanted: bool) -> bool:
    """Whether several things must come before a test has the result that is wanted."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return asks_for_several(test.operand, wanted=not wanted)
    if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And) is wanted:
        return True
    if isinstance(test, ast.BoolOp):
        return any(asks_for_several(each, wanted=wanted) for each in test.values)
    return isinstance(test, ast.Call) and _name_of(test.func) == ('all' if wanted else 'any')


def _name_of(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')


def note_begun(world: ConcurrentWorld, place: Place) -> None:
    """What is made or started at ``place`` begins no sooner than here."""
    for hold in holds_of(world):
        world.begun.setdefault(hold, set()).add(place)


def note_made(world: ConcurrentWorld, kind: str, place: Place) -> None:
    """
    Note that the running code makes an entity at ``place``, or the same one once more.

    With it stand the flags that this code has found down and put up.
    """
    if world.effects is None:
        return
    made = world.effects.changes
    flags = tuple(held for held in world.held if held.endswith(FLAG))
    once = Act(name=kind, source=place, chain=world.chain[1:], held=flags)
    again = replace(once, repeats=True)
    if again in made:
        return
    if not world.effects.loops and not world.open_loops:
        note_once(made, once)
    elif once in made:
        made[made.index(once)] = again
    else:
        made.append(again)


def guard_of(world: ConcurrentWorld, condition: Instance) -> Guard:
    """What a wait for ``condition`` rests on; it gives the lock back meanwhile."""
    lock = lock_of(condition)
    name = next(
        (n for n in world.held if any(each is lock for each, _ in locks_named(n, world))), None
    )
    if name is None:
        # Other code has taken it, in a way that was not followed.
        return Guard(None, frozenset(), is_open=True)
    hold = name, world.holds.get(name, 0)
    reading = world.reading
    tests = [reading.asked[place] for place, _ in world.path if place in reading.asked]
    asked = [each for each in (*tests, *reading.loops) if hold in each.holds]
    begun = frozenset(world.begun.get(hold, ()))
    begin_hold(world, name)
    names = frozenset[str]().union(*(each.names for each in asked))
    loops = [each.until for each in reading.loops if hold in each.holds]
    until = frozenset[str]().union(*loops) if all(loops) else frozenset[str]()
    several = any(each.is_of_several for each in reading.loops if hold in each.holds)
    return Guard(hold, names, any(each.is_open for each in asked), begun, until, several)


@dataclass(frozen=True)
class Notifier:
    """
    The code that notifies a condition, and what it writes.

    :param place: where its thread is started, or its entity made.
    :param wrote: names of all that it writes.
    :param stored: the same by the holds in which it does.
    """

    waking: Waking
    place: Place | None
    wrote: frozenset[str]
    stored: dict[Hold, set[str]]


def is_heard(guard: Guard, notifiers: list[Notifier]) -> bool:
    """Whether what ends the wait cannot be lost before it, or that is unknown."""
    begun = (each for each in notifiers if not each.waking.conditional)
    if guard.hold is None or any(each.place in guard.begun for each in begun):
        return True
    if any(guard.names & _written_by(each, guard.hold[0]) for each in notifiers):
        return True
    if any(guard.names & each.wrote for each in notifiers):
        return False
    return guard.is_open


def _written_by(notifier: Notifier, lock: str) -> frozenset[str]:
    """What it has written by then, and in the same hold of the lock of the condition."""
    holds = (hold for hold in notifier.waking.holds if hold[0] == lock)
    return notifier.waking.written.union(*(notifier.stored.get(hold, ()) for hold in holds))
