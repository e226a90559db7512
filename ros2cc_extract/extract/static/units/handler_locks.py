"""
Locks that a handler of a signal takes, and that the main thread may hold when the signal comes.

The handler runs between two lines of the main thread, which goes on only behind it: a
``threading.Lock`` that the main thread holds is never given back. An ``RLock`` may be taken again,
and what another thread holds is given back meanwhile. A ``queue.Queue`` holds a lock of its own
whenever something is put in or taken out; that of an event is held for a few instructions only,
and is left out.
Sources: CPython 3.12, ``signal`` (handlers run in the main thread), ``queue.py`` (``mutex``; only
``SimpleQueue`` may be entered again); rclpy 7.1.6, ``executors.py``
(a ``MultiThreadedExecutor`` runs callbacks in threads of a pool). Measured on 7.1.6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, RelatedPlace, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    ExecutorState,
    RosWorld,
    Spin,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import MULTI
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Function,
    Instance,
    Library,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Act
from ros2cc_extract.spec.program_order import steps

_WITH_MUTEX = frozenset({'queue.Queue', 'queue.LifoQueue', 'queue.PriorityQueue'})


@dataclass(frozen=True)
class _Take:
    """Somebody takes a lock in the main thread; ``by`` is empty for the main program itself."""

    lock: str
    place: Place
    by: str


def note_handler_locks(world: RosWorld) -> None:
    """Tell of such locks, when all was followed."""
    for number, handler in enumerate(world.signal_handlers):
        for name, acts in _takes_of(handler).items() if handler.interrupts else ():
            held = next(_held_in_main(name, number, world), None)
            if held is not None and is_plain_lock(name, world):
                world.diagnostics.append(_told(handler, acts, held))

    for handler in (each for each in world.signal_handlers if each.interrupts):
        world.diagnostics.extend(_of_queues(handler, world))


def _takes_of(handler: ActivityState) -> dict[str, list[Act]]:
    """
    Where a handler takes each lock and waits for it.

    What comes behind a place that no branch leads around is not reached if that place waits.
    """
    found: dict[str, list[Act]] = {}
    for act in handler.effects.locks:
        if not act.tries and isinstance(act.name, str) and act.source is not None:
            acts, surely = found.setdefault(act.name, []), handler.effects.taken.get(act.name)
            if not any(steps(each) == surely for each in acts):
                acts.append(act)
    return found


def _of_queues(handler: ActivityState, world: RosWorld) -> Iterator[Diagnostic]:
    """Queues that a handler uses, and callbacks in the main thread as well."""
    served = [node for spin in world.spins.values() for node in _run_in_main(spin)]
    for number, wakings in world.wakings.items():
        own = next((each for each in wakings if each.by is handler), None)
        queue = next((each for each in world.kept if id(each) == number), None)
        if own is None or not isinstance(queue, Instance) or not _has_mutex(queue):
            continue
        for use in wakings:
            by = use.by
            if isinstance(by, EntityState) and any(by.node is each for each in served):
                yield _told_of_queue(handler, own.place, queue, use.place, _called(by.callback))
                break


def _has_mutex(thing: Instance) -> bool:
    return any(isinstance(cls, Library) and cls.name in _WITH_MUTEX for cls in thing.mro)


def _told_of_queue(
    handler: ActivityState, place: Place, queue: Instance, used: Place, user: str
) -> Diagnostic:
    name = queue.hint or 'a queue'
    return Diagnostic(
        severity=Severity.WARNING,
        slug='lock-order',
        place=place,
        message=f'{_called(handler.target)}, which handles a signal, uses {name}, whose lock '
        f'{user} may hold in the same thread: then it waits for what it has interrupted, forever',
        help='only store a flag in the handler, or use a queue.SimpleQueue',
        related=(
            RelatedPlace(used, f'{name} is used here, in the main thread'),
            RelatedPlace(handler.place, 'the handler is set here'),
        ),
    )


def is_plain_lock(name: str, world: RosWorld) -> bool:
    """Whether its own holder waits for it as well."""
    hint, _, number = name.partition('#')
    locks = world.locks.get(hint, [])
    index = int(number) - 1 if number.isdigit() else 0
    state = locks[index].state if index < len(locks) else None
    return isinstance(state, PlainState) and state.kind == 'lock'


def _held_in_main(name: str, handler: int, world: RosWorld) -> Iterator[_Take]:
    """Who takes the lock in the main thread when the handler of that number is there."""
    for lock, place, handlers in world.main_takes:
        if lock == name and handlers > handler:
            yield _Take(lock, place, '')
    served = [node for spin in world.spins.values() for node in _run_in_main(spin)]
    for entity in world.entities:
        if entity.effects is None or not any(entity.node is each for each in served):
            continue
        for act in entity.effects.locks:
            if act.name == name and act.source is not None:
                yield _Take(name, act.source, _called(entity.callback))


def _run_in_main(spin: Spin) -> Iterator[Instance]:
    """The nodes whose callbacks the main thread runs itself by that spin."""
    state = spin.executor.state
    if spin.in_thread or spin.thread != 0 or not isinstance(state, ExecutorState):
        return
    is_pool = any(getattr(cls, 'name', '') == MULTI for cls in spin.executor.mro)
    if is_pool or state.unresolved is not None or state.unknown is not None:
        return
    added = [each for one in spin.executor.slots.get('__nodes__', ()) for each in options_of(one)]
    yield from (*spin.nodes, *(each for each in added if isinstance(each, Instance)))


def _called(callback: Value | None) -> str:
    function = callback.function if isinstance(callback, Bound) else callback
    if not isinstance(function, Function):
        return 'a callback'
    owner = callback.receiver if isinstance(callback, Bound) else None
    return f'{owner.class_name}.{function.name}' if isinstance(owner, Instance) else function.name


def _told(handler: ActivityState, acts: Sequence[Act], held: _Take) -> Diagnostic:
    who, act = held.by or 'the main program', acts[0]
    places = dict.fromkeys(each.source for each in acts if each.source is not None)
    places.pop(act.source, None)  # type: ignore[arg-type]
    return Diagnostic(
        severity=Severity.ERROR,
        slug='lock-order',
        place=act.source or handler.place,
        message=f'{_called(handler.target)}, which handles a signal, takes {act.name}, which '
        f'{who} may hold in the same thread: it waits for what it has interrupted, forever',
        help='only store a flag in the handler, or use a threading.RLock',
        related=(
            *(RelatedPlace(place, f'or it takes {act.name} here') for place in places),
            RelatedPlace(held.place, f'{act.name} is taken here, in the main thread'),
            RelatedPlace(handler.place, 'the handler is set here'),
        ),
    )
