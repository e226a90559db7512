"""Threads, locks, events and pools of the standard library."""

from __future__ import annotations

import ast
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses import (
    held_locks,
    lost_notifications,
    signal_locks,
)
from ros2cc_extract.extract.static.concurrency.accesses.held_locks import GIVEN, is_signal
from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ThreadState, thread_of
from ros2cc_extract.extract.static.concurrency.waits import predicates
from ros2cc_extract.extract.static.concurrency.waits.cleared_events import note_cleared
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import (
    note_join,
    note_over,
    note_timed_join,
)
from ros2cc_extract.extract.static.libraries.standard.unset_events import is_never_set
from ros2cc_extract.extract.static.python.machine.dependences import Asked
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import (
    Library,
    LibraryClass,
    StateFactory,
)
from ros2cc_extract.extract.static.python.machine.path_facts import Word, answer
from ros2cc_extract.extract.static.python.machine.waitable_objects import INITIAL
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Const,
    Function,
    Handler,
    Instance,
    Value,
    choice,
)
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import ActivityKind, When

_IS_SET = '__set__'


def _thread_state(kind: ActivityKind) -> StateFactory:
    return lambda machine, instance: ThreadState(kind)


def _thread_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    state = thread_of(receiver)
    state.target = call.argument(1, 'target')
    state.call = _target_call(machine, call, call.argument(3, 'args'), call.argument(4, 'kwargs'))
    daemon = call.argument(5, 'daemon')
    if daemon is not None:
        machine.store.write(receiver, 'daemon', daemon)
    return NONE


def _timer_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    state = thread_of(receiver)
    state.target = call.argument(1, 'function')
    state.call = _target_call(machine, call, call.argument(2, 'args'), call.argument(3, 'kwargs'))
    return NONE


def _target_call(
    machine: ConcurrentMachine, call: Call, args: Value | None, keywords: Value | None
) -> Call:
    inner = Call(call.place)
    if args is not None and args != NONE:
        items, rest = machine.items_of(args, call.place)
        inner.args, inner.more = list(items), rest
    if isinstance(keywords, Mapping):
        inner.keywords = {
            str(key.value): value
            for key, value in keywords.entries.items()
            if isinstance(key, Const)
        }
    return inner


