"""Queues of the standard library: producers, consumers, and which waits for the other."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.holders import queue_contents
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.libraries.standard.queue_items import give_items, taken_out
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.machine.path_facts import Word, answer, full
from ros2cc_extract.extract.static.python.machine.waitable_objects import INITIAL
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)


def init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A queue has a size, or none."""
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, INITIAL, call.argument(0, 'maxsize') or Const(0))
    return NONE


def may_be_full(queue: Instance) -> bool:
    """Source: ``queue.py``; a size of zero or less has no bound."""
    size = queue.slots.get(INITIAL, Const(0))
    is_number = isinstance(size, Const) and isinstance(size.value, (int, float))
    return not is_number or size.value > 0


def _waits(machine: ConcurrentMachine, call: Call, position: int) -> bool:
    """``block`` is true by default; code that tries until it succeeds waits as well."""
    block = call.argument(position, 'block')
    is_refused = isinstance(block, Const) and not block.value
    return not is_refused or call.place in machine.world.retried


def _get(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    is_held = _waits(machine, call, 0)
    has_end = call.argument(1, 'timeout') not in (None, NONE)
    queue_contents.note_taken(machine, receiver, call.place, waits=is_held and not has_end)
    if is_held:
        machine.note_blocking('Queue.get', receiver, call.argument(1, 'timeout'), call.place)
    machine.note_wake(receiver, Word.GET, call.place)
    _move(machine, receiver, Word.GET)
    item = taken_out(machine, receiver, call)
    return item or machine.mystery('what was put into a queue', call.place, 'get()')


def _move(machine: ConcurrentMachine, queue: Value, word: Word) -> None:
    """Where something was just put in there is something, where it was taken out there is room."""
    world = machine.world
    if (queue, Word.DONE) not in world.ready:  # else it was asked how many there are
        world.ready -= {(queue, Word.PUT), (queue, Word.GET)}
        world.ready |= {(queue, word)}


def _put(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    is_bounded = isinstance(receiver, Instance) and may_be_full(receiver)
    is_held = _waits(machine, call, 1)
    has_end = call.argument(2, 'timeout') not in (None, NONE)
    queue_contents.note_given(
        machine,
        receiver,
        call.place,
        is_bounded=is_bounded,
        waits=is_held and not has_end,
    )
    if is_bounded and is_held:
        machine.note_blocking('Queue.put', receiver, call.argument(2, 'timeout'), call.place)
    give_items(machine, receiver, call)
    machine.note_wake(receiver, Word.PUT, call.place, call.argument(0, 'item'))
    _move(machine, receiver, Word.PUT)
    return NONE


def _without_waiting(word: Word) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        if call.place in machine.world.retried:
            _note_retried(machine, receiver, word, call)
        if word is Word.GET:
            queue_contents.note_taken(machine, receiver, call.place, waits=False)
        elif word is Word.PUT:
            is_bounded = isinstance(receiver, Instance) and may_be_full(receiver)
            queue_contents.note_given(
                machine, receiver, call.place, is_bounded=is_bounded, waits=False
            )
        if word is Word.PUT:
            give_items(machine, receiver, call)
        item = call.argument(0, 'item') if word is Word.PUT else None
        machine.note_wake(receiver, word, call.place, item)
        if word is not Word.DONE:
            _move(machine, receiver, word)
        taken = taken_out(machine, receiver, call) if word is Word.GET else None
        return taken or machine.mystery('what was put into a queue', call.place, 'get_nowait()')

    return handler


def _note_retried(machine: ConcurrentMachine, queue: Value, word: Word, call: Call) -> None:
    """A loop tries until it succeeds."""
    if word is Word.GET:
        machine.note_blocking('Queue.get', queue, None, call.place)
    elif word is Word.PUT and isinstance(queue, Instance) and may_be_full(queue):
        machine.note_blocking('Queue.put', queue, None, call.place)


def _join(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    machine.note_blocking('Queue.join', receiver, None, call.place)
    return NONE


def _is_empty(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    queue_contents.note_asked(machine, receiver, call.place)
    return answer(receiver, Word.PUT, call, if_true=False)


def _is_full(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    queue_contents.note_asked(machine, receiver, call.place)
    return full(receiver, call)


def _size(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Code that has asked for the size, in a test or for a loop, takes no more than that."""
    queue_contents.note_asked(machine, receiver, call.place)
    machine.world.ready |= {(receiver, word) for word in (Word.PUT, Word.GET, Word.DONE)}
    return machine.mystery('how full a queue is', call.place, 'queue')


QUEUE_METHODS: dict[str, Handler] = {
    'get': _get,
    'put': _put,
    'get_nowait': _without_waiting(Word.GET),
    'put_nowait': _without_waiting(Word.PUT),
    'task_done': _without_waiting(Word.DONE),
    'join': _join,
    'empty': _is_empty,
    'full': _is_full,
    'qsize': _size,
}
_QUEUE = LibraryClass(
    state=lambda machine, instance: PlainState('queue', place=instance.place),
    init=init,
    methods=QUEUE_METHODS,
)

TABLE = Library(
    classes={
        'queue.Queue': _QUEUE,
        'queue.LifoQueue': _QUEUE,
        'queue.PriorityQueue': _QUEUE,
        'queue.SimpleQueue': _QUEUE,
        'multiprocessing.Queue': _QUEUE,
        'multiprocessing.JoinableQueue': _QUEUE,
        'multiprocessing.SimpleQueue': _QUEUE,
    },
)
