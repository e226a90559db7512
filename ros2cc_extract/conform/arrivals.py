"""
Puts what arrived among the observations of an events executor, which serves it in this order.

The middleware reports arrivals to the executor in C++; no trace has them. The code that feeds a
program knows when it did so.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from operator import attrgetter
from typing import TypeVar

from ros2cc_extract.conform.observations import Act, Observation
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import Spec

Value = TypeVar('Value')


@dataclass(frozen=True, kw_only=True)
class Arrival:
    """
    Something was handed to the middleware for a callback.

    :param callback: its name in the specification.
    :param thread: number of the thread that did; what it hands over arrives in this order.
    :param latest_ns: when it had arrived; ``None`` if only its being served shows that it had.
    """

    callback: str
    thread: int
    earliest_ns: int
    latest_ns: int | None


def with_arrivals(
    seen: Sequence[Observation], arrivals: Sequence[Arrival], spec: Spec
) -> tuple[Observation, ...]:
    """
    Add what arrived, each in a thread of its own beside those of the trace.

    Of a callback that ``arrivals`` leave out, such as a timer, each arrival is put right before
    the first one that is served after it, as it must have been in an order of arrival.
    """
    begins = [each for each in seen if each.act is Act.BEGIN]
    places = {callback.name: place for place, callback in enumerate(spec.callbacks)}
    reported = list(_reported(arrivals, places, begins))
    known = {each.callback for each in reported}
    served = list(_paired(reported, begins))
    hidden = (
        _hidden(begin, served[number:])
        for number, begin in enumerate(begins)
        if begin.callback not in known
    )
    rows = [replace(each, has_arrived=each.act is Act.BEGIN) for each in seen]
    return tuple(sorted((*hidden, *reported, *rows), key=_clock))


_clock = attrgetter('clock_ns')


def _reported(
    arrivals: Sequence[Arrival], places: Mapping[str, int], begins: Sequence[Observation]
) -> Iterator[Observation]:
    """
    Give what arrived as observations, in the order of their being handed over.

    Where only being served shows it, arrivals at the end that were never served are left out.
    """
    clocks = _queues((begin.callback, begin.clock_ns) for begin in begins)
    latest: dict[int, int] = defaultdict(int)
    unserved: dict[int, list[Observation]] = defaultdict(list)
    for each in sorted(arrivals, key=attrgetter('earliest_ns')):
        served = clocks[places[each.callback]]
        served_ns = served.popleft() if served else None
        known_ns = served_ns if each.latest_ns is None else each.latest_ns
        latest[each.thread] = max(latest[each.thread], known_ns or 0)
        arrived = Observation(
            act=Act.ARRIVE,
            callback=places[each.callback],
            thread=-1 - each.thread,
            clock_ns=latest[each.thread],
            earliest_ns=each.earliest_ns,
        )
        unserved[each.thread].append(arrived)
        if known_ns is not None:
            yield from unserved.pop(each.thread)


def _paired(
    reported: Sequence[Observation], begins: Sequence[Observation]
) -> Iterator[Observation | None]:
    """Pair each begin with its arrival, if reported: the first is served first. Then the rest."""
    left = _queues((each.callback, each) for each in reported)
    for begin in begins:
        yield left[begin.callback].popleft() if left[begin.callback] else None
    for never_served in left.values():
        yield from never_served


def _queues(pairs: Iterable[tuple[int | None, Value]]) -> dict[int | None, deque[Value]]:
    queues: dict[int | None, deque[Value]] = defaultdict(deque)
    for callback, value in pairs:
        queues[callback].append(value)
    return queues


def _hidden(begin: Observation, served: Sequence[Observation | None]) -> Observation:
    """When something arrived for ``begin``, at the latest; ``served``: by it and by later ones."""
    later = min((each for each in served if each is not None), key=_clock, default=None)
    clock_ns = begin.clock_ns if later is None else min(begin.clock_ns, later.clock_ns)
    return Observation(
        act=Act.ARRIVE,
        callback=begin.callback,
        thread=-1 if later is None else later.thread,
        clock_ns=clock_ns,
        earliest_ns=0,
    )
