"""
Threads that the set-up joins while nothing serves the code that would end their waits.

At the end of many programs a flag is cleared and the thread is joined that asks for it; but the
thread stands in a wait that only callbacks end, and the spin that served them is over.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import (
    ActivityState,
    OutsideWait,
    Over,
)
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    DataRef,
    EntityRef,
    ResourceRef,
    Waking,
)
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import (
    ANSWERS,
    JOIN,
    RATE,
    come_behind,
    in_words,
)
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
    uncalled_wakers,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld, Spin
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.python.values.exclusive_paths import is_behind
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Function,
    Instance,
    options_of,
)
from ros2cc_extract.extract.static.units.whole_program.threads_until_shutdown import (
    ends_by_time,
    spins_until_one_ends,
)
from ros2cc_extract.spec.effects import POLLING_LOOP, WORKING_LOOP, Act, Blocking
from ros2cc_extract.spec.model import EntityKind


def is_over(spin: Spin, number: int, wait: OutsideWait, world: RosWorld) -> bool:
    """Whether ``spin``, the one of that number, has ended for sure before the wait."""
    return any(_ends(over, spin, number, world) for over in _certain(wait))


def _certain(wait: OutsideWait) -> list[Over]:
    return [over for over in wait.over if is_behind(over.path, wait.path)]


def _ends(over: Over, spin: Spin, number: int, world: RosWorld) -> bool:
    if number >= over.spins:
        return False
    if over.what is None or over.what is spin.executor:
        return True
    doers = (each for each in world.activities if over.what in each.runners)
    return any(doer.thread == spin.thread for doer in doers)


def never_joined(
    wait: OutsideWait, world: RosWorld, spun: Sequence[Instance]
) -> Iterator[Diagnostic]:
    """
    The waits of a joined thread that nothing ends that is still there.

    :param spun: the nodes that other threads spin meanwhile.
    """
    for state in () if spins_until_one_ends(world) else world.activities:
        if not any(wait.client is runner for runner in state.runners):
            continue
        if state.serves:
            yield from (_idle(wait, spin) for spin in _resting(state, wait, world))
            continue
        taken = next((act for act in state.effects.locks if act.name in wait.held), None)
        if taken is not None and not taken.tries and not wait.in_thread:
            yield _lock_kept(wait, taken)
            return
        around = [b for b in state.effects.blocking if b.call in (WORKING_LOOP, POLLING_LOOP)]
        loops = {b.call for b in around}
        for block in state.effects.blocking:
            # A loop that does nothing but sleep is one that polls.
            goes_round = WORKING_LOOP in loops or (loops and block.call == RATE)
            asks_again = block.call in ANSWERS and way_of(block) in state.effects.looped
            goes_round = goes_round or asks_again or comes_back(block, state, world)
            # Code after its only loop is after what it asks in that.
            passed = (block, *around) if asks_again and len(around) == 1 else (block,)
            was_reported = any(is_reported(each, state, wait, world) for each in passed)
            goes_round = goes_round and not was_reported
            why = why_for_ever(block, state, wait, world, spun)
            is_sure = goes_round or not (wait.is_late or block.conditional)
            if why is not None and (is_sure or why.startswith(BEHIND)):
                yield _diagnostic(wait, block, why)
                return


def is_reported(block: Blocking, state: ActivityState, wait: OutsideWait, world: RosWorld) -> bool:
    """
    Whether the thread was behind the wait ``block`` by then, for good.

    So it is where the program has waited before for what only this thread ends, outside
    its loops and behind ``block``, as for a future that it makes done at its end.
    """
    behind = [way_of(each) for each in state.effects.blocking]
    at = behind.index(way_of(block))

    def comes_later(waking: Waking) -> bool:
        is_once = waking.by is state and not (waking.in_loop or waking.repeats or state.loops)
        return is_once and waking.behind in behind and behind.index(waking.behind) >= at

    known = (world.wakings.get(id(thing), ()) for thing in _awaited_before(wait, world))
    ends = ([w for w in wakings if w.word in (Word.SET, Word.DONE)] for wakings in known)
    return any(wakings and all(map(comes_later, wakings)) for wakings in ends)


def _awaited_before(wait: OutsideWait, world: RosWorld) -> Iterator[Instance]:
    """What the program has waited for on its way to ``wait`` on every branch."""
    before = world.outside.index(wait) if wait in world.outside else None
    for each in world.outside[:before]:
        is_before = each.call != JOIN and not each.in_thread and not wait.in_thread
        is_sure = wait.path[: len(each.path)] == each.path
        thing = each.client
        if is_before and is_sure and isinstance(thing, Instance) and id(thing) not in world.given:
            yield thing


def comes_back(block: Blocking, state: ActivityState, world: RosWorld) -> bool:
    """
    Whether the thread stands in the wait again when it has been woken.

    One that may leave its loop is taken to stay where nothing that is put looks like a sign.
    """
    if state.loops:
        return True
    resource = block.resource
    is_queue = isinstance(resource, ResourceRef) and resource.ended_by == {Word.PUT}
    is_in_loop = way_of(block) in state.effects.looped
    return is_queue and is_in_loop and _leaves(state) and not may_leave(block, state, world)


def may_leave(block: Blocking, state: ActivityState, world: RosWorld) -> bool:
    """Whether the thread may end for something that it takes, as it looks like a sign to do so."""
    resource = block.resource
    wakings = world.wakings.get(resource.number, ()) if isinstance(resource, ResourceRef) else ()
    return _leaves(state) and any(w.is_sign for w in wakings if w.word is Word.PUT)


def why_for_ever(
    block: Blocking,
    state: ActivityState,
    wait: OutsideWait,
    world: RosWorld,
    spun: Sequence[Instance],
) -> str | None:
    """Why nothing ends the wait ``block`` of the thread; ``None`` if something may."""
    if block.seconds is not None:
        return None
    if block.call == RATE:
        return _why_asleep(block, wait, world)
    asked = _asked(block, world)
    if asked is not None and wait.is_late:  # before the spin see ``unserved_threads``
        return None if any(asked.node is each for each in spun) else NOT_SPUN
    resource = block.resource
    if isinstance(resource, DataRef) and wait.is_late:
        is_for_good = block.call == WORKING_LOOP and resource.minds_nothing
        is_written = _is_written(resource, wait, world)
        return NEVER_CLEARED if is_for_good and not is_written else None
    if not isinstance(resource, ResourceRef) or resource.asked:
        return None
    ending = [w for w in world.wakings.get(resource.number, ()) if w.word in resource.ended_by]
    mine = [w for w in ending if not come_behind([w.ended], [wait.client])]
    served = [w.by.node for w in mine if isinstance(w.by, EntityState)]
    others = [w for w in mine if not isinstance(w.by, EntityState)]
    is_open = resource.number in world.given or uncalled_wakers(
        world, str(resource), resource.ended_by, resource.made
    )
    if ending and not mine and not is_open:
        return f'{BEHIND} ({ending[0].place})'
    if is_open or not mine or any(node is each for node in served for each in spun):
        return None
    is_spent = others and not served and _are_spent(others, state)
    if is_spent and wait.is_late and not may_leave(block, state, world):
        return _SPENT
    if others and not _have_given(others, state, wait):
        return None
    return NOT_SPUN if served else 'and the thread that would end that has ended'


def _is_written(data: DataRef, wait: OutsideWait, world: RosWorld) -> bool:
    """Whether anybody writes what the loop looks at, but for the set-up before or behind."""
    if data_is_written_elsewhere(world, data.names) is not None:
        return True
    written = [world.main_writes[name] for name in data.names if name in world.main_writes]
    if any(not come_behind(ended, [wait.client]) for ended in written):
        return True
    logs = [each.effects or EffectLog() for each in (*world.entities, *world.activities)]
    return any(write.name in data.names for log in logs for write in log.writes)


def _asked(block: Blocking, world: RosWorld) -> EntityState | None:
    """The client that must take the answer which the thread waits for."""
    on = block.on
    if block.call not in ANSWERS or not isinstance(on, EntityRef) or block.escapes is not None:
        return None
    clients = (each for each in world.entities if id(each) == on.number)
    return next((each for each in clients if not each.destroyed), None)


def _why_asleep(block: Blocking, wait: OutsideWait, world: RosWorld) -> str | None:
    """A rate wakes by a timer of its node, and where rclpy is shut down, which a signal does."""
    on = block.on
    timer = next(
        (e for e in world.entities if isinstance(on, EntityRef) and id(e) == on.number), None
    )
    if timer is None or timer.destroyed or id(timer) in world.given:
        return None
    if any(over.what is None for over in wait.over):
        return None
    stopped = [over.what for over in _certain(wait) if isinstance(over.what, Instance)]
    serving = [spin for spin in world.spins.values() if _serves(spin, timer.node)]
    is_stopped = all(
        _waits_itself(s, wait, world) or any(s.executor is each for each in stopped)
        for s in serving
    )
    return NOT_SPUN if serving and is_stopped else None


def _waits_itself(spin: Spin, wait: OutsideWait, world: RosWorld) -> bool:
    """Whether the spinning thread is the one that waits, and its spin ends before rclpy does."""
    is_main = not spin.in_thread and not spin.from_callback and not wait.in_thread
    return is_main and ends_by_time(spin, world)


def _serves(spin: Spin, node: Instance) -> bool:
    entries = spin.executor.slots.get('__nodes__', ())
    has = (option for entry in entries for option in options_of(entry))
    return any(each is node for each in (*spin.nodes, *has))


def _have_given(wakings: Sequence[Waking], taker: ActivityState, wait: OutsideWait) -> bool:
    """
    Whether the givers are over, and what they gave last need not be for the end.

    So it is where both are ended by what their loops ask for: one that leaves its loop by itself
    may do so for an item, or put one first that says so.
    """
    over = [each.what for each in _certain(wait)]
    if not all(w.in_loop and isinstance(w.by, ActivityState) for w in wakings):
        return False
    givers = {w.by for w in wakings if isinstance(w.by, ActivityState)}
    is_one = len({w.place for w in wakings}) == len(givers)
    are_over = all(giver.runners and all(r in over for r in giver.runners) for giver in givers)
    return is_one and are_over and not any(map(_leaves, (*givers, taker)))


def _are_spent(wakings: Sequence[Waking], taker: ActivityState) -> bool:
    """Whether other threads give a known number of times, each once started."""
    givers = [w.by for w in wakings if isinstance(w.by, ActivityState) and not w.in_loop]
    if len(givers) < len(wakings) or any(w.word is not Word.PUT for w in wakings):
        return False
    return all(_runs_once(giver) and giver is not taker for giver in givers)


def _runs_once(state: ActivityState) -> bool:
    is_one = state.count == 1 and len(state.starts) == 1 and state.starts[0].by is None
    return is_one and not (state.loops or state.overlaps or state.serves or state.on_loop)


def _leaves(state: ActivityState) -> bool:
    """Whether its text has another end than that of its loop, or is not known."""
    target = state.target
    function = target.function if isinstance(target, Bound) else target
    if not isinstance(function, Function):
        return True
    return any(map(_is_way_out, ast.walk(function.node)))


def _is_way_out(part: ast.AST) -> bool:
    """A loop is left, or goes over ``iter(function, sentinel)`` and ends at the sentinel."""
    if isinstance(part, ast.For) and isinstance(part.iter, ast.Call):
        return getattr(part.iter.func, 'id', '') == 'iter' and len(part.iter.args) == 2
    return isinstance(part, (ast.Break, ast.Return))


_SPENT = 'and the thread that would end that gives no more by then'
BEHIND = 'and what would end that comes behind the join'
NEVER_CLEARED = 'and nobody ever writes that'
NOT_SPUN = 'and nothing spins the node whose callback would end that'


def _diagnostic(wait: OutsideWait, block: Blocking, why: str) -> Diagnostic:
    at = f' ({block.source})' if block.source is not None else ''
    when = '' if why != NOT_SPUN else ' any more' if wait.is_late else ' meanwhile'
    may = 'it may wait' if wait.is_late else 'it waits'
    awaited = 'a timer' if block.call == RATE else block.resource or 'an answer'
    return Diagnostic(
        severity=Severity.WARNING if wait.is_late else Severity.ERROR,
        slug='nobody-spins',
        place=wait.place,
        message=f'{JOIN} waits for a thread that waits in {in_words(block.call)} for '
        f'{awaited}{at}, {why}{when}: {may} forever',
        help=_help(wait, block),
    )


def _resting(state: ActivityState, wait: OutsideWait, world: RosWorld) -> Iterator[Spin]:
    """Where it may rest for ever: a step without a time-out, of nodes that have no timer."""
    if wait.in_thread or any(over.what is None for over in wait.over):
        return
    for number, spin in enumerate(world.spins.values()):
        is_step = spin.by is state and spin.timeout is None and spin.how.endswith('spin_once')
        if is_step and not is_over(spin, number, wait, world):
            timers = [each for each in world.entities if each.kind is EntityKind.TIMER]
            if not any(_serves(spin, timer.node) for timer in timers):
                yield spin
                return


def _idle(wait: OutsideWait, spin: Spin) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=wait.place,
        message=f'{JOIN} waits for a thread that waits in {spin.how} without a time-out '
        f'({spin.place}) until something arrives: it may wait forever',
        help='give the spin a time-out, so that the thread asks again whether to stop; or shut '
        'the executor down before the join',
    )


def _lock_kept(wait: OutsideWait, taken: Act) -> Diagnostic:
    at = f' ({taken.source})' if taken.source is not None else ''
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=wait.place,
        message=f'{JOIN} waits for a thread that takes {taken.name}{at}, which is held here '
        'meanwhile: it may wait forever',
        help=f'give {taken.name} back before the join',
    )


def _help(wait: OutsideWait, block: Blocking) -> str:
    if block.call == RATE:
        return 'join it while the executor is still spun, and shut that down behind'
    if not wait.is_late:
        return 'join it after the spin, and wake it before'
    if block.call in ANSWERS:
        return 'join it while the node is still spun, or wait for the answer with a time-out'
    return (
        'wake the thread before you join it: by a last item, by a notify after its flag has '
        'changed; or give its wait a time-out'
    )
