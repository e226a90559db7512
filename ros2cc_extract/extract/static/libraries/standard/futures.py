"""
Pools of the standard library and what is handed to them: futures, and code that waits for them.

Sources: CPython 3.12, ``concurrent/futures/_base.py`` (``wait``, ``as_completed``, ``map``,
leaving a ``with`` waits for all), ``asyncio/tasks.py`` (``run_coroutine_threadsafe``).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.libraries.standard.done_callbacks import (
    add_done_callback,
    begin_anew,
    cancel,
    complete,
    may_be_done,
)
from ros2cc_extract.extract.static.libraries.standard.pool_tasks import WORKERS
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import (
    AWAITED,
    Library,
    LibraryClass,
)
from ros2cc_extract.extract.static.python.machine.path_facts import (
    Word,
    answer,
    cancelled,
    running,
)
from ros2cc_extract.extract.static.python.machine.waitable_objects import OF_POOL
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Coroutine,
    Handler,
    Instance,
    Mystery,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import ActivityKind

LOOP = '__loop__'
"""Slot of a loop of asyncio for where it begins."""
RUNS = '__runs__'
"""Slot of a loop of the program's own for the event that some code runs it."""
_OF_NEW_LOOP = '__of_new_loop__'
_HANDED_OVER = '__handed_over__'
_FIRST = ('FIRST_COMPLETED', 'FIRST_EXCEPTION')


