"""
Loops of asyncio, and what belongs to them: queues, events, futures.

A loop runs in one thread, and what belongs to it is for that thread alone: another one hands over
what is to be done by ``call_soon_threadsafe``, which wakes the loop. Sources: CPython 3.12,
``asyncio/base_events.py`` (``call_soon_threadsafe`` writes to the loop's own socket, ``call_soon``
does not), ``asyncio/queues.py``; library reference, *Developing with asyncio*.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager

from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    LoopRun,
    LoopTouch,
)
from ros2cc_extract.extract.static.concurrency.waits import loop_tasks
from ros2cc_extract.extract.static.concurrency.waits.endless_runs import note_endless_run
from ros2cc_extract.extract.static.libraries.standard.futures import (
    LOOP,
    RUNS,
    key_of_loop,
    run_in_executor,
)
from ros2cc_extract.extract.static.libraries.standard.loop_asks import ASKED, needing
from ros2cc_extract.extract.static.libraries.standard.queue_items import give_items
from ros2cc_extract.extract.static.libraries.standard.queues import QUEUE_METHODS, may_be_full
from ros2cc_extract.extract.static.libraries.standard.queues import init as init_queue
from ros2cc_extract.extract.static.libraries.standard.signal_handlers import on_signal_of_loop
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import (
    AWAITED,
    Library,
    LibraryClass,
)
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.waitable_objects import OF_LOOP
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Const,
    Coroutine,
    Function,
    Handler,
    Instance,
    Native,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import AWAIT
from ros2cc_extract.spec.model import ActivityKind, When

_OWN_CODE = (Function, Bound, Partial)
IN_TASK = '__in_task__'
"""Slot of a coroutine of a library that others run beside: what it does as a task."""
STARTED = '__started__'
"""Slot of a task that is no future of its own."""
LOOSE = '__loose__'
"""Slot of a task that only its maker keeps."""

_LOOP = 'asyncio.AbstractEventLoop'
_FUTURE = 'asyncio.Future'


@contextmanager
def _by_loop(machine: ConcurrentMachine) -> Iterator[None]:
    """A loop does what is done inside, in its own thread."""
    before = machine.world.by_loop
    machine.world.by_loop = True
    try:
        yield
    finally:
        machine.world.by_loop = before


def _note_touch(machine: ConcurrentMachine, thing: Value, how: str, call: Call) -> None:
    """Note that something of a loop is touched; the thread that does it is found after the run."""
    world = machine.world
    doer = world.activity or (world.current if world.effects is not None else None)
    if world.by_loop or ASKED in world.asked or doer is None or not isinstance(thing, Instance):
        return
    touch = LoopTouch(how, thing, doer, call.place)
    if not any(touch.is_same(other) for other in world.loop_touches):
        world.loop_touches.append(touch)


def _run_coroutine(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A loop of asyncio runs it, here and now; what it awaits holds the thread."""
    world = machine.world
    before, world.on_loop = world.on_loop, world.in_callback
    outer = world.loop
    if outer is None and not world.in_callback:
        world.loop = call.place
    try:
        with _by_loop(machine):
            results = [machine.await_value(arg, call.place) for arg in call.args]
    finally:
        world.on_loop, world.loop = before, outer
    return results[0] if results else NONE


