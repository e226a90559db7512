"""
Wakers that may be gone when code waits, or come before it does.

A timer that is cancelled or never started, a callback whose entity or node is destroyed, and what
runs once only, which a condition forgets if nothing waits yet. Sources: rclpy 7.1.6 and 9.1.2,
``node.py`` (``create_timer``), ``timer.py`` (``cancel``, ``reset``), ``executors.py``; CPython
3.12, ``threading.py`` (``Condition.notify``). Where another waker is left, nothing is said.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import (
    Notifier,
    is_heard,
)
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import (
    CANCEL,
    DESTROY,
    DESTROY_NODE,
    RAISES,
    REMOVE_NODE,
    SHUTDOWN,
    executor_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    End,
    EntityState,
    GroupState,
    RosWorld,
)
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.extract.static.units.wakers.operations import gives_one_of_several
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import POLLING_LOOP, WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import EntityKind, GroupType, When

Doer = EntityState | ActivityState
Names = Callable[[object], str | None]
RECURRING = (EntityKind.TIMER, EntityKind.SUBSCRIPTION, EntityKind.SERVICE)
_RISING = (
    EntityKind.TIMER,
    EntityKind.SUBSCRIPTION,
    EntityKind.SERVICE,
    EntityKind.DONE_CALLBACK,
    EntityKind.GUARD_CONDITION,
)
_ONCE = (EntityKind.DONE_CALLBACK, EntityKind.TASK, EntityKind.LIFECYCLE_SERVICE)
_DOES = {
    CANCEL: 'cancels the timer of {}, which ends it',
    DESTROY: 'destroys what calls {}, which ends it',
    DESTROY_NODE: 'destroys the node of {}, which ends it',
    REMOVE_NODE: 'takes the node of {}, which ends it, out of the executor',
}


def why_in_another_run(wait: Blocking, wakings: Sequence[Waking], doer: Doer) -> Unknown | None:
    """
    Why another run of ``doer`` itself may end its wait, or wait there too.

    It waits in one branch and ends waits in another one, and several of its runs go on at a time.
    """
    if isinstance(wait.resource, ResourceRef) and gives_one_of_several(wait.resource, wakings):
        reason = 'it asks for several things, which different code brings'
        return Unknown(reason, wait.source)
    if not isinstance(doer, EntityState) or not wait.conditional:
        return None
    group = doer.group.state
    is_serial = isinstance(group, GroupState) and group.type is GroupType.EXCLUSIVE
    own = next((w for w in wakings if w.by is doer and w.conditional), None)
    if own is None or is_serial:
        return None
    return Unknown('another run may end it, if it takes the other branch', own.place)


def why_gone(
    world: RosWorld, wakers: Sequence[object], is_harmless: Callable[[End], bool], name: Names
) -> Unknown | None:
    """
    Why none of ``wakers`` may be called any more.

    :param is_harmless: of an end that surely comes after the wait.
    """
    reasons = []
    for waker in wakers:
        why = _why_one_is_gone(world, waker, is_harmless, name)
        if why is None:
            return None
        reasons.append(why)
    return reasons[0] if reasons else None


def _why_one_is_gone(
    world: RosWorld, waker: object, is_harmless: Callable[[End], bool], name: Names
) -> Unknown | None:
    if isinstance(waker, ActivityState):
        return _why_thread_ends(world, waker, is_harmless, name)
    if not isinstance(waker, EntityState):
        return None
    its_name = name(waker) or 'a callback'
    if waker.dormant is not None and not waker.restarted:
        return Unknown(f'no known code starts the timer of {its_name}', waker.dormant)
    for end in world.ends:
        if _is_of(end, waker) and not _ends_all(end, world) and not is_harmless(end):
            doer = 'a thread' if isinstance(end.doer, ActivityState) else 'a callback'
            does = _DOES[end.kind].format(its_name)
            return Unknown(f'{name(end.doer) or doer} {does}', end.place)
    return None


def _why_thread_ends(
    world: RosWorld, thread: ActivityState, is_harmless: Callable[[End], bool], name: Names
) -> Unknown | None:
    """An error that nothing catches ends a thread whose loop others wait for."""
    calls = {block.call for block in thread.effects.blocking}
    if not thread.loops and calls.isdisjoint((WORKING_LOOP, POLLING_LOOP)):
        return None
    for end in world.ends:
        if end.kind == RAISES and end.doer is thread and not is_harmless(end):
            its_name = name(thread) or 'a thread'
            return Unknown(f'{its_name}, which ends it, may end by {end.text}', end.place)
    return None


def _why_raised(world: RosWorld, mine: Sequence[Waking], name: Names) -> Unknown | None:
    """Why all the threads that end a wait may have ended by an error before they come to it."""
    found = []
    for waking in mine:
        ends = (each for each in world.ends if _raises_before(each, waking, world))
        end = next(ends, None)
        if end is None:
            return None
        who = name(end.doer) or 'a thread'
        found.append(Unknown(f'{who}, which ends it, may end by {end.text}', end.place))
    return found[0] if found else None


def _raises_before(end: End, waking: Waking, world: RosWorld) -> bool:
    """Whether a thread raises in front of what it does, as far as the text shows."""
    is_its_own = end.kind == RAISES and end.doer is waking.by and waking.word is not Word.END
    if not is_its_own or not isinstance(waking.by, ActivityState):
        return False
    at, there = end.place, waking.place
    if at.file == there.file and at.line > there.line:
        return False
    trees = (tree for tree, file in world.files if file == there.file)
    tries = [each for tree in trees for each in noted_on(tree, 'tries', _tries)]
    # What a finally does is done in any case, unless the error comes before its try.
    around = [each for each in tries if any(_covers(part, there) for part in each.finalbody)]
    return not around or all(at.line < each.lineno for each in around if at.file == there.file)


def _tries(tree: ast.Module) -> list[ast.Try]:
    return [each for each in walk(tree) if isinstance(each, ast.Try) and each.finalbody]


def _covers(part: ast.stmt, place: Place) -> bool:
    return part.lineno <= place.line <= (part.end_lineno or part.lineno)


def _is_of(end: End, waker: EntityState) -> bool:
    is_its_own = end.what is waker and waker.when is not When.CALLBACK  # else made again
    if end.kind == CANCEL:
        return is_its_own and not waker.restarted
    if end.kind == DESTROY:
        return is_its_own
    return end.kind in (DESTROY_NODE, REMOVE_NODE) and end.what is waker.node


def _ends_all(end: End, world: RosWorld) -> bool:
    """Whether its doer shuts rclpy down as well."""
    return any(other.doer is end.doer and other.kind == SHUTDOWN for other in world.ends)


def why_not_there(
    world: RosWorld, mine: Sequence[Waking], doer: Doer, name: Names
) -> Unknown | None:
    """Why the threads that end a wait may not have been started, or have failed by then."""
    return _why_tested(mine, doer, name) or _why_raised(world, mine, name)


def _why_tested(mine: Sequence[Waking], doer: Doer, name: Names) -> Unknown | None:
    """
    Why data decides whether the threads that end a wait have been started.

    A callback starts them, and writes what ``doer`` has read: ``if self.worker is None: return``.
    """
    read = {access.name for access in doer.effects.reads} if doer.effects else set()
    found: Unknown | None = None
    for waking in mine:
        is_end = waking.word is Word.END
        starts = waking.by.starts if isinstance(waking.by, ActivityState) and not is_end else []
        if not starts or any(start.by is doer and not start.conditional for start in starts):
            return None
        for start in starts:
            if not isinstance(start.by, EntityState):
                return None
            tested = sorted(read & _written_by(start.by))
            if tested and found is None:
                reason = f'{tested[0]} says whether {name(start.by)} has started its thread'
                found = Unknown(reason, start.place)
    return found


def why_unspun(
    world: RosWorld, wakers: Sequence[object], doer: object, name: Names
) -> Unknown | None:
    """
    Why the thread that would run all of ``wakers`` may have ended while another thread waits.

    What a callback raises rises out of the spin (measured with rclpy 7.1.6 and 9.1.2, on one
    thread and on a pool; ``SystemExit`` on one thread alone), and ends the thread that spins.
    """
    if not isinstance(doer, ActivityState) or not wakers:
        return None
    served = [waker.node for waker in wakers if isinstance(waker, EntityState)]
    executors = {id(executor): executor for executor in map(executor_of, served)}
    executor = next(iter(executors.values()), None)
    if len(served) != len(wakers) or len(executors) != 1 or executor is None:
        return None
    spins = [spin for spin in world.spins.values() if spin.executor is executor]
    if not spins or any(spin.is_tried or not spin.in_thread for spin in spins):
        return None
    for end in world.ends:
        if end.kind == RAISES and _rises(end, executor):
            who = name(end.doer) or 'a callback'
            reason = f'{who} raises {end.text}, which ends the thread that spins'
            return Unknown(reason, end.place)
    return None


def _rises(end: End, executor: Instance) -> bool:
    doer = end.doer
    if not isinstance(doer, EntityState) or doer.kind not in _RISING:
        return False
    is_exit = end.text in ('SystemExit', 'ExternalShutdownException')
    is_single = executor.state.kind == 'SingleThreadedExecutor'
    return executor_of(doer.node) is executor and (is_single or not is_exit)


def why_lost(
    world: RosWorld,
    reference: ResourceRef,
    mine: Sequence[Waking],
    doer: Doer,
    doers: Sequence[Doer],
    name: Names,
) -> Unknown | None:
    """
    Why what ends a wait, which comes once only, may come before the wait.

    What a condition forgets is the model's to say, see ``forgets``.
    """
    if not mine or not all(_comes_once(waking, doer) for waking in mine):
        return None
    when = _when_lost(world, reference, mine, doer, doers)
    if when is None:
        return None
    first = mine[0]
    who = name(first.by) or 'a callback'
    return Unknown(f'{who}, which ends it, runs once only, and perhaps {when}', first.place)


def _when_lost(
    world: RosWorld,
    reference: ResourceRef,
    mine: Sequence[Waking],
    doer: Doer,
    doers: Sequence[Doer],
) -> str | None:
    if reference.is_kept:
        clears = world.cleared.get(reference.number, {})
        is_wiped_out = any(not _is_before(clear, each, mine) for clear, each in clears.items())
        return 'before it is cleared' if is_wiped_out else None
    guard = reference.guard
    if guard is None:
        return None
    notifiers = [notifier_of(waking) for waking in mine]
    if not is_heard(guard, notifiers):
        return 'before anybody waits'
    wakers = [waking.by for waking in mine]
    others = (each for each in doers if each not in wakers)
    names = guard.names.intersection(*(each.wrote for each in notifiers))
    taken_back = any(names & _written_by(other) for other in others)
    return 'its signal is undone' if taken_back and _comes_again(world, doer) else None


def _is_before(clear: tuple[object, Place], entities: int, mine: Sequence[Waking]) -> bool:
    """Whether code that clears an event asks only after that for what sets it."""
    by, _ = clear
    asked = [_asked_first(each.by) if isinstance(each.by, EntityState) else None for each in mine]
    return all(
        each is not None
        and each.kind is EntityKind.DONE_CALLBACK
        and each.maker is by
        and each.number >= entities
        for each in asked
    )


def _asked_first(by: EntityState) -> EntityState:
    """The first of done-callbacks that each ask for the next one, as for a goal and its result."""
    seen = {id(by)}
    while (
        isinstance(by.maker, EntityState)
        and by.kind is by.maker.kind is EntityKind.DONE_CALLBACK
        and id(by.maker) not in seen
    ):
        by = by.maker
        seen.add(id(by))
    return by


def notifier_of(waking: Waking) -> Notifier:
    """The code that notifies, with what it writes."""
    by = waking.by
    if not isinstance(by, (EntityState, ActivityState)):
        return Notifier(waking, None, frozenset(), {})
    stored = by.effects.stored if by.effects is not None else {}
    return Notifier(waking, by.place, _written_by(by), stored)


def _written_by(doer: Doer) -> frozenset[str]:
    return (
        frozenset(access.name for access in doer.effects.writes) if doer.effects else frozenset()
    )


def forgets(reference: ResourceRef, mine: Sequence[Waking], doer: Doer) -> bool:
    """
    Whether a wait misses what comes before it, where the model has the coming of some wakers.

    It has what comes by itself again and again, and what comes once; of the others nobody says
    whether they come in time, see ``is_unheard``.
    """
    guard = reference.guard
    if guard is None or not any(_is_modelled(waking, doer) for waking in mine):
        return False
    return not is_heard(guard, [notifier_of(waking) for waking in mine])


def is_unheard(waking: Waking, doer: Doer) -> bool:
    """Whether a waker of a wait that ``forgets`` perhaps comes while nothing waits."""
    return not _is_modelled(waking, doer)


def _is_modelled(waking: Waking, doer: Doer) -> bool:
    by = waking.by
    if waking.repeats or waking.conditional:
        return False
    if isinstance(by, EntityState):
        return by.kind in RECURRING and (by.when is not When.CALLBACK or by.maker is doer)
    return _comes_once(waking, doer)


def _comes_once(waking: Waking, doer: Doer) -> bool:
    """Whether it comes once, or once for each time that ``doer`` itself begins it."""
    by = waking.by
    if isinstance(by, EntityState):
        is_asked_for = by.kind is EntityKind.DONE_CALLBACK and _asked_first(by).maker is doer
        return is_asked_for or (by.one_shot and not by.restarted)
    if not isinstance(by, ActivityState) or by.loops or waking.repeats:
        return False
    return by.count == 1 or all(start.by is doer for start in by.starts)


def _comes_again(world: RosWorld, doer: Doer) -> bool:
    """Whether it surely runs more than once, as long as the program does."""
    if isinstance(doer, ActivityState):
        return doer.loops
    is_plain = not doer.one_shot and not doer.destroyed and doer.kind not in _ONCE
    return is_plain and not any(e.doer is doer and e.kind != RAISES for e in world.ends)


def unless_cancelled(wait: Blocking, doer: object, world: RosWorld) -> Blocking:
    """To cancel a task of a loop ends what it awaits; the model does not have that."""
    place = None
    if isinstance(doer, EntityState) and doer.kind is EntityKind.TASK:
        place = world.cancelled.get(doer.place)
    if place is None or not wait.suspends or wait.is_timed or wait.escapes is not None:
        return wait
    return replace(wait, escapes=Unknown('its task may be cancelled', place))