def _start(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    state = thread_of(receiver)
    if state.started and not machine.world.again:
        return NONE
    state.started = True
    run = machine.attribute(receiver, 'run', call.place)
    target = run if isinstance(run, Bound) else state.target
    inner = Call(call.place) if isinstance(run, Bound) or state.call is None else state.call
    inner = replace(inner, place=call.place)
    begin(machine, state.kind, target, inner, receiver, daemon=_is_daemon(receiver))
    return NONE


def _is_daemon(thread: Instance) -> bool | None:
    """Known, or ``None``."""
    daemon = thread.slots.get('daemon', NONE)
    return bool(daemon.value) if isinstance(daemon, Const) else None


def _set_daemon(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, 'daemon', call.argument(0, 'daemonic') or NONE)
    return NONE


def _start_new(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    if call.args:
        inner = _target_call(machine, call, call.argument(1), call.argument(2))
        begin(machine, ActivityKind.THREAD, call.args[0], inner, daemon=True)
    return NONE


def _semaphore_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, INITIAL, call.argument(0, 'value') or Const(1))
    return NONE


def _lock_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A lock that is a signal has one permit."""
    assert isinstance(receiver, Instance)
    if receiver.place in machine.world.signals:
        machine.store.write(receiver, INITIAL, Const(1))
    return NONE


def _lock_state(machine: ConcurrentMachine, instance: Instance) -> PlainState:
    is_signal = instance.place in machine.world.signals
    return PlainState('semaphore' if is_signal else 'lock', place=instance.place)


def _condition_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, GIVEN, call.argument(0, 'lock') or NONE)
    return NONE


_INITS: dict[str, Handler] = {'semaphore': _semaphore_init, 'condition': _condition_init}


def _plain(kind: str) -> LibraryClass:
    return LibraryClass(
        state=lambda machine, instance: PlainState(kind, place=instance.place),
        init=_INITS.get(kind, lambda machine, receiver, call: NONE),
        methods=_PLAIN_METHODS.get(kind, {}),
    )


def _blocking(call_name: str, timeout_index: int, timeout_name: str) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        timeout = call.argument(timeout_index, timeout_name)
        machine.note_blocking(call_name, receiver, timeout, call.place)
        return machine.mystery(f'result of {call_name}', call.place)

    return handler


def _wait_for(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """It asks its predicate before it waits, and each time that it is notified."""
    world, found = machine.world, set[str]()
    predicate = call.argument(0, 'predicate')
    if world.effects is not None and predicate is not None:
        with world.reading.of(found), predicates.asked_again(machine, call):
            machine.call(predicate, Call(call.place))
    holds, until = lost_notifications.holds_of(world), frozenset(found)
    body = _body_of(predicate)
    is_alone = body is not None and not lost_notifications.may_rest_on_more(body)
    several = body is not None and lost_notifications.asks_for_several(body, wanted=True)
    until = until if is_alone else frozenset()
    asked = Asked(frozenset(found), holds, is_open=True, until=until, is_of_several=several)
    with world.reading.in_loop(asked):
        machine.note_blocking(
            'Condition.wait_for', receiver, call.argument(1, 'timeout'), call.place
        )
    return machine.mystery('result of Condition.wait_for', call.place)


def _body_of(predicate: Value | None) -> ast.expr | None:
    """What a lambda gives."""
    node = predicate.node if isinstance(predicate, Function) else None
    return node.body if isinstance(node, ast.Lambda) else None


def _wakes(word: Word) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        machine.note_wake(receiver, word, call.place)
        return NONE

    return handler


def _notify(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """It wakes so many of those that wait."""
    return _notify_some(machine, receiver, call, call.argument(0, 'n') or Const(1))


def _notify_all(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return _notify_some(machine, receiver, call, None)


def _notify_some(
    machine: ConcurrentMachine, receiver: Value, call: Call, number: Value | None
) -> Value:
    """Without the lock it raises (CPython 3.12, ``threading.py``), as far as that is known."""
    world = machine.world
    path = world.path
    if world.effects is not None and not held_locks.holds_lock_of(world, receiver):
        world.path = (*path, (call.place, 0))
    machine.note_wake(receiver, Word.SET, call.place, number)
    world.path = path
    return NONE


def _take_lock(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A lock that the set-up takes is for others to give back, as a semaphore of nothing."""
    assert isinstance(receiver, Instance)
    if _is_set_up(machine):
        if not machine.world.path and _waits_for_it(call):
            machine.store.write(receiver, INITIAL, Const(0))
    elif is_signal(machine.world, receiver) and _waits_for_it(call):
        machine.note_blocking('Lock.acquire', receiver, call.argument(1, 'timeout'), call.place)
    return _acquire(machine, receiver, call)


def _give_lock(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    if _is_set_up(machine):
        machine.store.write(receiver, INITIAL, Const(1))
    elif is_signal(machine.world, receiver):
        machine.note_wake(receiver, Word.RELEASE, call.place)
    signal_locks.note_given(machine.world, receiver)
    return _release(machine, receiver, call)


def _is_set_up(machine: ConcurrentMachine) -> bool:
    """Whether this happens once and before anything else of the program runs."""
    world = machine.world
    is_first = world.when is When.START and not world.after_spin and not world.in_thread
    return is_first and world.effects is None


def _waits_for_it(call: Call) -> bool:
    blocking = call.argument(0, 'blocking')
    return not (isinstance(blocking, Const) and not blocking.value)


def _acquire(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    machine.note_acquire(receiver, call.place, may_fail=bool(call.args or call.keywords))
    return machine.mystery('result of acquire', call.place)


def _take(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Code that gives it back itself takes it as a lock, else it is a wait for others."""
    if _waits_for_it(call):
        timeout = call.argument(1, 'timeout')
        machine.note_blocking('Semaphore.acquire', receiver, timeout, call.place)
    return _acquire(machine, receiver, call)


def _give(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    signal_locks.note_given(machine.world, receiver)
    machine.note_wake(receiver, Word.RELEASE, call.place)
    return _release(machine, receiver, call)


def _meet(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Note that code comes to a barrier, where the others wait for it."""
    assert isinstance(receiver, Instance)
    machine.note_wake(receiver, Word.ARRIVE, call.place)
    timeout = call.argument(0, 'timeout') or receiver.slots.get(_PATIENCE)
    machine.note_blocking('Barrier.wait', receiver, timeout, call.place)
    return machine.mystery('result of Barrier.wait', call.place)


def _break_off(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Raise an error in all that wait at the barrier (``threading.py``, ``Barrier.abort``)."""
    why = Unknown('somebody breaks it off', call.place)
    machine.world.given.setdefault(id(receiver), why)
    return NONE


def _barrier_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Its time-out is that of all waits at it."""
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, INITIAL, call.argument(0, 'parties') or NONE)
    machine.store.write(receiver, _PATIENCE, call.argument(2, 'timeout') or NONE)
    action = call.argument(1, 'action')
    if action is not None:
        machine.note_handed([action], call.place, 'a barrier')
    return NONE


_PATIENCE = '__patience__'
_INITS['barrier'] = _barrier_init


def _release(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    machine.note_release(receiver)
    return NONE


def _event_init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, _IS_SET, Const(False))
    return NONE


_INITS['event'] = _event_init


def _set(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    machine.note_wake(receiver, Word.SET, call.place)
    _keep_flag(machine, receiver, Const(True))
    return NONE


def _clear(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    world = machine.world
    doer = world.activity or world.current
    before = world.things_made
    world.cleared.setdefault(id(receiver), {}).setdefault((doer, call.place), before)
    if world.path == world.callback_path and world.effects is not None:
        world.surely_cleared.setdefault(id(receiver), set()).add((doer, call.place))
    _keep_flag(machine, receiver, Const(False))
    note_cleared(world.effects, receiver)
    return NONE


def _keep_flag(machine: ConcurrentMachine, event: Instance, flag: Const) -> None:
    """A thread may set or clear the event at any time after its start."""
    old = event.slots.get(_IS_SET, Const(False))
    machine.store.write(event, _IS_SET, choice([old, flag]) if machine.world.in_thread else flag)


def _is_set(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Known in the set-up alone, before anything else runs, and if it is never set."""
    assert isinstance(receiver, Instance)
    world, flag = machine.world, receiver.slots.get(_IS_SET)
    if is_never_set(world, receiver):
        return Const(False)
    is_set_up = world.when is When.START and not world.spins_begun and not world.in_thread
    if is_set_up and isinstance(flag, Const) and (flag.value or world.is_program):
        return flag
    return answer(receiver, Word.SET, call)


def _wait_event(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """With a time-out it tells in the end whether the event is set."""
    timeout = call.argument(0, 'timeout')
    machine.note_blocking('Event.wait', receiver, timeout, call.place)
    if timeout is None or timeout == NONE:
        return machine.mystery('result of Event.wait', call.place)
    return answer(receiver, Word.SET, call)


def _is_alive(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return answer(receiver, Word.END, call, if_true=False)


def _sleep(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    machine.note_blocking('time.sleep', None, call.argument(0, 'secs'), call.place)
    return NONE


_LOCK_METHODS: dict[str, Handler] = {'acquire': _acquire, 'release': _release}

_PLAIN_METHODS: dict[str, dict[str, Handler]] = {
    'lock': {'acquire': _take_lock, 'release': _give_lock},
    'rlock': _LOCK_METHODS,
    'condition': {
        **_LOCK_METHODS,
        'wait': _blocking('Condition.wait', 0, 'timeout'),
        'wait_for': _wait_for,
        'notify': _notify,
        'notify_all': _notify_all,
        'notifyAll': _notify_all,
    },
    'semaphore': {'acquire': _take, 'release': _give},
    'event': {
        'wait': _wait_event,
        'set': _set,
        'clear': _clear,
        'is_set': _is_set,
    },
    'barrier': {'wait': _meet, 'abort': _break_off, 'reset': _break_off},
}


def _note_end(machine: ConcurrentMachine, thread: Value) -> None:
    """The set-up has waited for the end of a thread, before anything spins."""
    world = machine.world
    if world.effects is None and not world.after_spin:
        for activity in world.activities:
            is_first = thread in activity.runners and activity.spins == world.main_spins
            activity.ends_first = activity.ends_first or is_first


def join(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """What the thread spun is spun no more where the program has waited for its end."""
    world = machine.world
    if not world.in_callback and not world.in_thread:
        if call.args or call.keywords:
            note_timed_join(world, receiver)
        else:
            world.spins_over = world.spins_begun
            _note_end(machine, receiver)
            note_join(world, receiver, call.place)
            note_over(world, receiver)
    return _blocking('Thread.join', 0, 'timeout')(machine, receiver, call)


_THREAD = LibraryClass(
    state=_thread_state(ActivityKind.THREAD),
    init=_thread_init,
    is_beside=True,
    methods={'start': _start, 'join': join, 'is_alive': _is_alive, 'setDaemon': _set_daemon},
)

_PRIMITIVES = {
    'Lock': LibraryClass(state=_lock_state, init=_lock_init, methods=_PLAIN_METHODS['lock']),
    'RLock': _plain('rlock'),
    'Condition': _plain('condition'),
    'Semaphore': _plain('semaphore'),
    'BoundedSemaphore': _plain('semaphore'),
    'Event': _plain('event'),
    'Barrier': _plain('barrier'),
}
"""Those of ``multiprocessing`` are used in the same way, and by other processes too."""

_JOIN_PROCESS = _blocking('Process.join', 0, 'timeout')

TABLE = Library(
    classes={
        'threading.Thread': _THREAD,
        'threading.Timer': LibraryClass(
            state=_thread_state(ActivityKind.TIMER),
            init=_timer_init,
            bases=('threading.Thread',),
            is_beside=True,
        ),
        'multiprocessing.Process': LibraryClass(
            state=_thread_state(ActivityKind.PROCESS),
            init=_thread_init,
            is_beside=True,
            methods={'start': _start, 'join': _JOIN_PROCESS, 'is_alive': _is_alive},
        ),
        **{
            f'{module}.{name}': made
            for module in ('threading', 'multiprocessing')
            for name, made in _PRIMITIVES.items()
        },
    },
    functions={
        'time.sleep': _sleep,
        '_thread.start_new_thread': _start_new,
        # A context has all that the module has (``multiprocessing/context.py``).
        'multiprocessing.get_context': lambda machine, _, call: machine.library('multiprocessing'),
    },
    aliases={
        # Threads in spite of the name (``multiprocessing/dummy/__init__.py``).
        'multiprocessing.dummy.Process': 'threading.Thread',
        'multiprocessing.dummy.DummyProcess': 'threading.Thread',
    },
)
