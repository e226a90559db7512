"""
Done-callbacks of futures: which thread runs them, and when.

A future that was given to no executor runs them in the thread that completes it, with every lock
that is held there; one that is added to a future which is done runs at once. An answer that an
executor takes has that executor, whose tasks they are then. Sources: rclpy 7.1.6 and 9.1.2,
``task.py`` (``_schedule_or_invoke_done_callbacks``, ``add_done_callback``), ``executors.py``
(``_set_executor`` where an answer is taken); CPython 3.12, ``concurrent/futures/_base.py``.
"""

from __future__ import annotations

from functools import partial

from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.fixed_point import is_same_text, note_found
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.path_facts import Word, back_to
from ros2cc_extract.extract.static.python.machine.waitable_objects import OF_POOL
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Call,
    Choice,
    Const,
    Instance,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import ActivityKind

_OWN = 'future'
"""Kind of a future of rclpy that the program makes itself."""

_BY_HAND = Name('concurrent.futures.Future')
"""Class of a future that belongs to no pool."""

_CALLBACKS = '__done_callbacks__'
_IS_DONE = '__is_done__'
_EXECUTOR = '__executor_of_future__'
_PENDING, _DONE = Const(False), Const(True)
_EITHER = choice([_PENDING, _DONE])


_AROUND = (
    'path',
    'callback_path',
    'count',
    'when',
    'current',
    'activity',
    'chain',
    'held',
    'in_thread',
    'after_spin',
    'open_loops',
    'loop_depth',
    'laps',
    'assumed',
)


@dataclass(frozen=True, eq=False)
class _Left:
    """
    A callback that is run by the code that completes its future.

    :param around: state of the world: what has added it, and where.
    """

    future: Instance
    callback: Value
    place: Place
    around: tuple[object, ...]


def init_future(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``Future(executor=…)``."""
    if isinstance(receiver, Instance):
        machine.store.write(receiver, _EXECUTOR, call.argument(None, 'executor') or NONE)
    return NONE


def begin_anew(machine: ConcurrentMachine, receiver: Instance) -> None:
    """A callback that is followed again makes its future again, which is not completed."""
    machine.store.write(receiver, _IS_DONE, _PENDING)


def may_be_done(machine: ConcurrentMachine, future: Instance) -> None:
    """Note that what completes it runs beside the code that has got it."""
    machine.store.write(future, _IS_DONE, _EITHER)


def add_done_callback(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Run it at once if the future is done, else keep it for code that completes the future."""
    assert isinstance(receiver, Instance)
    callback = call.argument(0, 'callback') or call.argument(0, 'fn')
    if not isinstance(receiver.state, PlainState) or callback is None:
        return NONE
    run = partial(_run, machine, receiver, callback, call.place)
    is_done = _PENDING if _has_executor(receiver) else _is_done(receiver)
    if is_done == _DONE:
        return run()
    known = options_of(receiver.slots.get(_CALLBACKS, ABSENT))
    others = [each for each in known if not is_same_text(each, callback)]
    machine.store.write(receiver, _CALLBACKS, choice([*others, callback]))
    _note_later(machine, receiver, callback, call)
    return NONE if is_done == _PENDING else machine.branch([run, lambda: NONE], call.place)


def _note_later(machine: ConcurrentMachine, future: Instance, callback: Value, call: Call) -> None:
    """Note that unknown code may complete it: an executor by a task, a thread of a pool itself."""
    state = future.state
    if state.kind == OF_POOL and future.mro[-1] == _BY_HAND:
        machine.world.escaped.append((callback, call.place))
        return
    if state.kind == OF_POOL:
        begin(machine, ActivityKind.POOL, callback, Call(call.place, [future]))
    elif state.kind == _OWN and not _has_executor(future):
        around = _around(machine.world)
        machine.world.left_callbacks.append(_Left(future, callback, call.place, around))
    else:
        machine.add_task(future, callback, call.place)


def add_left(machine: ConcurrentMachine) -> None:
    """Make tasks of those that no known code runs: what runs them has a thread of its own."""
    world = machine.world
    before = _around(world)
    left, world.left_callbacks = world.left_callbacks, []
    for each in left:
        if id(each.future) not in world.completed or id(each.future) in world.given:
            _set_around(world, each.around)
            doer = world.activity or world.current
            world.effects = doer.effects if doer is not None else None
            machine.add_task(each.future, each.callback, each.place)
    _set_around(world, before)


def _around(world: ConcurrentWorld) -> tuple[object, ...]:
    return tuple(getattr(world, name) for name in _AROUND)


def _set_around(world: ConcurrentWorld, around: tuple[object, ...]) -> None:
    for name, value in zip(_AROUND, around, strict=True):
        setattr(world, name, value)


def complete(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``set_result``, ``set_exception``."""
    machine.note_wake(receiver, Word.SET, call.place)
    if isinstance(receiver, Instance) and not _has_executor(receiver):
        is_own = receiver.state.kind in (_OWN, OF_POOL)
        machine.world.completed.add(id(receiver))
        _run_all(machine, receiver, call.place, is_sure=is_own and _is_done(receiver) == _PENDING)
    return NONE


def cancel(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """
    ``cancel``, of a future that is not done.

    One whose answer has not come has no executor yet.
    """
    machine.note_wake(receiver, Word.SET, call.place)
    if isinstance(receiver, Instance):
        machine.world.cancelled.setdefault(receiver.place, call.place)
    if isinstance(receiver, Instance) and not _has_executor(receiver):
        _run_all(machine, receiver, call.place, is_sure=False)
    return NONE


def _run_all(machine: ConcurrentMachine, future: Instance, place: Place, *, is_sure: bool) -> None:
    world = machine.world
    held = future.slots.get(_CALLBACKS, ABSENT)
    callbacks = options_of(held)
    if world.current is not None and world.activity is None:
        note_found(world, future, _CALLBACKS, held)  # code that adds one later makes it run here
    if _is_done(future) == _DONE:
        return
    machine.store.write(future, _IS_DONE, _EITHER if world.in_thread or not is_sure else _DONE)
    for callback in callbacks:
        run = partial(_run, machine, future, callback, place)
        if is_sure and callback is held:
            run()
        else:
            machine.branch([run, lambda: NONE], place)


def _run(machine: ConcurrentMachine, future: Instance, callback: Value, place: Place) -> Value:
    """In this thread; the future is done by then."""
    world = machine.world
    ready = world.ready
    world.ready = ready | {(future, Word.SET), (future, Word.END)}
    machine.call(callback, Call(place, [future]))
    world.ready = back_to(ready, world.ready)
    return NONE


def _is_done(future: Instance) -> Value:
    held = future.slots.get(_IS_DONE, ABSENT)
    options = held.options if isinstance(held, Choice) else (held,)
    return choice([_PENDING if option is ABSENT else option for option in options])


def _has_executor(future: Instance) -> bool:
    given = future.slots.get(_EXECUTOR, NONE)
    return future.state.kind == 'task' or any(option != NONE for option in options_of(given))
