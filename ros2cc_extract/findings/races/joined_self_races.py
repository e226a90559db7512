"""Races of callbacks with themselves, joined into one line: one line of code, or one cause."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence

from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.wording import called, listing, shown
from ros2cc_extract.findings.races.race_texts import IN_ONE_PIECE
from ros2cc_extract.findings.races.self_races import SelfRace, SelfRaceKind
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import Callback, EntityKind

_TWICE = {
    EntityKind.TIMER: 'when a run lasts longer than the period',
    EntityKind.ACTION_EXECUTE: 'when there are two goals at a time',
    EntityKind.DONE_CALLBACK: 'when two answers arrive together',
}
_BY_DEFAULT = 'when messages come together'


@dataclass(frozen=True)
class JoinedRaces:
    """
    Races of one kind that one sentence reports.

    :param races: one for each attribute, of the first callback.
    :param callbacks: all that come to these lines.
    """

    races: tuple[SelfRace, ...]
    callbacks: tuple[Callback, ...]

    @property
    def first(self) -> SelfRace:
        """The race at the first line."""
        return self.races[0]

    @property
    def names(self) -> tuple[str, ...]:
        """The attributes, in the order of their lines."""
        return tuple(race.use.access.name for race in self.races)

    def related(self) -> Iterator[Remark]:
        """The lines of the other attributes."""
        who = called(self.first.callback)
        for race in self.races[1:]:
            verb = 'reads' if race.kind is SelfRaceKind.OVERWRITTEN else 'writes'
            yield Remark(race.use.place, f'{who} {verb} {race.use.access.name} here')


def joined(
    races: Iterable[SelfRace], weight: Callable[[SelfRace], Hashable]
) -> Iterator[JoinedRaces]:
    """
    Join what different callbacks do at one line, and then what the same callbacks do elsewhere.

    :param weight: only what has the same weight is reported together.
    """
    at_line: dict[Hashable, list[SelfRace]] = {}
    for race in races:
        how = (race.kind, race.is_whole, weight(race))
        at_line.setdefault((race.use.access.name, race.use.place, how), []).append(race)
    of_callbacks: dict[Hashable, list[list[SelfRace]]] = {}
    for alike in at_line.values():
        how = (alike[0].kind, alike[0].is_whole, weight(alike[0]))
        names = tuple(race.callback.name for race in alike)
        of_callbacks.setdefault((names, how), []).append(alike)
    for lines in of_callbacks.values():
        lines.sort(key=lambda alike: alike[0].use.place)
        callbacks = tuple(race.callback for race in lines[0])
        yield JoinedRaces(tuple(alike[0] for alike in lines), callbacks)


def message_of(joint: JoinedRaces) -> str:
    """Say which runs may overlap, when, and what becomes of the attributes."""
    names = listing(joint.names, limit=4)
    is_one = len({called(callback) for callback in joint.callbacks}) == 1
    itself, has, s = ('itself', 'it has', 's') if is_one else ('themselves', 'they have', '')
    it, old = ('it', 'its old value') if len(joint.names) == 1 else ('them', 'their old values')
    what = {
        SelfRaceKind.LOST_UPDATE: f'update{s} {names} from {old} without a lock: one of the '
        'changes can get lost',
        SelfRaceKind.STALE_READ: f'write{s} {names} because of what {has} read of {it} before, '
        'without one lock around both: that may no longer hold',
        SelfRaceKind.OVERWRITTEN: f'write{s} {names}, wait{s}, and read{s} {it} here: the other '
        f'run may have written {it} meanwhile',
    }[joint.first.kind]
    if joint.first.is_whole:
        what = f'update{s} {names} from {old} without a lock: {IN_ONE_PIECE}'
    return f'{shown(joint.callbacks)} may overlap {itself}{_when(joint.callbacks)}, and {what}'


def _when(callbacks: Sequence[Callback]) -> str:
    """What brings two runs together, where that is one thing for all."""
    times = {
        _TWICE.get(each.entity, _BY_DEFAULT) if each.entity else _BY_DEFAULT for each in callbacks
    }
    return f' {times.pop()}' if len(times) == 1 else ''
