"""
Threads of Qt, in all its bindings.

``QThread.start`` calls ``run`` in a new thread; the own ``run`` of ``QThread`` goes round a loop
of events there, in which it calls what was connected to ``started`` on objects that were moved to
the thread. Where else a signal calls what is connected to it depends on the receiver, on its
thread and on the binding, so that such a function is one that code which is not scanned has.
Sources: Qt 6, ``QThread`` (``run``, ``wait`` in milliseconds), *Signals and Slots Across Threads*;
PyQt 6, *Support for Signals and Slots*. A thread that still runs when its object goes aborts the
program; the interpreter does not wait for it.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ThreadState, thread_of
from ros2cc_extract.extract.static.libraries.standard.threads import join
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import (
    Library,
    LibraryClass,
    Property,
)
from ros2cc_extract.extract.static.python.machine.path_facts import Word, answer
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Const,
    Handler,
    Instance,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import ActivityKind

BINDINGS = ('PyQt5', 'PyQt6', 'PySide2', 'PySide6', 'PyQt4', 'python_qt_binding', 'qtpy')
"""Packages that have the classes of Qt."""
_MODULES = tuple(f'{binding}.QtCore' for binding in BINDINGS)
_SIGNAL = 'QtCore.Signal'
_OF, _CONNECTED, _HOME = '__thread_of_signal__', '__started_by_thread__', '__moved_to__'


def _init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return NONE


def _start(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    state = thread_of(receiver)
    if state.started and not machine.world.again:
        return NONE
    state.started = True
    run = machine.attribute(receiver, 'run', call.place)
    if isinstance(run, Bound):
        begin(machine, state.kind, run, Call(call.place), receiver, daemon=True)
        return NONE
    for slot in receiver.slots.get(_CONNECTED, ()):
        begin(machine, state.kind, slot, Call(call.place), receiver, daemon=True)
    return NONE


def _wait(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Wait for its end; the limit is in milliseconds, or a timer of Qt."""
    limit = call.argument(0, 'msecs') or call.argument(0, 'time') or call.argument(0, 'deadline')
    inner = Call(call.place)
    if limit is not None:
        is_known = isinstance(limit, Const) and isinstance(limit.value, int | float)
        inner.args = [Const(limit.value / 1000)] if is_known else [limit]  # type: ignore[attr-defined]
    return join(machine, receiver, inner)


def _is_running(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return answer(receiver, Word.END, call, if_true=False)


def _is_finished(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    return answer(receiver, Word.END, call)


def _sleep(parts: int) -> Handler:
    """``sleep``, ``msleep``, ``usleep``: as many parts are a second."""

    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        given = call.args[0] if call.args else NONE
        is_known = isinstance(given, Const) and isinstance(given.value, int | float)
        seconds = Const(given.value / parts) if is_known else given  # type: ignore[attr-defined]
        machine.note_blocking('time.sleep', None, seconds, call.place)
        return NONE

    return handler


def _signal(name: str) -> Property:
    def signal(machine: ConcurrentMachine, receiver: Instance, place: Place) -> Value:
        made = Instance(Name(_SIGNAL), place)
        made.state = PlainState('signal', place=place)
        made.slots[_OF] = receiver if name == 'started' else NONE
        return made

    return signal


def _connect(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """The thread itself calls a method of what was moved to it, when it begins."""
    slot = call.argument(0, 'slot') or NONE
    thread = receiver.slots.get(_OF) if isinstance(receiver, Instance) else None
    is_moved = isinstance(thread, Instance) and _home_of(slot) is thread
    if not is_moved or not isinstance(thread, Instance):
        machine.library_call(machine.mystery('a signal of Qt', call.place, 'connect'), call)
        return NONE
    machine.store.write(thread, _CONNECTED, (*thread.slots.get(_CONNECTED, ()), slot))
    if thread_of(thread).started:
        begin(machine, ActivityKind.THREAD, slot, Call(call.place), thread, daemon=True)
    return NONE


def _home_of(slot: Value) -> Value | None:
    """The thread to which the object of a method was moved."""
    while isinstance(slot, Partial):
        slot = slot.function
    owner = slot.receiver if isinstance(slot, Bound) else None
    home = owner.slots.get(_HOME) if isinstance(owner, Instance) else None
    options = options_of(home) if isinstance(home, Value) else ()
    return options[0] if len(options) == 1 else None


def _move(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        machine.store.write(receiver, _HOME, call.argument(0, 'thread') or NONE)
    return NONE


def _runner(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``QThreadPool.start(runnable)``, or a function."""
    for given in options_of(call.args[0]) if call.args else ():
        run = given
        if isinstance(given, Instance):
            run = machine.attribute(given, 'run', call.place)
        begin(machine, ActivityKind.POOL, run, Call(call.place))
    return NONE


def _pool(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    made = Instance(Name(_POOL_NAME), call.place)
    made.state = PlainState('executor', place=call.place)
    return made


_POOL_NAME = f'{_MODULES[0]}.QThreadPool'
_NOTHING: Handler = lambda machine, receiver, call: NONE  # noqa: E731
_OBJECT = LibraryClass(init=_init, is_beside=True, methods={'moveToThread': _move})
_RUNNABLE = LibraryClass(
    state=lambda machine, instance: PlainState('runnable', place=instance.place), init=_init
)
_POOL = LibraryClass(
    state=lambda machine, instance: PlainState('executor', place=instance.place),
    init=_init,
    methods={'start': _runner, 'tryStart': _runner},
)
_SLEEPS = {'sleep': _sleep(1), 'msleep': _sleep(1_000), 'usleep': _sleep(1_000_000)}


def _thread(module: str) -> LibraryClass:
    return LibraryClass(
        state=lambda machine, instance: ThreadState(ActivityKind.THREAD),
        init=_init,
        is_beside=True,
        bases=(f'{module}.QObject',),
        methods={
            'start': _start,
            'wait': _wait,
            'isRunning': _is_running,
            'isFinished': _is_finished,
            'setPriority': _NOTHING,
            **_SLEEPS,
        },
        properties={'started': _signal('started'), 'finished': _signal('finished')},
    )


TABLE = Library(
    classes={
        _SIGNAL: LibraryClass(methods={'connect': _connect, 'disconnect': _NOTHING}),
        **{f'{module}.QObject': _OBJECT for module in _MODULES},
        **{f'{module}.QThread': _thread(module) for module in _MODULES},
        **{f'{module}.QRunnable': _RUNNABLE for module in _MODULES},
        **{f'{module}.QThreadPool': _POOL for module in _MODULES},
    },
    functions={f'{module}.QThreadPool.globalInstance': _pool for module in _MODULES}
    | {
        f'{module}.QThread.{name}': handler
        for module in _MODULES
        for name, handler in _SLEEPS.items()
    },
)
