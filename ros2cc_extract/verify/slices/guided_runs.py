"""
Refutes claims about ends where a slice has too many states to be searched.

One callback waits, and all others get their data and end, one after the other: what is far from
the start in a search for everything at once is near then. It is looked for over waypoints, in the
slice that the claim is asked of, so that what is refuted there is refuted.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.checker.api import Limits
from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import GroupType
from ros2cc_extract.verify.search.search_results import Found, Key, key_of
from ros2cc_extract.verify.slices.pool_exhaustion import MOST_CALLBACKS, Refute, added
from ros2cc_extract.verify.slices.slicer import Slicer

MOST_HUNTS = 12
#: From one waypoint to the next.
HUNT_STATES = 50_000
_ABOUT = (Family.DEADLOCK, Family.PROGRESS, Family.STARVATION)


@dataclass(frozen=True)
class _Hunt:
    """
    One wait in which one callback may stay.

    :param step: number of the wait among the steps of the callback.
    :param part: the slice that is asked whether it ends.
    """

    name: str
    step: int
    part: ClosedSpec

    def waypoints(self, by_request: Iterable[str]) -> Iterator[str]:
        """
        Say how it comes to wait; then the others end, and all that share its group get data.

        :param by_request: those that get data only if they are asked.
        """
        spec = self.part.spec
        places = {callback.name: place for place, callback in enumerate(spec.callbacks)}
        own, thread = places[self.name], spec.executor.threads[0]
        stays = f'{thread}.blocked and {thread}.waits_done == {self.step} and cb_running({own})'
        yield f'E<> cb_waiting[{own}] > 0'
        yield f'E<> {stays}'
        held = {g.name for g in spec.groups if g.type is GroupType.EXCLUSIVE}
        held &= {c.group for c in spec.callbacks if c.name == self.name}
        others = [c for c in spec.callbacks if c.name not in {self.name, *by_request}]
        for other in sorted(others, key=lambda other: other.group in held):
            place = places[other.name]
            yield f'E<> cb_waiting[{place}] > 0 and {stays}'
            if other.group not in held:
                yield f'E<> cb_waiting[{place}] == 0 and !cb_running({place}) and {stays}'


def refute_by_hunts(
    slicer: Slicer, queries: Sequence[Query], refute: Refute, limits: Limits
) -> Found | None:
    """Refute what runs in which one callback stays in a wait refute of ``queries``."""
    left = {key_of(query) for query in queries if query.family in _ABOUT}
    found: Found | None = None
    limits = replace(limits, states=HUNT_STATES)
    for number, hunt in enumerate(_hunts(slicer, queries)):
        if number == MOST_HUNTS or limits.is_over:
            break
        asked = _asked(hunt, left)
        if asked:
            waypoints = tuple(hunt.waypoints(slicer.by_request))
            part = refute(hunt.part, asked, waypoints, limits)
            left -= part.results.keys()
            if part.results:
                part = replace(part, by_slices=len(part.results))
                found = part if found is None else added(found, part)
    return found


def _hunts(slicer: Slicer, queries: Iterable[Query]) -> Iterator[_Hunt]:
    """Waits of those that may not end, then of those that may keep others from their start."""
    names = dict.fromkeys(q.callbacks[0] for q in queries if q.family is Family.PROGRESS)
    for query in queries:
        if query.family is Family.STARVATION:
            names |= dict.fromkeys(sorted(slicer.holders(query.callbacks[0])))
    for name in names:
        part = slicer.part_of_end(name)
        if part is not None and len(part.spec.callbacks) <= MOST_CALLBACKS:
            for step in slicer.held_steps(name):
                yield _Hunt(name, step, part)


def _asked(hunt: _Hunt, left: Iterable[Key]) -> list[Key]:
    """
    What is open of the callbacks of the part; the unit's deadlock follows from its own.

    A callback that stays does not end; one that starves does not run.
    """
    members = {callback.name for callback in hunt.part.spec.callbacks}
    return [
        (family, callbacks, groups)
        for family, callbacks, groups in left
        if members >= set(callbacks)
        and (family is Family.DEADLOCK or (family is Family.PROGRESS) is (hunt.name in callbacks))
    ]
