"""
What a specification does not say about an execution that is not one of its paths.

A live run does not see what a coroutine awaits, nor that a callback spins; source may not know a
group. Then it is not the model that is wrong: nothing is decided.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Container, Iterator, Mapping, Sequence
from typing import NamedTuple

from ros2cc_extract.conform.observations import Act, Observation
from ros2cc_extract.conform.trace import Trace
from ros2cc_extract.generator.nested_spins import is_spin
from ros2cc_extract.generator.waits import waits_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Spec

_SOURCE_KNOWS = 'a live run cannot see it, so give the source, or what merge makes of both'
#: What begins and ends a run on a thread.
_OPENS, _CLOSES = ('begin', 'resume', 'run'), ('end', 'suspend', 'pause')


class Gap(NamedTuple):
    """
    Something that the specification does not say.

    :param name: of the callback, group or executor.
    :param mend: what to do about it.
    """

    what: str
    name: str
    mend: str = ''

    def __str__(self) -> str:
        mend = f'; {self.mend}' if self.mend else ''
        return f'the specification does not say {self.what}: {self.name}{mend}'


def gaps(
    trace: Trace,
    places: Mapping[int, int],
    seen: Sequence[Observation],
    spec: Spec,
    several: Container[str],
) -> tuple[Gap, ...]:
    """
    List what is missing.

    :param places: of the callbacks, by the numbers of their subjects.
    :param several: names of callbacks that one line has made several times.
    """
    ran = {each.callback for each in seen}
    callbacks = [callback for place, callback in enumerate(spec.callbacks) if place in ran]
    used = {callback.group for callback in callbacks}
    return (
        *(Gap('what it awaits', name, _SOURCE_KNOWS) for name in _awaiting(seen, spec)),
        *(Gap('that it spins', name, _SOURCE_KNOWS) for name in _spinning(trace, places, spec)),
        *(
            Gap('of which type it is', g.name)
            for g in spec.groups
            if g.unresolved and g.name in used
        ),
        *(Gap('what it is', executor) for executor in _unknown_executor(spec)),
        *(
            Gap('for which of several it waits', callback.name)
            for callback in callbacks
            if callback.name in several and any(waits_of(callback, spec))
        ),
    )


def _awaiting(seen: Sequence[Observation], spec: Spec) -> Iterator[str]:
    paused = {each.callback for each in seen if each.act is Act.SUSPEND}
    times = Counter((each.callback, each.act) for each in seen if each.is_task)
    for place, callback in enumerate(spec.callbacks):
        went_on = times[place, Act.BEGIN] > times[place, Act.ARRIVE] > 0
        is_reported = any(wait.frees_thread for wait in waits_of(callback, spec))
        if (place in paused or went_on) and not is_reported:
            yield callback.name


def _spinning(trace: Trace, places: Mapping[int, int], spec: Spec) -> Iterator[str]:
    """An executor waits, on a thread, while a callback runs there: that one spins it."""
    running: defaultdict[int, list[int]] = defaultdict(list)
    found: set[int] = set()
    for event in trace.events:
        on_thread = running[event.thread]
        if event.name == 'wait>' and on_thread:
            found.add(on_thread[-1])
        elif event.subject in places:
            if event.name in _OPENS:
                on_thread.append(places[event.subject])
            elif event.name in _CLOSES and on_thread:
                on_thread.pop()
    for place in sorted(found):
        if not any(is_spin(block) for block in spec.callbacks[place].blocking):
            yield spec.callbacks[place].name


def _unknown_groups(spec: Spec) -> Iterator[str]:
    return (group.name for group in spec.groups if group.unresolved is not None)


def _unknown_executor(spec: Spec) -> Iterator[str]:
    if spec.executor.unresolved is not None or isinstance(spec.executor.kind, Unknown):
        yield spec.executor.name