def submit(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``pool.submit(function, …)``, ``asyncio.to_thread(function, …)``."""
    future = machine.future(call.place, OF_POOL)
    if call.args:
        inner = Call(call.place, call.args[1:], call.keywords, call.more)
        _hand_over(machine, receiver, call.args[0], inner, future)
    _keep(machine, receiver, future)
    if is_pool(receiver):
        may_be_done(machine, future)
    return future


def run_in_executor(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``loop.run_in_executor(pool, function, …)``."""
    future = machine.future(call.place, OF_POOL)
    if len(call.args) > 1:
        inner = Call(call.place, call.args[2:])
        _hand_over(machine, call.args[0], call.args[1], inner, future)
        _keep(machine, call.args[0], future)
    return future


def run_threadsafe(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``asyncio.run_coroutine_threadsafe(coroutine, loop)``: the thread of the loop runs it."""
    future = machine.future(call.place, OF_POOL)
    coroutine = call.args[0] if call.args else NONE
    target: Value = coroutine
    inner = Call(call.place)
    if isinstance(coroutine, Coroutine):
        target = coroutine.function
        inner = Call(call.place, coroutine.call.args, coroutine.call.keywords, coroutine.call.more)
    elif isinstance(coroutine, Instance):
        target = coroutine.slots.get(AWAITED, coroutine)
    loop = call.argument(1, 'loop')
    task = machine.task_of_loop(coroutine, call.place, loop)
    if task is not None:
        return task
    turns = loop.slots.get(LOOP) if isinstance(loop, Instance) else None
    if isinstance(loop, Instance) and isinstance(future, Instance):
        future.slots[_OF_NEW_LOOP] = loop.slots.get(RUNS, NONE)
    on_loop = key_of_loop(loop or NONE)
    begin(machine, ActivityKind.THREAD, target, inner, future, turns=turns, on_loop=on_loop)
    may_be_done(machine, future)
    return future


def key_of_loop(loop: Value) -> object:
    """Equal for what one loop runs."""
    begun = loop.slots.get(LOOP) if isinstance(loop, Instance) else None
    return begun or id(loop)


def _hand_over(
    machine: ConcurrentMachine, to: Value, target: Value, inner: Call, future: Value
) -> None:
    """A thread of the pool ``to`` runs it; one that is its only thread runs all in turn."""
    turns, pool = _one_thread(to), _pool(to)
    begin(machine, ActivityKind.POOL, target, inner, future, turns=turns, pool=pool)


def _pool(value: Value) -> Instance | None:
    return value if isinstance(value, Instance) and is_pool(value) else None


def _one_thread(pool: Value) -> Value | None:
    """The pool, if it has one thread for all that is handed to it."""
    workers = pool.slots.get(WORKERS) if isinstance(pool, Instance) else None
    return pool if workers == Const(1) else None


def _init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    workers = call.argument(0, 'max_workers')
    if isinstance(receiver, Instance) and workers is not None:
        machine.store.write(receiver, WORKERS, workers)
    first = call.argument(2, 'initializer')
    if first not in (None, NONE):
        begin(machine, ActivityKind.POOL, first, Call(call.place))
    return NONE


def _keep(machine: ConcurrentMachine, pool: Value, future: Value) -> None:
    """Wait for the end of a pool: for all that was handed to it."""
    if isinstance(pool, Instance):
        kept = pool.slots.get(_HANDED_OVER, ())
        machine.store.write(pool, _HANDED_OVER, (*kept, future))


def _map(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Its results wait for all calls, when code goes over them."""
    results = machine.future(call.place, OF_POOL)
    results.hint = 'map'
    if call.args:
        items = [loops.items_in(machine, each, call.place) for each in call.args[1:]]
        given = [choice(list(each.known)) if each.known else _item(each) for each in items]
        _hand_over(machine, receiver, call.args[0], Call(call.place, given), results)
    _keep(machine, receiver, results)
    return results


def _item(items: loops.Items) -> Value:
    return Mystery(items.others or Unknown('item that could not be followed'), 'item')


def note_leaving(machine: ConcurrentMachine, pool: Value, place: Place) -> None:
    """A pool ends: all that was handed to it must have come to its end."""
    kept = pool.slots.get(_HANDED_OVER, ()) if isinstance(pool, Instance) else ()
    for future in dict.fromkeys(option for each in kept for option in options_of(each)):
        machine.note_blocking('Executor.shutdown', future, None, place)


def is_pool(value: Value) -> bool:
    """Whether leaving a ``with`` over it waits."""
    state = value.state if isinstance(value, Instance) else None
    return isinstance(state, PlainState) and state.kind == 'executor'


def _shutdown(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    wait = call.argument(0, 'wait')
    if not (isinstance(wait, Const) and not wait.value):
        note_leaving(machine, receiver, call.place)
    return NONE


def _for_all(name: str, position: int | None) -> Handler:
    """Waits for every future it is given, one after the other."""

    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        given = call.args[0] if call.args else NONE
        timeout = call.argument(position, 'timeout')
        items = loops.items_in(machine, given, call.place)
        when = call.argument(2, 'return_when') if name == 'futures.wait' else None
        if items.others is not None or when is not None:
            why = items.others or Unknown('it waits for the first of several', call.place)
            machine.note_blocking(name, Mystery(why), timeout, call.place)
        else:
            for future in items.known:
                machine.note_blocking(name, future, timeout, call.place)
                if timeout in (None, NONE):
                    machine.world.ready |= {(option, Word.SET) for option in options_of(future)}
            if name == 'futures.as_completed':
                return Sequence(items.known, 'generator', None, items.many)
        return machine.mystery(f'result of {name}', call.place, f'{name}(…)')

    return handler


def _asked(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return answer(receiver, Word.SET, call)


def _cancelled(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return cancelled(receiver, call)


def _running(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return running(receiver, call)


def waited_for(machine: ConcurrentMachine, future: Value) -> Value:
    """What a wait for ``future`` waits for first: that some thread runs the loop of its task."""
    runs = future.slots.get(_OF_NEW_LOOP, NONE) if isinstance(future, Instance) else NONE
    known = (option for run in machine.world.loop_runs for option in options_of(run.loop))
    is_run = any(isinstance(loop, Instance) and loop.slots.get(RUNS) is runs for loop in known)
    return future if runs == NONE or is_run else runs


def _waits(name: str) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        awaited = waited_for(machine, receiver)
        machine.note_blocking(name, awaited, call.argument(0, 'timeout'), call.place)
        return machine.mystery(f'result of {name}', call.place, 'result()')

    return handler


_POOL = LibraryClass(
    state=lambda machine, instance: PlainState('executor', place=instance.place),
    init=_init,
    methods={'submit': submit, 'map': _map, 'shutdown': _shutdown},
)

TABLE = Library(
    classes={
        'concurrent.futures.ThreadPoolExecutor': _POOL,
        'concurrent.futures.ProcessPoolExecutor': _POOL,
        'concurrent.futures.Future': LibraryClass(
            state=lambda machine, instance: PlainState(OF_POOL, place=instance.place),
            init=lambda machine, receiver, call: NONE,
            again=begin_anew,
            methods={
                'add_done_callback': add_done_callback,
                'set_result': complete,
                'set_exception': complete,
                'cancel': cancel,
                'done': _asked,
                'cancelled': _cancelled,
                'running': _running,
                'result': _waits('Future.result'),
                'exception': _waits('Future.exception'),
            },
        ),
    },
    functions={
        'asyncio.to_thread': submit,
        'asyncio.run_coroutine_threadsafe': run_threadsafe,
        'concurrent.futures.wait': _for_all('futures.wait', 1),
        'concurrent.futures.as_completed': _for_all('futures.as_completed', 1),
    },
    aliases={
        'concurrent.futures.thread.ThreadPoolExecutor': 'concurrent.futures.ThreadPoolExecutor',
        'concurrent.futures.process.ProcessPoolExecutor': (
            'concurrent.futures.ProcessPoolExecutor'
        ),
    },
)
