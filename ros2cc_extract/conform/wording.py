"""Put observations and states of the model into words: callbacks by name, file and line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ros2cc_extract.conform.observable_model import ObservedModel
from ros2cc_extract.conform.observations import Act, Observation
from ros2cc_extract.conform.search import follow, unseen
from ros2cc_extract.spec.model import Callback, Spec

_OF_THE_EXECUTOR = {
    'wait': 'the executor waits',
    'serving': 'the executor serves what it has found',
    'executing': 'the executor runs a callback itself',
}


def say_callback(callback: Callback) -> str:
    """Name and place, as ``on_joint (arm.py:60:9)``."""
    place = callback.defined or callback.source
    return f'{callback.display_name} ({place})' if place else callback.display_name


def say_observation(observation: Observation, spec: Spec) -> str:
    """What was observed, without when and where."""
    if observation.callback is None:
        found = ', '.join(say_callback(spec.callbacks[c]) for c in sorted(observation.found))
        return f'the executor {Act.WAKE.value} and finds {found}'
    callback = say_callback(spec.callbacks[observation.callback])
    if observation.act is Act.ARRIVE and not observation.is_task:
        return f'something arrives for {callback}'
    if observation.act is Act.COLLECT:
        return f'the executor collects {callback}'
    return f'{callback} {observation.act.value}'


def say_state(model: ObservedModel, packed: int, spec: Spec) -> str:
    """Where the executor, its threads, its queue, the groups and the data are."""
    return '; '.join(part for part in _parts(model, packed, spec) if part)


def _parts(model: ObservedModel, packed: int, spec: Spec) -> Iterator[str]:
    names = [callback.display_name for callback in spec.callbacks]
    numbers = range(len(names))
    for process in model.processes('Executor'):
        yield _OF_THE_EXECUTOR.get(model.location(packed, process), '')
    for number, process in enumerate(model.processes('Thread')):
        at = model.location(packed, process)
        if at in ('running', 'blocked', 'popped', 'assigned'):
            running = model.value(packed, f'thread_cb_assign_table[{number}]') or 0
            words = {'running': 'runs', 'blocked': 'waits in'}.get(at, 'is about to start')
            yield f'{spec.executor.threads[number]} {words} {names[running]}'
    yield _listing('queued', _queue(model, packed, names))
    yield _listing('suspended', _where(model, packed, 'cb_suspended', names))
    closed = (
        group.name
        for number, group in enumerate(spec.groups)
        if model.value(packed, f'group_closed[{number}]')
    )
    yield _listing('closed groups', closed)
    waiting = (names[c] for c in numbers if model.is_waiting(packed, c))
    yield _listing('has arrived', waiting)


def _listing(title: str, names: Iterable[str]) -> str:
    text = ', '.join(names)
    return f'{title}: {text}' if text else ''


def _where(model: ObservedModel, packed: int, table: str, names: Sequence[str]) -> Iterator[str]:
    for number, name in enumerate(names):
        if model.value(packed, f'{table}[{number}]'):
            yield name


def _queue(model: ObservedModel, packed: int, names: Sequence[str]) -> Iterator[str]:
    for place in range(model.value(packed, 'pool_size') or 0):
        entry = model.value(packed, f'pool_queue[{place}]') or 0
        asked = ' (asked whether it can go on)' if entry >= len(names) else ''
        yield f'{names[entry % len(names)]}{asked}'


def say_allowed(model: ObservedModel, states: Iterable[int], spec: Spec) -> tuple[str, ...]:
    """What could have been observed next in any of these states."""
    found: set[tuple[str, int, Act]] = set()
    ready: set[int] = set()
    for packed in states:
        for state in unseen(model, packed, frozenset()):
            for move in model.moves(state):
                if move.act not in (None, Act.ARRIVE, Act.WAKE) and move.callback is not None:
                    found.add((move.act.name, move.callback, move.act))
        ready |= {c for c in range(len(spec.callbacks)) if _can_find(model, packed, c)}
    lines = [
        say_observation(_observation(act, callback), spec)
        for _, callback, act in sorted(found, key=lambda each: each[:2])
    ]
    if ready:
        names = ', '.join(spec.callbacks[c].display_name for c in sorted(ready))
        lines.append(f'the executor {Act.WAKE.value} and finds any of {names}')
    return tuple(lines)


def _can_find(model: ObservedModel, packed: int, callback: int) -> bool:
    wake = _observation(Act.WAKE, None, frozenset({callback}))
    return next(follow(model, packed, wake), None) is not None


def _observation(
    act: Act, callback: int | None, found: frozenset[int] = frozenset()
) -> Observation:
    return Observation(
        act=act, callback=callback, thread=0, clock_ns=0, earliest_ns=0, found=found
    )
