"""Where threads may be held: the waits, locks and shared accesses that the scanner names."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Activity, Callback, GroupType, Spec

MOST_POINTS = 200
ACCESS, WAIT = 'access', 'wait'


@dataclass(frozen=True, kw_only=True)
class Point:
    """A place at which a thread may be held; fields as in ``exploring/marks.py``."""

    file: str
    line: int
    column: int = 0
    kind: str
    name: str = ''
    rests: bool = False
    computed: bool = False


def points_of(units: Iterable[Spec]) -> tuple[Point, ...]:
    """Give each place once, those of waits first; at most ``MOST_POINTS``."""
    found: dict[tuple[str, int, int, str, str], Point] = {}
    every = list(units)
    for each in (*_waits(every), *_accesses(every)):
        found.setdefault((each.file, each.line, each.column, each.kind, each.name), each)
    return tuple(found.values())[:MOST_POINTS]


def _doers(unit: Spec) -> list[Callback | Activity]:
    return [*(each for each in unit.callbacks if not each.builtin), *unit.activities]


def _waits(units: Sequence[Spec]) -> Iterator[Point]:
    for unit in units:
        for doer in _doers(unit):
            for block in doer.blocking:
                if block.source is not None:
                    yield _point(block.source, WAIT, block.resource or block.call)
            for lock in doer.locks:
                if lock.source is not None:
                    name = lock.name if isinstance(lock.name, str) else 'a lock'
                    yield _point(lock.source, WAIT, name)


def _accesses(units: Sequence[Spec]) -> Iterator[Point]:
    """What two may access at a time, and one of them writes."""
    for unit in units:
        users: dict[str, set[str]] = defaultdict(set)
        written: set[str] = set()
        for doer in _doers(unit):
            for access in (*doer.reads, *doer.writes):
                users[access.name].add(doer.name)
                if _overlaps_itself(doer, unit):
                    users[access.name].add(f'{doer.name} again')
            written |= {access.name for access in doer.writes}
        shared = {name for name in written if len(users[name]) > 1}
        for doer in _doers(unit):
            for access in doer.writes:
                if access.name in shared and access.source is not None:
                    yield _point(access.source, ACCESS, access.name, access)
            for access in doer.reads:
                if access.name in shared and access.source is not None:
                    yield _point(access.source, ACCESS, access.name)


def _overlaps_itself(doer: Callback | Activity, unit: Spec) -> bool:
    if isinstance(doer, Activity):
        return doer.count != 1
    return unit.group_of(doer).type is GroupType.REENTRANT


def _point(place: Place, kind: str, name: str, write: Access | None = None) -> Point:
    rests = write is not None and not write.in_place and _rests(write)
    return Point(
        file=str(Path(place.file).resolve()),
        line=place.line,
        column=place.column,
        kind=kind,
        name=name,
        rests=rests,
        computed=rests and write is not None and _is_computed(write),
    )


def _rests(write: Access) -> bool:
    """Whether an update by another thread is lost where it comes between the read and this."""
    return write.update or write.rests or write.clears or write.lowers


def _is_computed(write: Access) -> bool:
    """Whether the value is made of what was read, rather than one that a test led to."""
    return write.update or (write.rests and not write.constant)
