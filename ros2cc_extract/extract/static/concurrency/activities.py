"""
Threads of the program's own, and the main program beside a thread that spins.

What such code sets up is followed where it is started; what it does beside the callbacks is
followed once more after the set-up, as callbacks are, when it has met all that the set-up makes.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.accesses import kept_threads
from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import note_begun
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import Waking
from ros2cc_extract.extract.static.python.machine.machine import THING_STEPS
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.values.exclusive_paths import is_behind
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Const,
    Function,
    Instance,
    Native,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import ActivityKind, When


def run_in_thread(machine: ConcurrentMachine, target: Value, call: Call) -> None:
    """Follow what another thread sets up; it holds no lock of ours and is no callback."""
    world = machine.world
    if world.second_pass:
        return
    saved = (world.in_thread, world.effects, world.held, world.after_spin, world.count)
    path, chain, thread = world.path, world.chain, world.thread
    loops, ready, holds = (world.times, world.round), world.ready, world.holds
    (caught, world.caught), (loop, world.loop) = (world.caught, ()), (world.loop, None)
    (task, world.loop_task), by_loop = (world.loop_task, None), world.by_loop
    depth, world.thread_depth = world.thread_depth, len(machine.stack)
    if not (isinstance(world.activity, ActivityState) and world.activity.on_loop):
        world.by_loop = False
    world.threads += 1
    world.thread = world.threads
    world.in_thread, world.effects, world.held, world.chain = True, None, (), ()
    world.times, world.round = 1, ()
    world.ready = frozenset()
    try:
        result = machine.call(target, call)
        machine.run_if_coroutine(result, call.place)
    finally:
        world.in_thread, world.effects, world.held, world.after_spin, world.count = saved
        world.stopped = False
        world.path, world.chain, world.thread = path, chain, thread
        (world.times, world.round), world.holds = loops, holds
        world.ready, world.caught, world.loop = ready, caught, loop
        world.loop_task, world.by_loop, world.thread_depth = task, by_loop, depth


def begin(
    machine: ConcurrentMachine,
    kind: ActivityKind,
    target: Value | None,
    call: Call,
    runner: Value | None = None,
    *,
    daemon: bool | None = False,
    on_loop: object = None,
    turns: object = None,
    pool: Instance | None = None,
) -> None:
    """
    Start an activity.

    :param runner: the thread or future that stands for it.
    :param on_loop: what is equal for all that the loop runs which runs it.
    :param turns: as of an ``ActivityState``, and ``pool`` too.
    """
    world = machine.world
    known, site = _known(world, call.place, _code_of(target, call, given=True))
    if known is None and _are_many(world, call.place):
        known, site = _known(world, call.place, _code_of(target, call, given=False))
    state = known or ActivityState(
        kind, call.place, target, call, daemon=bool(daemon), site=site, turns=turns
    )
    state.is_daemon, state.pool = daemon, pool
    is_met_again = world.again or runner in state.runners
    kept_threads.note_begun(world, state, runner)
    _note_start(machine, state, runner)
    note_begun(world, call.place)
    if known is not None:
        _note_again(world, known)
        known.count = known.count if is_met_again else _more(known)
        known.overlaps = known.overlaps or not (is_met_again or _are_over(world, known, runner))
        return
    machine.charge(THING_STEPS)
    state.path, state.count = world.path, _count(world, call.place)
    state.thread, state.on_loop = world.threads + 1, on_loop is not None
    state.loop = on_loop
    state.spins = world.main_spins
    world.activities.append(state)
    outer, world.activity = world.activity, state
    try:
        for option in options_of(target) if target is not None else ():
            run_in_thread(machine, option, call)
        if state.is_executor:  # it is not followed once more
            for thing, word, place, item in state.wakes:
                machine.note_wake(thing, word, place, item)
    finally:
        world.activity = outer
    if state.serves:
        _go_on_beside(machine, call.place)


def _note_again(world: ConcurrentWorld, known: ActivityState) -> None:
    """
    Note that it starts itself anew, and what leads there from its own function.

    Only where it is followed beside the callbacks are tests open on what others change.
    """
    is_sure = world.second_pass and known is world.activity and world.path == known.path
    if is_sure and known.again is None:
        known.again = world.chain[1] if len(world.chain) > 1 else known.place


def _own_text(world: ConcurrentWorld, text: object) -> ActivityState | None:
    """That one which starts itself anew, itself or by others."""
    each: object = world.activity
    while isinstance(each, ActivityState):
        if isinstance(each.site, tuple) and each.site[0] == text:
            return each
        each = each.starts[0].by if each.starts else None
    return None


def _are_over(world: ConcurrentWorld, known: ActivityState, runner: Value | None) -> bool:
    """Whether the program has waited for all that were started before."""
    over = {id(each.what) for each in world.over if is_behind(each.path, world.path)}
    return all(id(each) in over for each in known.runners if each is not runner)


def _more(known: ActivityState) -> int | Unknown:
    return known.count + 1 if isinstance(known.count, int) else known.count


def _count(world: ConcurrentWorld, place: Place) -> int | Unknown:
    if world.when is not When.CALLBACK or world.activity is not None:
        return world.count
    return Unknown('started each time the callback runs', place)


def _note_start(machine: ConcurrentMachine, state: ActivityState, runner: Value | None) -> None:
    world = machine.world
    doer = world.activity or world.current
    behind = world.effects.behind if world.effects is not None else None
    conditional = bool(doer) and world.path != world.callback_path
    place = state.place
    start = Waking(Word.SET, doer, place, behind, conditional)
    met = [n for n, each in enumerate(state.starts) if each.by is doer and each.place == place]
    if not met:
        state.starts.append(start)
    elif world.second_pass and conditional:
        state.starts[met[0]] = start  # by what the set-up left, the test had one result
    if runner is not None and runner not in state.runners:
        state.runners.append(runner)
        world.kept.append(runner)
        world.wakings.setdefault(id(runner), []).append(Waking(Word.END, state, place))


def _go_on_beside(machine: ConcurrentMachine, place: Place) -> None:
    """From here on the main program runs beside an executor that a thread of its own spins."""
    world = machine.world
    is_main = world.current is None and world.activity is None and world.effects is None
    if not is_main or world.when is not When.START or world.after_spin or not world.is_program:
        return
    state = ActivityState(ActivityKind.MAIN, place, path=world.path)
    world.activities.append(state)
    world.activity, world.effects, world.callback_path = state, state.effects, world.path


def spins(world: ConcurrentWorld, *, for_ever: bool) -> None:
    """The code that is followed spins an executor from here on."""
    activity = world.activity
    if activity is None:
        return
    activity.serves = True
    activity.is_executor = activity.is_executor or for_ever
    if for_ever and activity.kind is ActivityKind.MAIN:
        world.activity = world.effects = None


def _known(
    world: ConcurrentWorld, place: Place, code: object
) -> tuple[ActivityState | None, object]:
    """The activity that runs ``code`` and is started there, if it is met again; its site."""
    text = (place, code)
    site = (text, world.chain, id(world.activity or world.current))
    known = _own_text(world, text) or next((e for e in world.activities if e.site == site), None)
    return known, site


def _are_many(world: ConcurrentWorld, place: Place) -> bool:
    """Whether so many threads are started there that they are not told apart by what they get."""
    return sum(state.place == place for state in world.activities) >= _APART


def _code_of(target: Value | None, call: Call, *, given: bool) -> object:
    """
    Equal for what runs one text on one object, for the same objects and functions.

    :param given: constants that it is given count too, as keys of what each uses.
    """
    values = (option for v in (*call.args, *call.keywords.values()) for option in options_of(v))
    kinds = (Instance, Const, *_CODE) if given else (Instance, *_CODE)
    arguments = tuple(_text_of(v) for v in values if isinstance(v, kinds))
    return tuple(_text_of(option) for option in options_of(target or NONE)), arguments


_CODE = (Bound, Function, Partial)
_APART = 4


def _text_of(target: Value) -> object:
    if isinstance(target, Const):
        return target
    if isinstance(target, Partial):
        return _text_of(target.function)
    if isinstance(target, Bound):
        return id(target.receiver), id(target.function.node)
    if isinstance(target, Native):
        return target
    return id(target.node) if isinstance(target, Function) else id(target)


def followed(world: ConcurrentWorld) -> Iterator[ActivityState]:
    """Those that have not been followed for what they do."""
    while world.followed_count < len(world.activities):
        state = world.activities[world.followed_count]
        world.followed_count += 1
        if state.kind is not ActivityKind.MAIN and not state.is_executor:
            yield state


def begin_second_pass(world: ConcurrentWorld, state: ActivityState) -> None:
    """What is followed from here on is what ``state`` does."""
    starters = [start.by for start in state.starts]
    world.activity, world.effects = state, state.effects
    world.current = next((by for by in starters if by is not None and not is_activity(by)), None)  # type: ignore[assignment]
    world.when, world.count = When.CALLBACK, 1
    world.path = world.callback_path = state.path
    world.again = world.second_pass = True
    world.after_spin = False
    world.asked, world.ready = set(), frozenset()


def is_activity(doer: object) -> bool:
    """Whether it is a thread or the main program, and no callback."""
    return isinstance(doer, ActivityState)
