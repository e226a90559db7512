"""
Blocks of asyncio: groups of tasks, limits of time, locks and semaphores.

Source: CPython 3.12, ``asyncio/taskgroups.py`` (the end of the block awaits all tasks),
``timeouts.py`` (what is awaited in the block is cancelled when its time is over), ``locks.py``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.held_locks import taking_of
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.waits import loop_tasks
from ros2cc_extract.extract.static.libraries.standard.asyncio_loops import (
    STARTED,
    coroutine_of,
    make_task,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import (
    AWAITED,
    Library,
    LibraryClass,
)
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.waitable_objects import INITIAL, OF_LOOP
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Coroutine,
    Instance,
    Native,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name

_TASKS, _LIMIT, _OUTER = '__tasks__', '__limit__', '__outer__'
_TIMEOUT = 'asyncio.Timeout'


def _enter_group(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        machine.store.write(receiver, _TASKS, ())
    return receiver


def _start(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """The group keeps the task."""
    world, given = machine.world, call.args[0] if call.args else NONE
    is_awaited_here = world.effects is not None and world.on_loop
    if is_awaited_here and isinstance(given, Coroutine):
        task = machine.task_of_loop(given, call.place) or _task_here(given, call)
    else:
        task = make_task(machine, NONE, call)
    if isinstance(receiver, Instance):
        kept = receiver.slots.get(_TASKS, ())
        machine.store.write(receiver, _TASKS, (*kept, task))
    return task


def _task_here(coroutine: Coroutine, call: Call) -> Instance:
    """The code that runs the loop does what the task does, at the end of the block at last."""
    task = Instance(Name('asyncio.Future'), call.place)
    task.state = PlainState(OF_LOOP, place=call.place)

    def awaited(machine: ConcurrentMachine, _: Value, inner: Call) -> Value:
        made = loop_tasks.child_of(machine.world, coroutine.function.name)
        with loop_tasks.followed_as(machine.world, made):
            return machine.await_value(coroutine, inner.place)

    task.slots[AWAITED], task.slots[STARTED] = Native('asyncio.Task', awaited), NONE
    return task


def _leave_group(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    machine.note_suspended(call.place)
    if isinstance(receiver, Instance):
        for task in receiver.slots.get(_TASKS, ()):
            if isinstance(task, Instance):
                machine.await_value(task, call.place)
    loop_tasks.end_all(machine.world)
    return NONE


def _timeout(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    made = Instance(Name(_TIMEOUT), call.place)
    machine.store.write(made, _LIMIT, call.argument(0, 'delay') or NONE)
    return made


def _enter_limit(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    world = machine.world
    if isinstance(receiver, Instance):
        machine.store.write(receiver, _OUTER, world.limit or NONE)
        limit = receiver.slots.get(_LIMIT, NONE)
        world.limit = world.limit if limit == NONE else limit
    return receiver


def _leave_limit(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        outer = receiver.slots.get(_OUTER, NONE)
        machine.world.limit = None if outer == NONE else outer
    return NONE


def _init_lock(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A lock is a semaphore of one."""
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, INITIAL, call.argument(0, 'value') or Const(1))
    return NONE


def _acquire(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    def take(machine: ConcurrentMachine, _: Value, inner: Call) -> Value:
        if isinstance(receiver, Instance):
            name = taking_of(machine.world, receiver)
            machine.note_blocking(name, receiver, None, inner.place)
            machine.note_acquire(receiver, inner.place)
        return Const(True)

    return coroutine_of('acquire', take, call)


def _release(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    machine.note_wake(receiver, Word.RELEASE, call.place)
    machine.note_release(receiver)
    return NONE


def _locked(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return machine.mystery('whether a lock is taken', call.place, 'locked()')


_LOCK = LibraryClass(
    state=lambda machine, instance: PlainState('semaphore', place=instance.place),
    init=_init_lock,
    methods={'acquire': _acquire, 'release': _release, 'locked': _locked},
)

TABLE = Library(
    classes={
        'asyncio.TaskGroup': LibraryClass(
            init=lambda machine, receiver, call: NONE,
            methods={
                '__aenter__': _enter_group,
                'create_task': _start,
                '__aexit__': _leave_group,
            },
        ),
        _TIMEOUT: LibraryClass(methods={'__aenter__': _enter_limit, '__aexit__': _leave_limit}),
        'asyncio.Lock': _LOCK,
        'asyncio.Semaphore': _LOCK,
        'asyncio.BoundedSemaphore': _LOCK,
    },
    functions={'asyncio.timeout': _timeout, 'asyncio.timeout_at': _timeout},
    aliases={
        'asyncio.locks.Lock': 'asyncio.Lock',
        'asyncio.locks.Semaphore': 'asyncio.Semaphore',
        'asyncio.taskgroups.TaskGroup': 'asyncio.TaskGroup',
        'asyncio.timeouts.timeout': 'asyncio.timeout',
    },
)