def _run_loop(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    _note_run(machine, receiver, call.place)
    world = machine.world
    loop = key_of_loop(receiver) if isinstance(receiver, Instance) else call.place
    task = loop_tasks.LoopTask(_name_of(call), loop, run_at=call.place)
    key = (call.place, world.chain, id(world.activity or world.current))
    with loop_tasks.as_root(world, key, task):
        result = _run_coroutine(machine, receiver, call)
    loop_tasks.end(world, task)
    return result


def _name_of(call: Call) -> str:
    """The function of the coroutine that a call gets."""
    given = call.args[0] if call.args else NONE
    return given.function.name if isinstance(given, Coroutine) else 'a coroutine'


def _follow_task(machine: ConcurrentMachine, receiver: Value, call: Call) -> None:
    """Follow what a task does, beside the task that has made it."""
    world, inner = machine.world, Call(call.place, call.args[:1])
    task = loop_tasks.child_of(world, _name_of(call))
    if task is not None or not isinstance(receiver, Instance):
        with loop_tasks.followed_as(world, task):
            _run_coroutine(machine, receiver, inner)
        return
    root = loop_tasks.LoopTask(_name_of(call), key_of_loop(receiver), many=bool(world.open_loops))
    with loop_tasks.as_root(world, (call.place, world.chain, id(world.current)), root):
        _run_coroutine(machine, receiver, inner)


def _note_run(machine: ConcurrentMachine, loop: Value, place: Place) -> None:
    world = machine.world
    if isinstance(loop, Instance) and RUNS in loop.slots:
        machine.note_wake(loop.slots[RUNS], Word.SET, place)
    if not world.second_pass and not world.in_callback:
        world.loop_runs.append(LoopRun(loop, world.thread))


def make_task(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """The event loop runs it later: the callback that hands it over does none of it."""
    world = machine.world
    _note_touch(machine, receiver, 'create_task', call)
    task = machine.task_of_loop(call.args[0], call.place) if call.args else None
    if task is not None:
        return task
    effects, held, holds = world.effects, world.held, world.holds
    coroutine = call.args[0] if call.args else NONE
    if effects is not None and _is_task(world.activity) and isinstance(coroutine, Coroutine):
        given = coroutine.call
        inner = Call(call.place, given.args, given.keywords, given.more)
        own = world.activity.loop if isinstance(world.activity, ActivityState) else None
        begin(machine, ActivityKind.THREAD, coroutine.function, inner, on_loop=own or call.place)
        return machine.mystery(loop_tasks.TASK, call.place, 'asyncio task')
    if effects is None or (world.activity is not None and world.when is When.START):
        _follow_task(machine, receiver, call)
        return machine.mystery(loop_tasks.TASK, call.place, 'asyncio task')
    world.effects, world.held = None, ()
    try:
        _follow_task(machine, receiver, call)
    finally:
        world.effects, world.held, world.holds = effects, held, holds
    return machine.mystery(loop_tasks.TASK, call.place, 'asyncio task')


def _create_task(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Mark a task that only its receiver here keeps."""
    task = make_task(machine, receiver, call)
    if isinstance(task, Instance):
        task.slots[LOOSE] = NONE
    return task


def _gather(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """All run at the same time, and all are awaited."""
    tasks = [_as_task(machine, each, call.place) for each in call.args]
    if call.more or not tasks or any(task is None for task in tasks):
        return _run_all(machine, receiver, call)

    def wait(machine: ConcurrentMachine, _: Value, inner: Call) -> Value:
        for task in tasks:
            machine.await_value(task or NONE, inner.place)
        return machine.mystery('results of asyncio.gather', inner.place, 'await gather(…)')

    return coroutine_of('asyncio.gather', wait, call)


def _run_all(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Follow all, each a task that runs beside the others, until all are over."""
    world, alone = machine.world, _written_out(call)
    calls = [Call(call.place, [each]) for each in call.args]
    made = [
        loop_tasks.child_of(world, _name_of(each), many=at >= alone)
        if isinstance(each.args[0], Coroutine)
        else None
        for at, each in enumerate(calls)
    ]
    results = []
    for task, each in zip(made, calls, strict=True):
        with loop_tasks.followed_as(world, task):
            results.append(_run_coroutine(machine, receiver, each))
    for task in made:
        loop_tasks.end(world, task)
    return results[0] if results else NONE


def _written_out(call: Call) -> int:
    """How many arguments stand in front of what is spread out and may be any number."""
    if call.more is None:
        return len(call.args)
    given = call.text.args if isinstance(call.text, ast.Call) else []
    stars = (at for at, each in enumerate(given) if isinstance(each, ast.Starred))
    return next(stars, 0)


def _as_task(machine: ConcurrentMachine, value: Value, place: Place) -> Value | None:
    """A future, or what a library awaits by itself, is awaited as it is."""
    is_made = isinstance(value, Instance) and IN_TASK not in value.slots
    if is_made and machine.runs_on_loop:
        return value
    return machine.task_of_loop(value, place)


def _asyncio_sleep(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    delay = call.argument(0, 'delay')
    if machine.world.is_on_loop:
        return coroutine_of('asyncio.sleep', _sleeping(delay), call)
    if isinstance(delay, Const) and isinstance(delay.value, (int, float)) and delay.value <= 0:
        machine.note_turn(call.place)  # this asks for no loop
    else:
        machine.note_blocking('asyncio.sleep', None, delay, call.place)
    return NONE


def _sleeping(delay: Value | None) -> Handler:
    def sleep(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        machine.note_blocking(f'{AWAIT} asyncio.sleep', None, delay, call.place)
        return NONE

    return sleep


def _call_soon(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """It wakes no loop that waits, and is for the thread of the loop alone."""
    _note_touch(machine, receiver, 'call_soon', call)
    return _by_this_thread(machine, call)


def _call_soon_threadsafe(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """
    Let the loop call it; the code that hands it over need not wait for that.

    What the program itself does then is done beside that code, unless a loop runs both.
    """
    target = call.args[0] if call.args else NONE
    is_own = any(isinstance(each, _OWN_CODE) for each in options_of(target))
    if not is_own or _is_on_loop(machine):
        return _by_this_thread(machine, call)
    turns = receiver.slots.get(LOOP) if isinstance(receiver, Instance) else None
    inner = Call(call.place, call.args[1:])
    with _by_loop(machine):
        key = key_of_loop(receiver)
        begin(machine, ActivityKind.THREAD, target, inner, turns=turns, on_loop=key)
    return NONE


def _is_on_loop(machine: ConcurrentMachine) -> bool:
    world = machine.world
    return _is_task(world.activity) or machine.runs_on_loop or world.is_on_loop


def _is_task(activity: ActivityState | None) -> bool:
    return activity is not None and activity.on_loop


def _by_this_thread(machine: ConcurrentMachine, call: Call) -> Value:
    if call.args:
        with _by_loop(machine):
            machine.call(call.args[0], Call(call.place, call.args[1:]))
    return NONE


def _is_running(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Return an open answer: code that asks has another way for a loop that runs."""
    machine.world.asked.add(ASKED)
    return machine.mystery('whether a loop runs', call.place, 'is_running()')


def _run_forever(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    _note_run(machine, receiver, call.place)
    if machine.world.activity is not None:
        machine.world.activity.loops = True
    note_endless_run(machine.world, receiver, call.place, 'stop')
    return NONE


def _create_future(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return _made(_FUTURE, OF_LOOP, call)


def _made(name: str, kind: str, call: Call) -> Instance:
    made = Instance(Name(name), call.place)
    made.state = PlainState(kind, place=call.place)
    return made


def _touching(how: str, word: Word) -> Handler:
    """What ends a wait for something of a loop."""

    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        _note_touch(machine, receiver, how, call)
        if word is Word.PUT:
            give_items(machine, receiver, call)
        item = call.argument(0, 'item') if word is Word.PUT else None
        machine.note_wake(receiver, word, call.place, item)
        return machine.mystery(f'result of {how}', call.place, f'{how}()')

    return handler


def _awaitable(name: str, word: Word | None = None) -> Handler:
    """A coroutine that waits for ``receiver`` once it is awaited, and then does ``word``."""

    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        def awaited(machine: ConcurrentMachine, _: Value, inner: Call) -> Value:
            if isinstance(receiver, Instance) and (name != _PUT or may_be_full(receiver)):
                called = f'{AWAIT} {name}' if machine.world.is_on_loop else name
                machine.note_blocking(called, receiver, None, inner.place)
                machine.world.awaited_of_loops.append(receiver)
            if word is not None:
                item = call.argument(0, 'item') if word is Word.PUT else None
                machine.note_wake(receiver, word, inner.place, item)
            return machine.mystery(f'result of {name}', inner.place, f'await {name}(…)')

        return coroutine_of(name, awaited, call)

    return handler


def coroutine_of(name: str, awaited: Handler, call: Call) -> Instance:
    """What a coroutine function of a library gives: ``awaited`` happens when it is awaited."""

    def suspended(machine: ConcurrentMachine, receiver: Value, inner: Call) -> Value:
        if name not in _AT_ONCE:
            machine.note_suspended(inner.place)
        return awaited(machine, receiver, inner)

    coroutine = _made('asyncio.coroutine', 'coroutine', call)
    coroutine.slots[AWAITED] = Native(name, suspended)
    return coroutine


def _within(inner: Value, limit: Value) -> Handler:
    def wait(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        world = machine.world
        outer, world.limit = world.limit, limit
        try:
            return machine.await_value(inner, call.place)
        finally:
            world.limit = outer

    return wait


def _wait_for(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A wait with a time-out ends in any case."""
    inner = call.argument(0, 'fut')
    limit = call.argument(1, 'timeout')
    if machine.world.is_on_loop and inner is not None and limit not in (None, NONE):
        return coroutine_of('asyncio.wait_for', _within(inner, limit or NONE), call)
    if not isinstance(inner, Instance) or AWAITED not in inner.slots:
        reason = 'result of asyncio.wait_for, which is not scanned'
        return machine.mystery(reason, call.place, 'asyncio.wait_for(…)')
    coroutine = _made('asyncio.coroutine', 'coroutine', call)
    result = machine.mystery('result of asyncio.wait_for', call.place, 'asyncio.wait_for(…)')
    coroutine.slots[AWAITED] = Native('asyncio.wait_for', lambda machine, receiver, call: result)
    return coroutine


_PUT = 'asyncio.Queue.put'
_AT_ONCE = frozenset({'acquire', _PUT})
"""They need not wait for others."""
_QUEUE = LibraryClass(
    state=lambda machine, instance: PlainState('queue', place=instance.place),
    init=init_queue,
    methods={
        **QUEUE_METHODS,
        'get': _awaitable('asyncio.Queue.get', Word.GET),
        'put': _awaitable(_PUT, Word.PUT),
        'join': _awaitable('asyncio.Queue.join'),
        'put_nowait': _touching('put_nowait', Word.PUT),
        'get_nowait': _touching('get_nowait', Word.GET),
        'task_done': _touching('task_done', Word.DONE),
    },
)
_EVENT = LibraryClass(
    state=lambda machine, instance: PlainState('event', place=instance.place),
    init=lambda machine, receiver, call: NONE,
    methods={
        'wait': _awaitable('asyncio.Event.wait'),
        'set': _touching('set', Word.SET),
        'clear': lambda machine, receiver, call: NONE,
        'is_set': lambda machine, receiver, call: machine.mystery('is_set()', call.place),
    },
)

_LOOP_METHODS: dict[str, Handler] = {
    'run_until_complete': _run_loop,
    'is_running': _is_running,
    'create_task': _create_task,
    'create_future': _create_future,
    'call_soon': _call_soon,
    'call_soon_threadsafe': _call_soon_threadsafe,
    'run_forever': _run_forever,
    'add_signal_handler': on_signal_of_loop,
    'run_in_executor': run_in_executor,
}


def _new_loop(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """It does nothing before some code runs it."""
    loop = Instance(Name(_LOOP), call.place)
    loop.slots[RUNS] = _made('asyncio.start of the loop', 'event', call)
    return loop


def _set_loop(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``set_event_loop``: its thread has a loop, which need not run."""
    machine.world.sets_loops = True
    return NONE


def _some_task(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return machine.mystery(loop_tasks.TASK, call.place, 'asyncio task')


def _own_loop(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    loop = Instance(Name(_LOOP), call.place)
    begin = machine.world.own_loop
    if begin is not None:
        loop.slots[LOOP] = begin
    return loop


TABLE = Library(
    classes={
        _LOOP: LibraryClass(methods=_LOOP_METHODS),
        'asyncio.Queue': _QUEUE,
        'asyncio.LifoQueue': _QUEUE,
        'asyncio.PriorityQueue': _QUEUE,
        'asyncio.Event': _EVENT,
        _FUTURE: LibraryClass(
            state=lambda machine, instance: PlainState(OF_LOOP, place=instance.place),
            init=lambda machine, receiver, call: NONE,
            bases=('rclpy.task.Future',),
            methods={
                'set_result': _touching('set_result', Word.SET),
                'set_exception': _touching('set_exception', Word.SET),
            },
        ),
    },
    functions={
        'asyncio.run': _run_loop,
        'asyncio.gather': needing('asyncio.gather', _gather, is_any=True),
        'asyncio.wait_for': _wait_for,
        'asyncio.wait': _gather,
        'asyncio.create_task': needing('asyncio.create_task', _create_task),
        'asyncio.ensure_future': needing('asyncio.ensure_future', _create_task, is_any=True),
        'asyncio.current_task': needing('asyncio.current_task', _some_task),
        'asyncio.sleep': _asyncio_sleep,
        'asyncio.get_event_loop': needing('asyncio.get_event_loop', _own_loop, is_any=True),
        'asyncio.set_event_loop': _set_loop,
        'asyncio.new_event_loop': _new_loop,
        'asyncio.get_running_loop': needing('asyncio.get_running_loop', _own_loop),
    },
    aliases={
        'asyncio.queues.Queue': 'asyncio.Queue',
        'asyncio.locks.Event': 'asyncio.Event',
        'asyncio.futures.Future': _FUTURE,
    },
)
