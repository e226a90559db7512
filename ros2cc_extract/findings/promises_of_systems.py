"""
What a unit's promise rests on in a system: that its neighbours answer.

Alone, a unit is judged as if every service answered. In a system that assumption is discharged
by the neighbours' own verdicts: a promise that every wait ends is kept only where each service and
action that is waited for is offered by units that keep theirs.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property

from ros2cc_extract.findings.answers_of_others import waited_until_there
from ros2cc_extract.findings.base.wording import called
from ros2cc_extract.findings.promises import DEADLOCK, Judgement, Mark, Promise
from ros2cc_extract.findings.waits.verdicts import PROGRESS
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.circles.joined_processes import (
    ServiceWait,
    circles_of,
    service_waits,
    units_by_offer,
)
from ros2cc_extract.spec.system.model import System
from ros2cc_extract.spec.system.start_up import stuck_waits
from ros2cc_extract.verify.results.results import Verdict, Verification

Judgements = tuple[Judgement, ...]
_NOT_PROVEN = 'processes wait for each other, and their common model does not prove it'
_FAMILIES = (DEADLOCK, PROGRESS)


@dataclass
class _Offers:
    """
    Which node offers what.

    :param are_all: no other node may.
    :param names: identities of the units, in the order of the judgements.
    """

    units: Mapping[tuple[str, str], Sequence[Spec]]
    are_all: bool
    names: Sequence[object]

    def numbers_of(self, unit: Spec) -> list[int]:
        """Which of the judgements are about a unit."""
        return self._by_name.get(_identity(unit), [])

    @cached_property
    def _by_name(self) -> dict[object, list[int]]:
        found: dict[object, list[int]] = defaultdict(list)
        for number, name in enumerate(self.names):
            found[name].append(number)
        return found


def discharged(
    judgements: Sequence[Judgements],
    units: Sequence[Spec],
    system: System,
    circles: Iterable[tuple[Joined, Verification]] = (),
) -> tuple[Judgements, ...]:
    """
    Leave no promise kept that rests on one of a neighbour's that is not.

    :param units: in the order of ``judgements``.
    :param circles: processes that wait for each other, with what is known of them together.
    """
    known = list(judgements)
    for joined, verification in circles:
        if joined.is_of_processes and not _is_proven(verification):
            for number, unit in enumerate(units):
                is_in_it = not set(joined.spec.sources).isdisjoint(unit.sources)
                if is_in_it and _mark(known[number]) is Mark.KEPT:
                    known[number] = _opened(known[number], _NOT_PROVEN)
    names = [_identity(unit) for unit in units]
    for number, why in (*_not_started(system, names), *_not_joined(system, names)):
        if _mark(known[number]) is Mark.KEPT:
            known[number] = _opened(known[number], why)
    waits: dict[object, list[ServiceWait]] = defaultdict(list)
    for process in system.processes:
        for wait in service_waits(process):
            waits[_identity(wait.unit)].append(wait)
    offers = _Offers(units_by_offer(system), system.is_whole, names)
    changed = True
    while changed:
        changed = False
        for number, name in enumerate(names):
            if _mark(known[number]) is not Mark.KEPT:
                continue
            why = next(_doubts(waits.get(name, ()), offers, known), '')
            if why:
                known[number] = _opened(known[number], why)
                changed = True
    return tuple(tuple(map(_rested, each)) for each in known)


def _not_started(system: System, names: Sequence[object]) -> Iterator[tuple[int, str]]:
    """The units of processes whose set-up never ends, and why."""
    for wait in stuck_waits(system):
        mine = {_identity(unit) for unit in wait.process.units}
        why = f'the set-up of {wait.process.name} waits for {wait.awaited.what} '
        why += f'{wait.awaited.name}, which is offered only behind a wait that needs it'
        yield from ((number, why) for number, name in enumerate(names) if name in mine)


def _not_joined(system: System, names: Sequence[object]) -> Iterator[tuple[int, str]]:
    """The units of processes that wait for each other and are in no common model, and why."""
    for circle, doubt in circles_of(system).open:
        mine = {_identity(unit) for process in circle for unit in process.units}
        why = f'processes wait for each other and are not judged together: {doubt.reason}'
        yield from ((number, why) for number, name in enumerate(names) if name in mine)


def _is_proven(verification: Verification) -> bool:
    results = [each for each in verification.results if each.family in _FAMILIES]
    return bool(results) and all(each.verdict is Verdict.SATISFIED for each in results)


def _doubts(
    waits: Sequence[ServiceWait], offers: _Offers, known: Sequence[Judgements]
) -> Iterator[str]:
    for wait in waits:
        who = f'{called(wait.doer)} waits for'
        if isinstance(wait.name, Unknown):
            yield f'{who} a {wait.what} whose name is not known ({wait.name.reason})'
            continue
        if not waited_until_there(wait.unit, wait.doer.blocking, wait.block, wait.client):
            yield (
                f'{who} {wait.what} {wait.name} and has not waited until it is there: a request '
                'that comes too early is lost'
            )
        servers = offers.units.get((wait.what, wait.name), [])
        if not servers:
            nobody = 'nobody' if offers.are_all else 'no known node'
            yield f'{who} {wait.what} {wait.name}, which {nobody} offers'
        for unit in servers:
            at = offers.numbers_of(unit)
            if not at or any(_mark(known[n]) is not Mark.KEPT for n in at):
                yield f'{who} {wait.what} {wait.name} of {unit.name}, of which that is not proven'


def _identity(unit: Spec) -> object:
    """Equal for a unit before and after what the user assumes of it."""
    return unit.entry, unit.name, tuple(each.name for each in unit.callbacks)


def _mark(judgements: Judgements) -> Mark:
    return next(each.mark for each in judgements if each.promise is Promise.WAITS)


def _rested(judgement: Judgement) -> Judgement:
    """What a kept promise assumes of others, these keep."""
    return replace(judgement, reason='') if judgement.mark is Mark.KEPT else judgement


def _opened(judgements: Judgements, why: str) -> Judgements:
    return tuple(
        replace(each, mark=Mark.OPEN, reason=why) if each.promise is Promise.WAITS else each
        for each in judgements
    )
