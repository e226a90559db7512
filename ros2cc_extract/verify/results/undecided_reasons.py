"""What is not known of a unit, and leaves a claim undecided, in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros2cc_extract.generator.program_steps import NamedWait
from ros2cc_extract.generator.waits import actors_of, waits_of
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.events import Event
from ros2cc_extract.verify.results.evidence import Evidence


def doubts_in(run: Evidence, spec: Spec) -> str:
    """Say what unknown facts a run that refutes a claim rests on."""
    steps = {actor.name: tuple(waits_of(actor, spec)) for actor in actors_of(spec)}
    events = (event for moment in run.moments for event in moment.events)
    places: dict[str, dict[str, None]] = {}
    for words, at in (doubt for event in events for doubt in _doubts(event, steps)):
        places.setdefault(words, {}).update(dict.fromkeys(at))
    return ', '.join(words + _at(all_of) for words, all_of in places.items())


def _at(places: Iterable[str]) -> str:
    known = ' or '.join(places)
    return f' at {known}' if known else ''


def _doubts(
    event: Event, steps: dict[str, tuple[NamedWait, ...]]
) -> Iterator[tuple[str, tuple[str, ...]]]:
    """What is not known, and at which places."""
    own = steps.get(event.who or '', ())
    if event.wait is None or event.wait >= len(own):
        return
    step = own[event.wait]
    if event.is_wait and step.is_open:
        yield f'it is not known whether {_wait(step)} ends{_reason(step)}', ()
    elif event.kind == 'silence':
        place = step.waker.source if step.waker is not None else None
        at = (str(place),) if place is not None else ()
        yield f'it is not known whether {event.who} always signals {event.resource}', at


def _wait(step: NamedWait) -> str:
    if step.lock is not None:
        return f'the wait for the lock {step.lock.name}'
    if step.block is None:
        return 'a wait'
    at = f' at {step.block.source}' if step.block.source else ''
    return f'{step.block.call}{at}'


def _reason(step: NamedWait) -> str:
    escapes = step.block.escapes if step.block is not None else None
    return f' ({escapes.reason})' if escapes is not None else ''
